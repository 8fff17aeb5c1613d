// Flies throws in forked worker processes, so that a crash costs one throw and no state leaks from
// the campaign's process (fork before anything in it has threads or a GL context).
#pragma once

#include <functional>

#include "sim/campaign/result.h"

namespace dodgesim {

// Flies one throw. ScenarioError means that no throw of this scenario can be flown; any other
// exception costs this throw.
using FlyFunction = std::function<ThrowResult(int throw_index)>;

struct WorkerTasks {
  int throws = 0;
  int jobs = 1;  // worker processes
  FlyFunction fly;
  // The result of a throw that could not be flown, with everything known before the flight.
  FlyFunction blank;
  // Receives the results in throw order, whatever the order in which they finish.
  std::function<void(ThrowResult)> receive;
  // Called after each finished throw, in the order of finishing; may be empty.
  std::function<void(int finished)> progress;
};

// Every throw is flown exactly once. A worker that dies costs its throw (status "error", naming the
// signal or exit code) and is replaced. Throws ScenarioError as `fly` does, and IoError when
// processes cannot be made; no worker survives the call.
void fly_in_workers(const WorkerTasks& tasks);

}  // namespace dodgesim
