#include "sim/render/context_lease.h"

#include <exception>
#include <utility>

namespace dodgesim {

std::vector<std::unique_ptr<ContextLease::CompiledContext>>& ContextLease::idle() {
  thread_local std::vector<std::unique_ptr<CompiledContext>> contexts;
  return contexts;
}

ContextLease::ContextLease() : exceptions_(std::uncaught_exceptions()) {
  if (idle().empty()) {
    leased_ = std::make_unique<CompiledContext>();
  } else {
    leased_ = std::move(idle().back());
    idle().pop_back();
  }
  context().make_current();
}

ContextLease::~ContextLease() {
  const bool broken = std::uncaught_exceptions() > exceptions_;
  if (broken || programs().size() > kMaxKeptPrograms) return;
  idle().push_back(std::move(leased_));
}

}  // namespace dodgesim
