#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string>

#include "sim/world/obj_check.h"
#include "tests/fuzz/inputs.h"

namespace dodgesim::fuzz {

bool mesh(Bytes bytes) {
  if (!complaint_about_obj(text_of(bytes)).empty()) return false;
  long vertices = 0, least = 1, most = 0;
  std::string text(text_of(bytes));
  std::ranges::replace(text, '\r', '\n');
  for (const char blank : {'\v', '\f'}) std::ranges::replace(text, blank, '_');  // no blanks in OBJ
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") ++vertices;
    if (word != "f") continue;
    while (words >> word && word[0] != '#') {
      const long index = std::atol(word.c_str());
      require(index != 0, "a corner names a vertex");
      require(index >= -vertices, "and one that was there, counted back");
      least = std::min(least, index);
      most = std::max(most, index);
    }
  }
  require(vertices >= 4, "a solid has four vertices");
  require(most <= vertices && least >= -vertices, "and faces of no others");
  return true;
}

}  // namespace dodgesim::fuzz
