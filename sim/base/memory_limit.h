// How much memory a process may take.
#pragma once

#include <cstdint>
#include <optional>

namespace dodgesim {

// From now on this process and its children have at most so many addresses: an allocation beyond
// throws std::bad_alloc. A stricter limit stays. Under sanitizers, which reserve more than any
// limit, nothing happens.
void limit_memory(std::int64_t memory_mb);

// The limit in force; none: as much as there is.
std::optional<std::int64_t> memory_limit_mb();

// What is built into the machine.
std::int64_t physical_memory_mb();

}  // namespace dodgesim
