// Runs the program as its users do.
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

namespace dodgesim::testing {

struct Outcome {
  int exit_code = -1;
  std::string output;  // standard output and error
};

// Of a shell's command.
inline Outcome shell(const std::string& command) {
  FILE* pipe = ::popen((command + " 2>&1 </dev/null").c_str(), "r");
  Outcome outcome;
  std::array<char, 4096> buffer;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe)) {
    outcome.output.append(buffer.data(), n);
  }
  const int status = ::pclose(pipe);
  if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
  return outcome;
}

inline Outcome dodgesim(const std::string& arguments) {
  return shell(std::string(DODGESIM_BINARY_DIR) + "/dodgesim " + arguments);
}

}  // namespace dodgesim::testing
