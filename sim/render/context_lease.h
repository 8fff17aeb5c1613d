// OpenGL contexts that serve one renderer after another.
//
// Mesa compiles a shader twice: its source when the program is linked, and to machine code when it
// first draws into a kind of image. Both live with the context. A context that is given back is
// kept with its programs, so that the next renderer of the same kind of scene compiles nothing: a
// campaign makes one for every throw.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "sim/render/osmesa_context.h"
#include "sim/render/program_cache.h"

namespace dodgesim {

// RAII. A context of the core profile for one renderer alone, current at first. It may have been
// another's before: then it has that one's programs, values of uniforms and OpenGL state, but no
// other objects (gl_objects.h). Idle contexts belong to the thread on which they were given back,
// and end with it; a thread has as many as were in use at once. A lease ends before its thread
// does: none is in static storage. Not kept is a context that is given back while an exception is
// under way, which may have left anything in it, or with more than kMaxKeptPrograms programs.
class ContextLease {
 public:
  static constexpr std::size_t kMaxKeptPrograms = 64;  // a scene needs 5 at most

  ContextLease();  // throws SimulationError
  ~ContextLease();
  ContextLease(const ContextLease&) = delete;
  ContextLease& operator=(const ContextLease&) = delete;

  OsmesaContext& context() const { return leased_->context; }
  ProgramCache& programs() const { return leased_->programs; }

 private:
  struct CompiledContext {
    OsmesaContext context{GlProfile::kCore33, 1, 1};
    ProgramCache programs;
  };
  static std::vector<std::unique_ptr<CompiledContext>>& idle();

  std::unique_ptr<CompiledContext> leased_;
  int exceptions_;  // under way when it was leased
};

}  // namespace dodgesim
