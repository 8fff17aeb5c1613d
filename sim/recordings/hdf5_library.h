// The HDF5 library, as the files beside this one use it.
#pragma once

#include <hdf5.h>

namespace dodgesim {

// Before anything else of the library: errors are ours to report, and files left open after one
// must not be closed when the program ends, because the library crashes on those that it could not
// write.
inline void prepare_hdf5() {
  [[maybe_unused]] static const herr_t once = H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

}  // namespace dodgesim
