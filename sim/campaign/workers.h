// Flies throws in forked worker processes, so that a crash, a hang or a lack of memory costs one
// throw and no state leaks from the campaign's process (fork before anything in it has threads or a
// GL context). A worker ends with the process that forked it, however that ends.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "sim/outcome/result.h"

namespace dodgesim {

// A throw of one of several campaigns.
struct Task {
  int campaign = 0;
  int throw_index = 0;
};

struct WorkerLimits {
  double wall_s = 0;           // a throw that takes longer is given up; 0: none
  std::int64_t memory_mb = 0;  // address space of a worker; 0: none
};

struct WorkerTasks {
  // What to fly next; nothing when there is no more. Asked whenever a worker has nothing to do,
  // after its result was received.
  std::function<std::optional<Task>()> next;
  int jobs = 1;  // worker processes
  WorkerLimits limits;
  // Flies one throw. ScenarioError means that no throw of this scenario can be flown; any other
  // exception costs this throw.
  std::function<ThrowResult(const Task&)> fly;
  // The result of a throw that could not be flown, with everything known before the flight.
  std::function<ThrowResult(const Task&)> blank;
  // Receives the results in the order in which they finish, while a worker waits.
  std::function<void(const Task&, const ThrowResult&)> receive;
  // Called when all workers have their next throws: for work that takes longer. May be empty.
  std::function<void()> meanwhile;
  // Asked several times a second: whether to stop, giving up the throws in flight. May be empty.
  std::function<bool()> stop;
};

// Resident memory of the workers [MB], means over them; 0 without workers.
struct WorkerMemory {
  double first_mb = 0;  // after a worker's first throw
  double last_mb = 0;   // after its last one
};

// Every throw that next() gives is flown exactly once. A worker that dies or takes too long costs
// its throw (status "lost", saying why) and is replaced. Throws ScenarioError as `fly` does,
// IoError when processes cannot be made, and whatever next, receive and meanwhile do; no worker
// survives the call.
WorkerMemory fly_in_workers(const WorkerTasks& tasks);

}  // namespace dodgesim
