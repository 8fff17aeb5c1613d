#include "sim/gate/baseline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <iterator>

#include "sim/base/error.h"
#include "sim/base/input_file.h"
#include "sim/files/json.h"
#include "sim/files/output_file.h"
#include "tests/sim/files/temporary_directory.h"
#include "tests/sim/gate/outcomes_fixture.h"

namespace dodgesim {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr const char* kManifest =
    R"({"program": {"commit": "abc", "compiler": "g++", "build_type": "Release"},
        "libraries": {"mujoco": "2.2"}, "machine": {"cpu_flags": "sse avx"},
        "time": {"wall_s": 3}})";

class BaselineTest : public ::testing::Test {
 protected:
  BaselineTest() {
    fs::create_directories(campaign_);
    write("throws.csv", "throw\n0\n");
    write("objects.csv", "throw\n0\n");
    write("scenario.resolved.yaml", "seed: 1\n");
    write("table.md", "# t\n");
    write("manifest.json", kManifest);
  }

  void write(const char* name, const std::string& text) { write_file(campaign_ / name, text); }

  const testing::TemporaryDirectory directory_;
  const fs::path campaign_ = directory_ / "campaign", baseline_ = directory_ / "baselines/b";
};

TEST_F(BaselineTest, ReadsBackWhatWasMade) {
  write_baseline(baseline_, campaign_, {0.1, 0.9, "all"});
  const Baseline baseline = read_baseline(baseline_);
  EXPECT_EQ(baseline.tables.throws.rows(), 1U);
  EXPECT_EQ(baseline.scenario, "seed: 1\n");
  EXPECT_EQ(baseline.commit, "abc");
  EXPECT_EQ(baseline.rules.margin, 0.1);
  EXPECT_EQ(baseline.rules.confidence, 0.9);
  EXPECT_EQ(baseline.rules.must_equal, "all");
  EXPECT_EQ(baseline.machine_kind, machine_kind(campaign_));
}

TEST_F(BaselineTest, ReplacesAnEarlierOneAndNothingElse) {
  const fs::path with_slash = baseline_ / "";
  write_baseline(with_slash, campaign_, {});
  write_file(baseline_ / "README.md", "why these throws");
  write("throws.csv", "throw\n0\n1\n");
  write_baseline(with_slash, campaign_, {});
  EXPECT_EQ(read_baseline(baseline_).tables.throws.rows(), 2U);
  EXPECT_EQ(std::distance(fs::directory_iterator(directory_ / "baselines"), {}), 1)
      << "nothing is left beside it";
  EXPECT_EQ(std::distance(fs::directory_iterator(baseline_), {}), 6);
}

TEST_F(BaselineTest, KeepsTheEarlierOneWhenTheCampaignIsBroken) {
  write_baseline(baseline_, campaign_, {});
  fs::remove(campaign_ / "table.md");
  EXPECT_THROW(write_baseline(baseline_, campaign_, {0.2, 0.95, "all"}), IoError);
  EXPECT_EQ(read_baseline(baseline_).rules.must_equal, "physics");
}

// The largest file is not the first: none may have its name before the last is written.
TEST_F(BaselineTest, KeepsTheEarlierOneWhenAFileCannotBeWritten) {
  write_baseline(baseline_, campaign_, {});
  write("throws.csv", "throw\n0\n1\n");
  write("table.md", std::string(8192, 't'));
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = 4096;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ::setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_THROW(write_baseline(baseline_, campaign_, {}), IoError);
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(read_baseline(baseline_).tables.throws.rows(), 1U);
}

TEST_F(BaselineTest, SaysWhatIsBroken) {
  write_baseline(baseline_, campaign_, {});
  write_file(baseline_ / "manifest.json", "{");
  EXPECT_THAT([&] { read_baseline(baseline_); },
              ThrowsMessage<IoError>(HasSubstr("manifest.json is no manifest of a campaign")));
  write_file(baseline_ / "manifest.json", kManifest);
  EXPECT_THAT([&] { read_baseline(baseline_); },
              ThrowsMessage<IoError>(HasSubstr("manifest.json: gate.margin is missing.")));
  const auto with = [&](const std::string& key, const std::string& value) {
    write_baseline(baseline_, campaign_, {});
    auto manifest = parse_json(read_file(baseline_ / "manifest.json"));
    const auto dot = key.find('.');
    manifest[key.substr(0, dot)][key.substr(dot + 1)] = parse_json(value);
    write_file(baseline_ / "manifest.json", to_text(manifest));
    return [this] { read_baseline(baseline_); };
  };
  EXPECT_THAT(with("gate.margin", "\"x\""),
              ThrowsMessage<IoError>(HasSubstr("gate.margin must be a number, not \"x\".")));
  EXPECT_THAT(with("program.commit", "null"),
              ThrowsMessage<IoError>(HasSubstr("program.commit must be a text, not null.")));
  EXPECT_THROW(read_baseline(directory_ / "nothing"), IoError);
}

TEST_F(BaselineTest, RefusesWhatCannotBeJudgedBy) {
  const auto complaint_about = [&](const GateRules& rules) {
    write_baseline(baseline_, campaign_, rules);
    try {
      read_baseline(baseline_);
    } catch (const IoError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(complaint_about({}), "");
  EXPECT_THAT(complaint_about({5, 0.95, "all"}), HasSubstr("gate.margin must be at least 0"));
  EXPECT_THAT(complaint_about({0.1, 0, "all"}), HasSubstr("gate.confidence must be between"));
  EXPECT_THAT(complaint_about({0.1, 0.9, "phisics"}), HasSubstr("gate.must_equal must be nothing"));
  write("throws.csv", "throw\n0\n0\n");
  EXPECT_THAT(complaint_about({}), HasSubstr("throws.csv:3: Throw 0 stands where throw 1 must"));
}

TEST_F(BaselineTest, IsKnownEvenWhenItIsBroken) {
  EXPECT_FALSE(holds_baseline_files(baseline_));
  EXPECT_FALSE(is_marked_as_baseline(baseline_));
  write_baseline(baseline_, campaign_, {0.1, 0.9, "all"});
  fs::remove(baseline_ / "throws.csv");
  EXPECT_THROW(read_baseline(baseline_), IoError);
  EXPECT_TRUE(holds_baseline_files(baseline_));
  EXPECT_TRUE(is_marked_as_baseline(baseline_));
  EXPECT_EQ(rules_or_default(baseline_).must_equal, "all");
  write_file(baseline_ / "manifest.json", R"({"gate": {"margin": 7, <<<<<<<)");
  EXPECT_TRUE(is_marked_as_baseline(baseline_));
  EXPECT_EQ(rules_or_default(baseline_).must_equal, "physics");
}

TEST_F(BaselineTest, IsNotTakenForACampaign) {
  write("manifest.json", R"({"campaign": {"scenario": "gate", "command_line": "\"gate\": 1"}})");
  EXPECT_TRUE(holds_baseline_files(campaign_));
  EXPECT_FALSE(is_marked_as_baseline(campaign_));
}

TEST_F(BaselineTest, TellsKindsOfMachinesApart) {
  const std::string kind = machine_kind(campaign_);
  write("manifest.json",
        std::string(kManifest).replace(std::string(kManifest).find("avx"), 3, "neon"));
  EXPECT_NE(machine_kind(campaign_), kind);
}

}  // namespace
}  // namespace dodgesim
