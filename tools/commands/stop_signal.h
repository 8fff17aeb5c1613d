// The user's wish that a long command end: Ctrl-C, or the signal of a batch system.
#pragma once

namespace dodgesim {

// From now on SIGINT and SIGTERM ask for the end instead of ending the program. A second one ends
// it at once, unless it comes with the first: a supervisor such as timeout(1) sends one to the
// program and one to its group.
void watch_stop_signals();

bool asked_to_stop();

}  // namespace dodgesim
