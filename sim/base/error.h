// Errors that end a run or a throw. Messages are whole sentences for the user.
#pragma once

#include <stdexcept>
#include <string>

namespace dodgesim {

// Bad command line, scenario, model or input data. Exit code 2.
class ScenarioError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A file or directory could not be read or written. Exit code 4.
class IoError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Results lack throws. Exit code 3.
class MissingThrows : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The simulation of one throw failed (diverged state, MuJoCo error or warning). Costs that throw.
class SimulationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// There was not enough memory for one throw. Costs that throw, which can be flown again.
class MemoryError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace dodgesim
