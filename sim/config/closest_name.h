// Suggestions for misspelled keys.
#pragma once

#include <string>
#include <vector>

namespace dodgesim {

// The name in `candidates` that `word` most likely misspells, or empty. Counts insertions,
// deletions, replacements and swaps of neighbours; a missing unit (size for size_m) is always
// recognised.
std::string closest_name(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace dodgesim
