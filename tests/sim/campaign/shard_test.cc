#include "sim/campaign/shard.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "sim/base/error.h"
#include "tests/complaint.h"

namespace dodgesim {
namespace {

using Variables = std::map<std::string, std::string>;

Shard parsed(const std::string& text, const Variables& variables = {}) {
  return parse_shard(text, [&](const char* name) {
    const auto found = variables.find(name);
    return found == variables.end() ? nullptr : found->second.c_str();
  });
}

std::string refusal(const std::string& text, const Variables& variables = {}) {
  return testing::complaint<ScenarioError>([&] { parsed(text, variables); });
}

TEST(Shard, IsIndexAndCount) {
  EXPECT_EQ(parsed("3/8").index, 3);
  EXPECT_EQ(parsed("3/8").count, 8);
  EXPECT_EQ(parsed("0/1").count, 1);
}

TEST(Shard, IsTakenFromTheEnvironmentOfAnArrayJob) {
  EXPECT_EQ(parsed("auto/8", {{"JOB_COMPLETION_INDEX", "5"}}).index, 5);
  EXPECT_EQ(parsed("auto/8", {{"AWS_BATCH_JOB_ARRAY_INDEX", "7"}}).index, 7);
  const Variables slurm = {
      {"SLURM_ARRAY_TASK_ID", "4"}, {"SLURM_ARRAY_TASK_MIN", "1"}, {"SLURM_ARRAY_TASK_COUNT", "6"}};
  EXPECT_EQ(parsed("auto", slurm).index, 3);
  EXPECT_EQ(parsed("auto", slurm).count, 6);
  EXPECT_EQ(parsed("auto/6", slurm).index, 3);
  // --array=2-8:3
  Variables stepped = {{"SLURM_ARRAY_TASK_MIN", "2"},
                       {"SLURM_ARRAY_TASK_COUNT", "3"},
                       {"SLURM_ARRAY_TASK_STEP", "3"}};
  for (const int shard : {0, 1, 2}) {
    stepped["SLURM_ARRAY_TASK_ID"] = std::to_string(2 + 3 * shard);
    EXPECT_EQ(parsed("auto", stepped).index, shard);
  }
}

TEST(Shard, RefusesWhatIsNone) {
  for (const char* text : {"", "3", "8/8", "-1/8", "1/0", "a/8", "1/b", "1/8/2", "1.5/8", "/8",
                           "1/", "99999999999/2", "0/99999999999"}) {
    EXPECT_THAT(refusal(text), ::testing::HasSubstr("--shard")) << text;
  }
  EXPECT_THAT(refusal("auto/8"), ::testing::HasSubstr("none of SLURM_ARRAY_TASK_ID"));
  EXPECT_THAT(refusal("auto", {{"SLURM_ARRAY_TASK_ID", "1"}}),
              ::testing::HasSubstr("SLURM_ARRAY_TASK_COUNT is not set"));
  // Only task 5 was submitted again.
  const Variables again = {
      {"SLURM_ARRAY_TASK_ID", "5"}, {"SLURM_ARRAY_TASK_MIN", "5"}, {"SLURM_ARRAY_TASK_COUNT", "1"}};
  EXPECT_THAT(refusal("auto/8", again), ::testing::HasSubstr("the array has 1 tasks"));
  const Variables uneven = {{"SLURM_ARRAY_TASK_ID", "4"},
                            {"SLURM_ARRAY_TASK_MIN", "1"},
                            {"SLURM_ARRAY_TASK_COUNT", "3"},
                            {"SLURM_ARRAY_TASK_STEP", "2"}};
  EXPECT_THAT(refusal("auto", uneven), ::testing::HasSubstr("of an array of the step 2"));
  EXPECT_THAT(refusal("auto/8", {{"JOB_COMPLETION_INDEX", "x"}}),
              ::testing::HasSubstr("which is no number"));
  EXPECT_THAT(refusal("auto/8", {{"JOB_COMPLETION_INDEX", "8"}}),
              ::testing::HasSubstr("there is no shard 8 of 8"));
}

}  // namespace
}  // namespace dodgesim
