// How much memory a process may take.
#pragma once

#include <cstdint>

namespace dodgesim {

// From now on this process and its children have at most so many addresses: an allocation beyond
// throws std::bad_alloc. Under sanitizers, which reserve more than any limit, nothing happens.
void limit_memory(std::int64_t memory_mb);

// What is built into the machine.
std::int64_t physical_memory_mb();

}  // namespace dodgesim
