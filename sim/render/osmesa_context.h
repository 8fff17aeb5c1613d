// One OpenGL context of OSMesa (Mesa's software rasteriser), for machines without a GPU or display.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace dodgesim {

enum class GlProfile {
  kCore33,         // own shaders
  kCompatibility,  // MuJoCo's renderer
};

// RAII. All GL objects made in the context die with it. A context belongs to one thread at a time.
// Rendering runs on the calling thread alone: before the first context the environment variable
// LP_NUM_THREADS is set to 0 unless the user has set it. The images do not depend on it.
class OsmesaContext {
 public:
  // Throws as refuse_osmesa() (gl.h) when OSMesa cannot make the context. The default framebuffer
  // measures width x height px, with depth and stencil buffers.
  OsmesaContext(GlProfile profile, int width, int height);
  ~OsmesaContext();
  OsmesaContext(const OsmesaContext&) = delete;
  OsmesaContext& operator=(const OsmesaContext&) = delete;

  // Cheap when the context is current already. Throws SimulationError.
  void make_current();

  // For the manifest of a run, e.g. "llvmpipe (LLVM 15.0.6, 256 bits)".
  const std::string& renderer() const { return renderer_; }

 private:
  void* context_;
  int width_, height_;
  std::vector<std::uint8_t> framebuffer_;  // RGBA
  std::string renderer_;
};

// renderer() of a context that another process makes: Mesa starts threads that outlive a context,
// and a process with threads must not fork workers, which may wait for them for ever. Empty if
// there is no context to be had.
std::string renderer_name();

}  // namespace dodgesim
