// The user's wish that a long command end: Ctrl-C, a closed terminal, or a batch system's signal.
#pragma once

namespace dodgesim {

// From now on SIGINT, SIGTERM and, unless it is ignored, SIGHUP ask for the end instead of ending
// the program. A second one ends it at once, unless it comes with the first: a supervisor such as
// timeout(1) sends one to the program and one to its group.
void watch_stop_signals();

// Back to the default, where nothing asks for the end.
void watch_stop_signals_no_more();

bool asked_to_stop();
// Throws std::runtime_error then: for commands that write all or nothing.
void end_if_asked_to_stop();

}  // namespace dodgesim
