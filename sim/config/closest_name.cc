#include "sim/config/closest_name.h"

#include <algorithm>

namespace dodgesim {

namespace {

// Damerau-Levenshtein distance (neighbours swapped count once), at most the longer length.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replace = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + replace});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
      }
    }
  }
  return d[a.size()][b.size()];
}

}  // namespace

std::string closest_name(const std::string& word, const std::vector<std::string>& candidates) {
  constexpr std::size_t kLongestWord = 64;
  if (word.empty() || word.size() > kLongestWord) return "";
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(1, (word.size() + 1) / 3) + 1;
  for (const std::string& candidate : candidates) {
    const bool only_unit_missing = candidate.starts_with(word + "_");
    const std::size_t distance = only_unit_missing ? 1 : edit_distance(word, candidate);
    if (distance >= best_distance) continue;
    best_distance = distance;
    best = candidate;
  }
  return best;
}

std::string name_with(const std::string& word, const std::vector<std::string>& candidates) {
  for (const std::string& candidate : candidates) {
    if (("_" + candidate + "_").find("_" + word + "_") != std::string::npos) return candidate;
  }
  return "";
}

std::string did_you_mean(const std::string& name) {
  return name.empty() ? "." : "; did you mean " + name + "?";
}

std::vector<std::string> models_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".xml") names.push_back(entry.path().stem().string());
  }
  std::ranges::sort(names);
  return names;
}

std::string last_part(const std::string& path) { return path.substr(path.rfind('.') + 1); }

std::string closest_key(const std::string& word, const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    if (last_part(path) == word) return path;
  }
  std::string near = closest_name(word, paths);
  if (!near.empty()) return near;
  std::vector<std::string> last_parts;
  last_parts.reserve(paths.size());
  for (const std::string& path : paths) last_parts.push_back(last_part(path));
  const std::string part = closest_name(word, last_parts);
  return part.empty() ? "" : closest_key(part, paths);
}

}  // namespace dodgesim
