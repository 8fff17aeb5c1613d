// Flies throws in forked worker processes, so that a crash, a hang or a lack of memory costs one
// throw and no state leaks from the campaign's process (fork before anything in it has threads or a
// GL context). A worker ends with the process that forked it, however that ends.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "sim/campaign/result.h"

namespace dodgesim {

// Flies one throw. ScenarioError means that no throw of this scenario can be flown; any other
// exception costs this throw.
using FlyFunction = std::function<ThrowResult(int throw_index)>;

struct WorkerLimits {
  double wall_s = 0;           // a throw that takes longer is given up; 0: none
  std::int64_t memory_mb = 0;  // address space of a worker; 0: none
};

struct WorkerTasks {
  std::vector<int> throws;  // their numbers, in the order in which they are begun
  int jobs = 1;             // worker processes
  WorkerLimits limits;
  FlyFunction fly;
  // The result of a throw that could not be flown, with everything known before the flight.
  FlyFunction blank;
  // Receives the results in the order in which they finish.
  std::function<void(ThrowResult)> receive;
  // Asked several times a second: whether to stop, giving up the throws in flight. May be empty.
  std::function<bool()> stop;
};

// Resident memory of the workers [MB], means over them; 0 without workers.
struct WorkerMemory {
  double first_mb = 0;  // after a worker's first throw
  double last_mb = 0;   // after its last one
};

// Every throw is flown exactly once. A worker that dies or takes too long costs its throw (status
// "lost", saying why) and is replaced. Throws ScenarioError as `fly` does, IoError when processes
// cannot be made, and whatever `receive` does; no worker survives the call.
WorkerMemory fly_in_workers(const WorkerTasks& tasks);

}  // namespace dodgesim
