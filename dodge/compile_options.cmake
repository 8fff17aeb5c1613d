# What every target of the project is compiled with. The flight core brings it along because the
# core also builds alone.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_CXX_FLAGS_RELEASE "-O3")

if(NOT TARGET dodge_options)
  add_library(dodge_options INTERFACE)
  # -ffp-contract=off: no silent fused multiply-add, so that results do not depend on the optimiser.
  target_compile_options(dodge_options INTERFACE
    -Wall -Wextra -Wpedantic -Wconversion -ffp-contract=off)
  if(CMAKE_PROJECT_NAME MATCHES "^dodge(sim)?$")  # others may have other compilers
    target_compile_options(dodge_options INTERFACE -Werror)
  endif()
  # GCC 12 reports false -Wmaybe-uninitialized and -Warray-bounds inside Eigen, and false -Wrestrict
  # and -Wstringop-overflow inside std::string (its bug 105651).
  target_compile_options(dodge_options INTERFACE
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized -Wno-array-bounds -Wno-restrict
                             -Wno-stringop-overflow>)
  if(DODGESIM_FUZZ)  # clang has warnings of its own
    target_compile_options(dodge_options INTERFACE
      -Wno-error -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all)
    target_link_options(dodge_options INTERFACE -fsanitize=address,undefined)
  endif()
  if(DODGESIM_SANITIZE STREQUAL "address")
    target_compile_options(dodge_options INTERFACE
      -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(dodge_options INTERFACE -fsanitize=address,undefined)
  elseif(DODGESIM_SANITIZE STREQUAL "thread")
    target_compile_options(dodge_options INTERFACE -fsanitize=thread -fno-omit-frame-pointer)
    target_link_options(dodge_options INTERFACE -fsanitize=thread)
  endif()
endif()
