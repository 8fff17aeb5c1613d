// Suggestions for misspelled keys.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dodgesim {

// The name in `candidates` that `word` most likely misspells, or empty. Counts insertions,
// deletions, replacements and swaps of neighbours; a missing unit (size for size_m) is always
// recognised.
std::string closest_name(const std::string& word, const std::vector<std::string>& candidates);

// The first name in `candidates` of which `word` is one or several whole words, or empty:
// launch_height_m for height.
std::string name_with(const std::string& word, const std::vector<std::string>& candidates);

// The end of a sentence about a name that is none: "; did you mean size_m?", or "." for no name.
std::string did_you_mean(const std::string& name);

// The names of the models in a folder, to choose from: its .xml files; none if there is no folder.
std::vector<std::string> models_in(const std::filesystem::path& folder);

// "size_m" of "throw.size_m".
std::string last_part(const std::string& path);

// The dotted path that `word` most likely means: one that ends so, or one that it misspells as a
// whole or in its last part; or empty.
std::string closest_key(const std::string& word, const std::vector<std::string>& paths);

}  // namespace dodgesim
