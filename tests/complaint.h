// What a function complains about.
#pragma once

#include <string>

namespace dodgesim::testing {

// The exception's sentence; empty when there is none.
template <class Error, class Function>
std::string complaint(Function function) {
  try {
    function();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace dodgesim::testing
