#include "sim/render/gl_objects.h"

#include "sim/render/gl.h"

namespace dodgesim {

unsigned make_gl_object(GlKind kind) {
  GLuint name = 0;
  switch (kind) {
    case GlKind::kTexture:
      gl::GenTextures(1, &name);
      break;
    case GlKind::kBuffer:
      gl::GenBuffers(1, &name);
      break;
    case GlKind::kVertexArray:
      gl::GenVertexArrays(1, &name);
      break;
    case GlKind::kFramebuffer:
      gl::GenFramebuffers(1, &name);
      break;
  }
  return name;
}

void delete_gl_object(GlKind kind, unsigned name) {
  switch (kind) {
    case GlKind::kTexture:
      return gl::DeleteTextures(1, &name);
    case GlKind::kBuffer:
      return gl::DeleteBuffers(1, &name);
    case GlKind::kVertexArray:
      return gl::DeleteVertexArrays(1, &name);
    case GlKind::kFramebuffer:
      return gl::DeleteFramebuffers(1, &name);
  }
}

}  // namespace dodgesim
