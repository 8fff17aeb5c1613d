#include "tools/commands/stop_signal.h"

#include <csignal>
#include <ctime>
#include <stdexcept>

namespace dodgesim {

namespace {

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};

volatile std::sig_atomic_t stop_signal = 0;
timespec stopped_at{};  // the handler's own

void ask_to_stop(int signal) {
  constexpr double kNsPerS = 1e9;
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  const double since_s = static_cast<double>(now.tv_sec - stopped_at.tv_sec) +
                         static_cast<double>(now.tv_nsec - stopped_at.tv_nsec) / kNsPerS;
  if (stop_signal == 0) {
    stop_signal = signal;
    stopped_at = now;
  } else if (since_s > 1) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

}  // namespace

void watch_stop_signals() {
  struct sigaction action {};
  action.sa_handler = ask_to_stop;
  for (const int signal : kSignals) sigaddset(&action.sa_mask, signal);
  for (const int signal : kSignals) {
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    // Under nohup, which ignores it, the program goes on without its terminal.
    if (signal == SIGHUP && before.sa_handler == SIG_IGN) continue;
    ::sigaction(signal, &action, nullptr);
  }
}

void watch_stop_signals_no_more() {
  for (const int signal : kSignals) {
    struct sigaction now {};
    ::sigaction(signal, nullptr, &now);
    if (now.sa_handler == ask_to_stop) std::signal(signal, SIG_DFL);
  }
}

bool asked_to_stop() { return stop_signal != 0; }

void end_if_asked_to_stop() {
  if (asked_to_stop()) throw std::runtime_error("Stopped; nothing is written.");
}

}  // namespace dodgesim
