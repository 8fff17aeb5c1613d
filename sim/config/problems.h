// Collects what is wrong with a scenario file, so that the user hears everything in one go.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace dodgesim {

// Where something stands in a YAML file; both count from 1. {0, 0}: the file as a whole.
struct Position {
  int line = 0;
  int column = 0;
  int source = 0;  // which file, or which setting of the command line: see Problems::add_source()
};

class Problems {
 public:
  struct Problem {
    Position at;
    std::string sentence;
  };

  // `file` is the file's name as the user gave it; it opens every message.
  explicit Problems(std::string file) : sources_{std::move(file)} {}

  // Another file, or a setting of the command line, that the scenario is made of. Returns its
  // number for Position::source; that of the file itself is 0.
  int add_source(std::string name);

  // `sentence` is one full sentence. Beyond a bounded number, further ones are only counted.
  void add(Position at, const std::string& sentence);

  // Adds the sentence and throws at once: nothing after it could be judged.
  [[noreturn]] void fail(Position at, const std::string& sentence);

  // Throws ScenarioError with one line a problem, "file:line:column: sentence", in the
  // order of the sources and of their lines.
  void raise_if_any() const;

  // "file:line:column", or "file" alone.
  std::string place(Position at) const;

  const std::vector<Problem>& all() const { return problems_; }  // but those that are only counted

 private:
  std::vector<std::string> sources_;
  std::vector<Problem> problems_;
  int left_out_ = 0;
};

}  // namespace dodgesim
