#include "sim/campaign/merge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "sim/base/error.h"
#include "sim/base/input_file.h"
#include "tests/complaint.h"
#include "tests/sim/campaign/campaign_fixture.h"

namespace dodgesim {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class MergeTest : public CampaignTest {
 protected:
  void fly_shard(const std::string& name, int index, int count) const {
    CampaignOptions part = options(name);
    part.shard = {index, count};
    run_campaign(scenario_, part, [this](int i) { return fly(i); });
  }
  CampaignSummary merge(const std::vector<std::string>& names, const std::string& out) const {
    std::vector<std::filesystem::path> directories;
    for (const std::string& name : names) directories.push_back(root_ / name);
    return merge_campaigns(directories, options(out));
  }
  template <class Error>
  std::string refusal(const std::vector<std::string>& names) const {
    std::string sentence = testing::complaint<Error>([&] { merge(names, "refused"); });
    EXPECT_FALSE(std::filesystem::exists(root_ / "refused" / "throws.csv"));
    return sentence;
  }
};

TEST_F(MergeTest, IsWhatOneProcessWouldHaveWritten) {
  run_campaign(scenario_, options("whole"), [&](int index) { return fly(index); });
  for (const int count : {2, 5}) {
    std::vector<std::string> names;
    for (int i = 0; i < count; ++i) {
      names.insert(names.begin(), std::to_string(count) + "_" + std::to_string(i));
      fly_shard(names.front(), i, count);
    }
    names.push_back(names.front());  // once more
    const std::string out = "merged" + std::to_string(count);
    EXPECT_EQ(merge(names, out).results.size(), 12u);
    for (const char* file : kReproducible) {
      EXPECT_EQ(read_file(root_ / "whole" / file), read_file(root_ / out / file)) << file;
    }
    const Json manifest = parse_json(read_file(root_ / out / "manifest.json"));
    EXPECT_FALSE(manifest["time"].contains("throws_per_minute"));
  }
}

TEST_F(MergeTest, ListsWhatIsMissing) {
  fly_shard("a", 0, 3);
  fly_shard("b", 1, 3);
  EXPECT_EQ(refusal<MissingThrows>({"a", "b"}), "4 of 12 throws are missing: 2, 5, 8, 11.");
  EXPECT_EQ(refusal<MissingThrows>({"b"}),
            "8 of 12 throws are missing: 0, 2 to 3, 5 to 6, 8 to 9, 11.");
}

TEST_F(MergeTest, RefusesShardsThatContradictEachOther) {
  fly_shard("a", 0, 2);
  fly_shard("b", 1, 2);
  CampaignOptions part = options("c");
  part.shard = {1, 2};
  run_campaign(scenario_, part, [&](int index) {
    ThrowResult result = fly(index);
    if (index == 7) result.events_hash ^= 1;
    return result;
  });
  EXPECT_THAT(refusal<ScenarioError>({"a", "b", "c"}), HasSubstr("Throw 7 went differently in"));
}

TEST_F(MergeTest, AThrowThatWasLostInOneShardAndFlownInAnotherIsFlown) {
  run_campaign(scenario_, options("whole"), [&](int index) { return fly(index); });
  run_campaign(scenario_, options("lost"), [&](int index) {
    if (index == 7 || index == 8) ::_exit(index);
    return fly(index);
  });
  run_campaign(scenario_, options("other"), [&](int index) {
    if (index == 8) ::_exit(1);
    return fly(index);
  });
  for (const auto& names : {std::vector<std::string>{"lost", "whole"}, {"whole", "lost"}}) {
    const std::string out = names.front() + "_first";
    merge(names, out);
    for (const char* file : kReproducible) {
      EXPECT_EQ(read_file(root_ / "whole" / file), read_file(root_ / out / file)) << file;
    }
  }
  EXPECT_EQ(merge({"lost", "other"}, "ab").errors, 1);
  EXPECT_EQ(merge({"other", "lost"}, "ba").errors, 1);
  EXPECT_EQ(read_file(root_ / "ab/throws.csv"), read_file(root_ / "ba/throws.csv"));
}

TEST_F(MergeTest, OfManyMissingThrowsItListsTheFirst) {
  scenario_.repeats = 100;
  fly_shard("a", 0, 2);
  EXPECT_THAT(refusal<MissingThrows>({"a"}),
              ::testing::MatchesRegex("50 of 100 throws are missing: 1, 3, .*, 39 and 30 more."));
}

TEST_F(MergeTest, SaysWhenAPartIsDamaged) {
  fly_shard("a", 0, 1);
  const std::filesystem::path journal = root_ / "a/results.bin";
  std::string bytes = read_file(journal);
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  testing::put(journal, bytes);
  EXPECT_THAT(refusal<MissingThrows>({"a"}),
              ::testing::EndsWith("; results.bin of " + (root_ / "a").string() +
                                  " is damaged or cut off, and --resume flies there what was "
                                  "lost."));
}

TEST_F(MergeTest, SaysWhenAPartIsCutOff) {
  fly_shard("a", 0, 1);
  const std::filesystem::path journal = root_ / "a/results.bin";
  std::filesystem::resize_file(journal, std::filesystem::file_size(journal) - 5);
  EXPECT_THAT(refusal<MissingThrows>({"a"}), HasSubstr("is damaged or cut off, and --resume"));
}

TEST_F(MergeTest, KeepsTheManifestsOfItsParts) {
  fly_shard("a", 0, 2);
  fly_shard("b", 1, 2);
  merge({"a", "b"}, "whole");
  const Json manifest = parse_json(read_file(root_ / "whole/manifest.json"));
  ASSERT_EQ(manifest["parts"].size(), 2u);
  EXPECT_EQ(manifest["parts"][1], parse_json(read_file(root_ / "b/manifest.json")));
}

TEST_F(MergeTest, CanBeAskedWhetherAllIsThere) {
  fly_shard("a", 0, 2);
  EXPECT_THROW(expect_complete({root_ / "a"}), MissingThrows);
  fly_shard("b", 1, 2);
  EXPECT_EQ(expect_complete({root_ / "b", root_ / "a"}), 12);
}

TEST_F(MergeTest, RefusesShardsOfOtherCampaigns) {
  fly_shard("a", 0, 2);
  scenario_.seed = 99;
  fly_shard("b", 1, 2);
  EXPECT_THAT(refusal<ScenarioError>({"a", "b"}),
              HasSubstr("b holds results of another scenario (seed is 99, not 4)"));
  EXPECT_THROW(merge({"a", "none"}, "out"), IoError);
}

TEST_F(MergeTest, NeverWritesOverAPart) {
  fly_shard("a", 0, 2);
  fly_shard("b", 1, 2);
  const std::string before = read_file(root_ / "a/results.bin");
  CampaignOptions over = options("a");
  over.force = true;
  EXPECT_THROW(merge_campaigns({root_ / "b", root_ / "." / "a"}, over), ScenarioError);
  EXPECT_EQ(read_file(root_ / "a/results.bin"), before);
}

TEST_F(MergeTest, OverwritesNothing) {
  fly_shard("a", 0, 1);
  merge({"a"}, "out");
  EXPECT_THROW(merge({"a"}, "out"), ScenarioError);
}

}  // namespace
}  // namespace dodgesim
