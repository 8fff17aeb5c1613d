// Collects what is wrong with a scenario file, so that the user hears everything in one go.
#pragma once

#include <string>
#include <vector>

namespace dodgesim {

// Where something stands in a YAML file; both count from 1. {0, 0}: the file as a whole.
struct Position {
  int line = 0;
  int column = 0;
};

class Problems {
 public:
  // `file` is the file's name as the user gave it; it opens every message.
  explicit Problems(std::string file) : file_(std::move(file)) {}

  // `sentence` is one full sentence. Beyond a bounded number, further ones are only counted.
  void add(Position at, const std::string& sentence);

  // Adds the sentence and throws at once: nothing after it could be judged.
  [[noreturn]] void fail(Position at, const std::string& sentence);

  // Throws ScenarioError with one line a problem, "file:line:column: sentence", in file order.
  void raise_if_any() const;

  const std::string& file() const { return file_; }

 private:
  struct Problem {
    Position at;
    std::string sentence;
  };
  std::string file_;
  std::vector<Problem> problems_;
  int left_out_ = 0;
};

}  // namespace dodgesim
