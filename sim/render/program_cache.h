// Compiles and links the shaders of one OpenGL context, each program once.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>

namespace dodgesim {

// The programs live as long as that context, and keep the values of their uniforms from one user to
// the next: whoever takes a program sets them all.
class ProgramCache {
 public:
  // The GL name of the program with these sources. The context must be current, always the same
  // one. Throws SimulationError with the compiler's message.
  unsigned program(const std::string& vertex, const std::string& fragment);

  std::size_t size() const { return programs_.size(); }

 private:
  std::map<std::pair<std::string, std::string>, unsigned> programs_;  // by vertex, fragment shader
};

}  // namespace dodgesim
