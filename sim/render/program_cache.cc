#include "sim/render/program_cache.h"

#include <GL/gl.h>
#include <GL/glext.h>

#include "sim/base/error.h"

namespace dodgesim {

namespace {

// `good`: what OpenGL says of it; `log`: glGetShaderInfoLog or glGetProgramInfoLog.
template <class Log>
void check(GLint good, GLuint object, const Log& log, const std::string& step) {
  if (good) return;
  char message[2000] = "";
  log(object, sizeof message, nullptr, message);
  throw SimulationError("A shader of the renderer does not " + step + ": " + message);
}

GLuint compile(GLenum stage, const std::string& source) {
  const GLuint shader = glCreateShader(stage);
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  check(good, shader, glGetShaderInfoLog, "compile");
  return shader;
}

GLuint link_program(const std::string& vertex, const std::string& fragment) {
  const GLuint program = glCreateProgram();
  const GLuint shaders[] = {compile(GL_VERTEX_SHADER, vertex),
                            compile(GL_FRAGMENT_SHADER, fragment)};
  for (const GLuint shader : shaders) {
    glAttachShader(program, shader);
    glDeleteShader(shader);  // lives on with the program
  }
  glLinkProgram(program);
  GLint good = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  check(good, program, glGetProgramInfoLog, "link");
  return program;
}

}  // namespace

unsigned ProgramCache::program(const std::string& vertex, const std::string& fragment) {
  const std::pair sources(vertex, fragment);
  const auto known = programs_.find(sources);
  if (known != programs_.end()) return known->second;
  return programs_[sources] = link_program(vertex, fragment);
}

}  // namespace dodgesim
