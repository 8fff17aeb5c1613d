#include "sim/render/gl_objects.h"

#include <GL/gl.h>
#include <GL/glext.h>

namespace dodgesim {

unsigned make_gl_object(GlKind kind) {
  GLuint name = 0;
  switch (kind) {
    case GlKind::kTexture:
      glGenTextures(1, &name);
      break;
    case GlKind::kBuffer:
      glGenBuffers(1, &name);
      break;
    case GlKind::kVertexArray:
      glGenVertexArrays(1, &name);
      break;
    case GlKind::kFramebuffer:
      glGenFramebuffers(1, &name);
      break;
  }
  return name;
}

void delete_gl_object(GlKind kind, unsigned name) {
  switch (kind) {
    case GlKind::kTexture:
      return glDeleteTextures(1, &name);
    case GlKind::kBuffer:
      return glDeleteBuffers(1, &name);
    case GlKind::kVertexArray:
      return glDeleteVertexArrays(1, &name);
    case GlKind::kFramebuffer:
      return glDeleteFramebuffers(1, &name);
  }
}

}  // namespace dodgesim
