// OBJ files, as far as MuJoCo 2.2 reads them.
#pragma once

#include <string>
#include <string_view>

namespace dodgesim {

// What is wrong with the text of an OBJ file, as "line 7: ..." without a full stop, or nothing.
std::string complaint_about_obj(std::string_view text);

}  // namespace dodgesim
