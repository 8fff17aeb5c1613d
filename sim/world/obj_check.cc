#include "sim/world/obj_check.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "sim/base/numbers.h"

namespace dodgesim {

namespace {

// Takes what comes before one of `ends` off `rest`, and that end.
std::string_view take_until(std::string_view& rest, std::string_view ends) {
  const std::string_view taken = rest.substr(0, rest.find_first_of(ends));
  rest.remove_prefix(std::min(taken.size() + 1, rest.size()));
  return taken;
}

// The next line, which ends as those of any system.
std::string_view take_line(std::string_view& rest) {
  const std::string_view line = rest.substr(0, rest.find_first_of("\r\n"));
  rest.remove_prefix(line.size());
  rest.remove_prefix(rest.starts_with("\r\n") ? 2 : std::min<std::size_t>(rest.size(), 1));
  return line;
}

// The next word of a line, empty at its end.
std::string_view take_word(std::string_view& line) {
  constexpr std::string_view kBlanks = " \t";
  line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
  return take_until(line, kBlanks);
}

bool is_finite_number(std::string_view word) {
  const NumberForm form = number_form(word);
  return form != NumberForm::kNone && form != NumberForm::kNotFinite && parse_double(word);
}

struct Kind {
  std::string_view keyword, name;
  int numbers;  // that MuJoCo reads of each
};
// A corner of a face names one of each: "vertex/texture coordinate/normal".
constexpr std::array<Kind, 3> kKinds = {
    {{"v", "vertex", 3}, {"vt", "texture coordinate", 2}, {"vn", "normal", 3}}};
using Counts = std::array<std::int64_t, 3>;

// Adds to what there is of each kind what a line that begins with `keyword` brings.
const Kind* count(std::string_view keyword, Counts& counts) {
  for (std::size_t k = 0; k < kKinds.size(); ++k) {
    if (keyword != kKinds[k].keyword) continue;
    ++counts[k];
    return &kKinds[k];
  }
  return nullptr;
}

// Checks line by line a text that has `totals` of each kind. An empty complaint is none.
class ObjCheck {
 public:
  explicit ObjCheck(const Counts& totals) : totals_(totals) {}

  std::string check(std::string_view line) {
    const char* const end = line.data() + line.size();
    const std::string_view keyword = take_word(line);
    if (const Kind* kind = count(keyword, so_far_)) return check_numbers(*kind, line);
    const bool is_bare = keyword.data() + keyword.size() == end;  // then MuJoCo passes it over
    if ((keyword == "o" || keyword == "g") && !is_bare) part_ended_ = has_faces_;
    return keyword == "f" ? check_face(line) : "";
  }

 private:
  static std::string check_numbers(const Kind& kind, std::string_view line) {
    for (int i = 0; i < kind.numbers; ++i) {
      const std::string_view word = take_word(line);
      if (word.empty()) {
        return "a " + std::string(kind.name) + " has " + std::to_string(kind.numbers) + " numbers";
      }
      if (!is_finite_number(word)) {
        return "'" + std::string(word) + "' is not a finite number";
      }
    }
    return "";
  }

  std::string check_face(std::string_view line) {
    if (part_ended_) {
      return "a second object or group has faces, but MuJoCo reads those of the first alone: join "
             "them";
    }
    has_faces_ = true;
    for (std::string_view corner = take_word(line); !corner.empty() && corner[0] != '#';
         corner = take_word(line)) {
      const std::string complaint = check_corner(corner);
      if (!complaint.empty()) return "the face's corner '" + std::string(corner) + "' " + complaint;
    }
    return "";
  }

  std::string check_corner(std::string_view corner) const {
    for (std::size_t k = 0; k < kKinds.size(); ++k) {
      const std::string_view index = take_until(corner, "/");
      if (index.empty() && totals_[k] == 0) continue;
      const std::int64_t number = parse_integer<std::int64_t>(index).value_or(0);
      const std::int64_t count = number < 0 ? so_far_[k] : totals_[k];
      if (number != 0 && number >= -count && number <= count) continue;
      const std::string name(kKinds[k].name);
      if (index.empty()) return "names no " + name + ", though the file has some";
      if (number == 0) return "names no " + name + ": they are counted from 1, or back from -1";
      return "names a " + name + " that does not exist: the file has " + std::to_string(count) +
             (number < 0 ? " so far" : "");
    }
    return corner.empty() ? "" : "has more than three parts";
  }

  Counts totals_, so_far_{};
  bool has_faces_ = false, part_ended_ = false;
};

}  // namespace

std::string complaint_about_obj(std::string_view text) {
  Counts totals{};
  for (std::string_view rest = text; !rest.empty();) {
    std::string_view line = take_line(rest);
    count(take_word(line), totals);
  }
  ObjCheck lines(totals);
  int number = 0;
  for (std::string_view rest = text; !rest.empty();) {
    ++number;
    const std::string complaint = lines.check(take_line(rest));
    if (!complaint.empty()) return "line " + std::to_string(number) + ": " + complaint;
  }
  constexpr int kOfSolid = 4;
  if (totals[0] >= kOfSolid) return "";
  return "line " + std::to_string(number) + ": the file ends after " + std::to_string(totals[0]) +
         " vertices, but a solid has at least " + std::to_string(kOfSolid);
}

}  // namespace dodgesim
