#include "sim/config/problems.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "sim/base/error.h"

namespace dodgesim {

namespace {

// More would scroll the first ones, which explain the rest, off the screen.
constexpr std::size_t kMostProblems = 20;

}  // namespace

int Problems::add_source(std::string name) {
  sources_.push_back(std::move(name));
  return static_cast<int>(sources_.size()) - 1;
}

void Problems::add(Position at, const std::string& sentence) {
  if (problems_.size() < kMostProblems) {
    problems_.push_back({at, sentence});
  } else {
    ++left_out_;
  }
}

void Problems::fail(Position at, const std::string& sentence) {
  problems_.push_back({at, sentence});
  raise_if_any();
  throw ScenarioError(sentence);  // not reached: the list is not empty
}

std::string Problems::place(Position at) const {
  const std::string& source = sources_.at(static_cast<std::size_t>(at.source));
  if (at.line == 0) return source;
  return source + ":" + std::to_string(at.line) + ":" + std::to_string(at.column);
}

void Problems::raise_if_any() const {
  if (problems_.empty()) return;
  std::vector<Problem> sorted = problems_;
  std::ranges::stable_sort(sorted, [](const Problem& a, const Problem& b) {
    return std::tie(a.at.source, a.at.line, a.at.column) <
           std::tie(b.at.source, b.at.line, b.at.column);
  });
  std::string message;
  for (const Problem& problem : sorted) {
    if (!message.empty()) message += '\n';
    message += place(problem.at) + ": " + problem.sentence;
  }
  if (left_out_ > 0) {
    message += "\n" + sources_.front() + ": and " + std::to_string(left_out_) + " more problems.";
  }
  throw ScenarioError(message);
}

}  // namespace dodgesim
