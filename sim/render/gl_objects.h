// Textures, buffers, vertex arrays and framebuffers of OpenGL, each owned by a handle.
#pragma once

#include <utility>

namespace dodgesim {

enum class GlKind { kTexture, kBuffer, kVertexArray, kFramebuffer };

// In the current context. A name of 0 is none.
unsigned make_gl_object(GlKind kind);
void delete_gl_object(GlKind kind, unsigned name);

// RAII. Makes an object in the current context. That context must be current again when the handle
// is destroyed, and the object with it.
template <GlKind kKind>
class GlObject {
 public:
  GlObject() : name_(make_gl_object(kKind)) {}
  ~GlObject() { delete_gl_object(kKind, name_); }
  GlObject(GlObject&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }

  unsigned name() const { return name_; }

 private:
  unsigned name_;  // 0: moved away
};

using GlTexture = GlObject<GlKind::kTexture>;
using GlBuffer = GlObject<GlKind::kBuffer>;
using GlVertexArray = GlObject<GlKind::kVertexArray>;
using GlFramebuffer = GlObject<GlKind::kFramebuffer>;

}  // namespace dodgesim
