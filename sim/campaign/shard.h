// Parts of a campaign that are flown by different processes, perhaps on different machines.
#pragma once

#include <functional>
#include <string>

namespace dodgesim {

// The throws whose number leaves the remainder `index` when divided by `count`.
struct Shard {
  int index = 0, count = 1;
};

// The value of an environment variable, null if there is none.
using Environment = std::function<const char*(const char* name)>;

// "3/8" is the fourth of eight. "auto/8" takes the number from SLURM_ARRAY_TASK_ID (less
// SLURM_ARRAY_TASK_MIN), JOB_COMPLETION_INDEX (Kubernetes) or AWS_BATCH_JOB_ARRAY_INDEX; "auto"
// also takes the count from SLURM_ARRAY_TASK_COUNT. Throws ScenarioError.
Shard parse_shard(const std::string& text, const Environment& environment);

}  // namespace dodgesim
