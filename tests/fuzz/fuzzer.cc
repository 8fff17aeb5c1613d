// One of the targets for libFuzzer: DODGESIM_FUZZ_TARGET names it.
#include "tests/fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  dodgesim::fuzz::DODGESIM_FUZZ_TARGET({data, size});
  return 0;
}
