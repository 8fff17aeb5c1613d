// Commands as text.
#pragma once

#include <string>

namespace dodgesim {

// A word of a POSIX shell's command: in quotes unless it is plain.
std::string shell_quoted(const std::string& word);

}  // namespace dodgesim
