// Names and paths that are given from outside.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string_view>

namespace dodgesim {

inline bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-';
}

// A plain name of letters, digits, _ and -: as a file's name it cannot lead out of its folder.
inline bool is_plain_name(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, is_name_character);
}

// Whether the path leads to the folder or into it. Both are canonical.
inline bool is_below(const std::filesystem::path& path, const std::filesystem::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
         folder.end();
}

}  // namespace dodgesim
