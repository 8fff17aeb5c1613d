#include "sim/render/program_cache.h"

#include "sim/base/error.h"
#include "sim/render/gl.h"

namespace dodgesim {

namespace {

// `good`: what OpenGL says of it; `log`: gl::GetShaderInfoLog or gl::GetProgramInfoLog.
template <class Log>
void check(GLint good, GLuint object, const Log& log, const std::string& step) {
  if (good) return;
  char message[2000] = "";
  log(object, sizeof message, nullptr, message);
  throw SimulationError("A shader of the renderer does not " + step + ": " + message);
}

GLuint compile(GLenum stage, const std::string& source) {
  const GLuint shader = gl::CreateShader(stage);
  const char* text = source.c_str();
  gl::ShaderSource(shader, 1, &text, nullptr);
  gl::CompileShader(shader);
  GLint good = 0;
  gl::GetShaderiv(shader, GL_COMPILE_STATUS, &good);
  check(good, shader, gl::GetShaderInfoLog, "compile");
  return shader;
}

GLuint link_program(const std::string& vertex, const std::string& fragment) {
  const GLuint program = gl::CreateProgram();
  const GLuint shaders[] = {compile(GL_VERTEX_SHADER, vertex),
                            compile(GL_FRAGMENT_SHADER, fragment)};
  for (const GLuint shader : shaders) {
    gl::AttachShader(program, shader);
    gl::DeleteShader(shader);  // lives on with the program
  }
  gl::LinkProgram(program);
  GLint good = 0;
  gl::GetProgramiv(program, GL_LINK_STATUS, &good);
  check(good, program, gl::GetProgramInfoLog, "link");
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
