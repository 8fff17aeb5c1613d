#include "sim/render/osmesa_context.h"

#include <cstdlib>

#include "sim/base/child_process.h"
#include "sim/base/error.h"
#include "sim/render/gl.h"

namespace dodgesim {

namespace {

OSMesaContext create(GlProfile profile) {
  constexpr int kDepthBits = 24, kStencilBits = 8;
  if (profile == GlProfile::kCompatibility) {
    return osmesa::CreateContextExt(OSMESA_RGBA, kDepthBits, kStencilBits, 0, nullptr);
  }
  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_RGBA,
                            OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            3,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            3,
                            0,
                            0};
  return osmesa::CreateContextAttribs(attributes, nullptr);
}

std::string gl_string(GLenum name) {
  const GLubyte* text = gl::GetString(name);
  return text ? reinterpret_cast<const char*>(text) : "unknown";
}

}  // namespace

OsmesaContext::OsmesaContext(GlProfile profile, int width, int height)
    : context_(nullptr), width_(width), height_(height) {
  setenv("LP_NUM_THREADS", "0", /*overwrite=*/0);
  framebuffer_.resize(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  context_ = create(profile);
  if (!context_) refuse_osmesa("OSMesa cannot make an OpenGL context");
  try {
    make_current();
  } catch (...) {
    osmesa::DestroyContext(static_cast<OSMesaContext>(context_));
    throw;
  }
  renderer_ = gl_string(GL_RENDERER);
}

OsmesaContext::~OsmesaContext() { osmesa::DestroyContext(static_cast<OSMesaContext>(context_)); }

void OsmesaContext::make_current() {
  auto* context = static_cast<OSMesaContext>(context_);
  if (osmesa::GetCurrentContext() == context) return;
  if (!osmesa::MakeCurrent(context, framebuffer_.data(), GL_UNSIGNED_BYTE, width_, height_)) {
    throw SimulationError("OSMesa cannot make its OpenGL context current for an image of " +
                          std::to_string(width_) + " x " + std::to_string(height_) + " px.");
  }
}

std::string renderer_name() {
  constexpr int kWallMs = 30000;
  return ask_child([] { return OsmesaContext(GlProfile::kCore33, 1, 1).renderer(); }, kWallMs).said;
}

}  // namespace dodgesim
