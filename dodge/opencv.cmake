# find_opencv(core imgproc ...) makes the targets opencv_core, ... as OpenCV's own CMake package does.
# Debian has that package in libopencv-dev alone, which brings along VTK, Qt and MPI, 560 MB.
function(find_opencv)
  find_path(OpenCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4 REQUIRED)
  foreach(module ${ARGN})
    if(TARGET opencv_${module})
      continue()
    endif()
    find_library(OpenCV_${module}_LIBRARY opencv_${module} REQUIRED)
    add_library(opencv_${module} INTERFACE IMPORTED GLOBAL)
    target_include_directories(opencv_${module} SYSTEM INTERFACE ${OpenCV_INCLUDE_DIR})
    target_link_libraries(opencv_${module} INTERFACE ${OpenCV_${module}_LIBRARY})
  endforeach()
endfunction()
