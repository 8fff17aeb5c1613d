// Work that must leave nothing behind in this process: a crash, memory, threads.
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>

namespace dodgesim {

struct ChildAnswer {
  bool in_time = false;
  std::string said;  // its whole output; of a crash at most what came before it
};

// Runs `task` in a forked process, and listens for at most `wall_ms`; then the process is killed.
// What it prints goes nowhere, and it dies with its parent. An exception that leaves `task`
// ends it like a crash. Throws SimulationError if no process can be made.
ChildAnswer ask_child(const std::function<std::string()>& task, int wall_ms);

// In a child: lets it die with `parent`, the process that has forked it, or ends it if that has
// ended already.
void die_with(pid_t parent);

}  // namespace dodgesim
