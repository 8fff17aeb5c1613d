// The functions of OpenGL 3.3 and OSMesa that the project calls: gl::Enable is glEnable.
//
// OSMesa is loaded when the first of them is called. With LLVM behind it that takes a tenth of a
// second, and most commands draw nothing.
#pragma once

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>
#include <GL/osmesa.h>

#include <atomic>
#include <string>

namespace dodgesim {

// Throws SimulationError if OSMesa lacks the function, ScenarioError if it is not there, and as
// refuse_osmesa() if it cannot be loaded.
void* find_in_osmesa(const char* function);

// Says what OSMesa cannot do, which is no throw's fault. Throws MemoryError where a limit of memory
// may be the reason, ScenarioError otherwise.
[[noreturn]] void refuse_osmesa(const std::string& what);

template <class Signature>
class OsmesaFunction;

template <class Result, class... Arguments>
class OsmesaFunction<Result(Arguments...)> {
 public:
  explicit constexpr OsmesaFunction(const char* name) : name_(name) {}

  Result operator()(Arguments... arguments) const {
    void* function = function_.load(std::memory_order_relaxed);
    if (!function) function_ = function = find_in_osmesa(name_);
    return reinterpret_cast<Result (*)(Arguments...)>(function)(arguments...);
  }

 private:
  const char* name_;
  mutable std::atomic<void*> function_ = nullptr;
};

#define DODGESIM_OSMESA(space, name) \
  inline const OsmesaFunction<decltype(::space##name)> name(#space #name)

namespace osmesa {
DODGESIM_OSMESA(OSMesa, CreateContextAttribs);
DODGESIM_OSMESA(OSMesa, CreateContextExt);
DODGESIM_OSMESA(OSMesa, DestroyContext);
DODGESIM_OSMESA(OSMesa, GetCurrentContext);
DODGESIM_OSMESA(OSMesa, MakeCurrent);
}  // namespace osmesa

namespace gl {
DODGESIM_OSMESA(gl, ActiveTexture);
DODGESIM_OSMESA(gl, AttachShader);
DODGESIM_OSMESA(gl, BindBuffer);
DODGESIM_OSMESA(gl, BindFramebuffer);
DODGESIM_OSMESA(gl, BindTexture);
DODGESIM_OSMESA(gl, BindVertexArray);
DODGESIM_OSMESA(gl, BlendFunc);
DODGESIM_OSMESA(gl, BufferData);
DODGESIM_OSMESA(gl, BufferSubData);
DODGESIM_OSMESA(gl, CheckFramebufferStatus);
DODGESIM_OSMESA(gl, Clear);
DODGESIM_OSMESA(gl, ClearBufferiv);
DODGESIM_OSMESA(gl, ColorMask);
DODGESIM_OSMESA(gl, CompileShader);
DODGESIM_OSMESA(gl, CopyTexSubImage2D);
DODGESIM_OSMESA(gl, CreateProgram);
DODGESIM_OSMESA(gl, CreateShader);
DODGESIM_OSMESA(gl, DeleteBuffers);
DODGESIM_OSMESA(gl, DeleteFramebuffers);
DODGESIM_OSMESA(gl, DeleteShader);
DODGESIM_OSMESA(gl, DeleteTextures);
DODGESIM_OSMESA(gl, DeleteVertexArrays);
DODGESIM_OSMESA(gl, DepthFunc);
DODGESIM_OSMESA(gl, DepthMask);
DODGESIM_OSMESA(gl, Disable);
DODGESIM_OSMESA(gl, DrawArrays);
DODGESIM_OSMESA(gl, DrawArraysInstanced);
DODGESIM_OSMESA(gl, DrawBuffers);
DODGESIM_OSMESA(gl, DrawElements);
DODGESIM_OSMESA(gl, Enable);
DODGESIM_OSMESA(gl, EnableVertexAttribArray);
DODGESIM_OSMESA(gl, FramebufferTexture2D);
DODGESIM_OSMESA(gl, GenBuffers);
DODGESIM_OSMESA(gl, GenFramebuffers);
DODGESIM_OSMESA(gl, GenTextures);
DODGESIM_OSMESA(gl, GenVertexArrays);
DODGESIM_OSMESA(gl, GenerateMipmap);
DODGESIM_OSMESA(gl, GetActiveUniform);
DODGESIM_OSMESA(gl, GetProgramInfoLog);
DODGESIM_OSMESA(gl, GetProgramiv);
DODGESIM_OSMESA(gl, GetShaderInfoLog);
DODGESIM_OSMESA(gl, GetShaderiv);
DODGESIM_OSMESA(gl, GetString);
DODGESIM_OSMESA(gl, GetUniformLocation);
DODGESIM_OSMESA(gl, IsBuffer);
DODGESIM_OSMESA(gl, IsFramebuffer);
DODGESIM_OSMESA(gl, IsProgram);
DODGESIM_OSMESA(gl, IsTexture);
DODGESIM_OSMESA(gl, IsVertexArray);
DODGESIM_OSMESA(gl, LinkProgram);
DODGESIM_OSMESA(gl, PixelStorei);
DODGESIM_OSMESA(gl, ReadBuffer);
DODGESIM_OSMESA(gl, ReadPixels);
DODGESIM_OSMESA(gl, Scissor);
DODGESIM_OSMESA(gl, ShaderSource);
DODGESIM_OSMESA(gl, TexImage2D);
DODGESIM_OSMESA(gl, TexParameteri);
DODGESIM_OSMESA(gl, Uniform1f);
DODGESIM_OSMESA(gl, Uniform1fv);
DODGESIM_OSMESA(gl, Uniform1i);
DODGESIM_OSMESA(gl, Uniform2f);
DODGESIM_OSMESA(gl, Uniform2fv);
DODGESIM_OSMESA(gl, Uniform3f);
DODGESIM_OSMESA(gl, Uniform3fv);
DODGESIM_OSMESA(gl, Uniform4fv);
DODGESIM_OSMESA(gl, UniformMatrix3fv);
DODGESIM_OSMESA(gl, UniformMatrix4fv);
DODGESIM_OSMESA(gl, UseProgram);
DODGESIM_OSMESA(gl, VertexAttribDivisor);
DODGESIM_OSMESA(gl, VertexAttribPointer);
DODGESIM_OSMESA(gl, Viewport);
}  // namespace gl

#undef DODGESIM_OSMESA

}  // namespace dodgesim
