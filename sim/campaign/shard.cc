#include "sim/campaign/shard.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "sim/base/error.h"

namespace dodgesim {

namespace {

constexpr int kMostShards = 1000000;

std::optional<int> number(const std::string& text) {
  int value = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end || value < 0) return std::nullopt;
  return value;
}

[[noreturn]] void refuse(const std::string& text, const std::string& reason) {
  throw ScenarioError("--shard " + text + ": " + reason + ".");
}

// The number in an environment variable; nothing if there is no such variable.
std::optional<int> find(const Environment& environment, const std::string& text, const char* name) {
  const char* const value = environment(name);
  if (value == nullptr) return std::nullopt;
  const auto found = number(value);
  if (!found) refuse(text, std::string(name) + " is \"" + value + "\", which is no number");
  return found;
}

int index_from(const Environment& environment, const std::string& text) {
  if (const auto task = find(environment, text, "SLURM_ARRAY_TASK_ID")) {
    const int from_first = *task - find(environment, text, "SLURM_ARRAY_TASK_MIN").value_or(0);
    const int step = std::max(1, find(environment, text, "SLURM_ARRAY_TASK_STEP").value_or(1));
    if (from_first % step == 0) return from_first / step;
    refuse(text, "SLURM_ARRAY_TASK_ID is no task of an array of the step " + std::to_string(step));
  }
  for (const char* name : {"JOB_COMPLETION_INDEX", "AWS_BATCH_JOB_ARRAY_INDEX"}) {
    if (const auto index = find(environment, text, name)) return *index;
  }
  refuse(text,
         "none of SLURM_ARRAY_TASK_ID, JOB_COMPLETION_INDEX and AWS_BATCH_JOB_ARRAY_INDEX is "
         "set");
}

}  // namespace

Shard parse_shard(const std::string& text, const Environment& environment) {
  const std::size_t slash = text.find('/');
  const std::string first = text.substr(0, slash);
  const bool automatic = first == "auto";
  std::optional<int> count;
  if (slash != std::string::npos) {
    count = number(text.substr(slash + 1));
    const auto tasks = automatic ? find(environment, text, "SLURM_ARRAY_TASK_COUNT") : std::nullopt;
    if (count && tasks && tasks != count) {
      refuse(text, "the array has " + std::to_string(*tasks) +
                       " tasks, so which part is this one's cannot be told; give its INDEX");
    }
  } else if (automatic) {
    count = find(environment, text, "SLURM_ARRAY_TASK_COUNT");
    if (!count) refuse(text, "SLURM_ARRAY_TASK_COUNT is not set; say auto/COUNT");
  }
  if (!count || *count < 1 || *count > kMostShards || (!automatic && !number(first))) {
    refuse(text,
           "must be INDEX/COUNT with 0 <= INDEX < COUNT, auto/COUNT or auto, and COUNT at most " +
               std::to_string(kMostShards));
  }
  const int index = automatic ? index_from(environment, text) : *number(first);
  if (index < 0 || index >= *count) {
    refuse(text, "there is no shard " + std::to_string(index) + " of " + std::to_string(*count) +
                     "; the first is 0");
  }
  return {index, *count};
}

}  // namespace dodgesim
