# find_opencv(core imgproc ...) makes dodge_opencv_core, ...: of OpenCV's own CMake package if that has
# been found before, or else of what lies where CMAKE_PREFIX_PATH, OpenCV_ROOT or OpenCV_DIR say or the
# system has it. Debian has that package in libopencv-dev alone, along with VTK, Qt and MPI.
function(find_opencv)
  set(prefixes ${OpenCV_ROOT} $ENV{OpenCV_ROOT})
  if(OpenCV_DIR)
    list(APPEND prefixes ${OpenCV_DIR}/../../..)  # from lib/cmake/opencv4
  endif()
  foreach(module ${ARGN})
    if(TARGET dodge_opencv_${module})
      continue()
    elseif(TARGET opencv_${module})
      set(library opencv_${module})
      set(headers ${OpenCV_INCLUDE_DIRS})
    else()
      find_path(DODGE_OPENCV_HEADERS opencv2/core.hpp HINTS ${prefixes}
                PATH_SUFFIXES opencv4 include/opencv4 REQUIRED)
      find_library(DODGE_OPENCV_${module} opencv_${module} HINTS ${prefixes}
                   PATH_SUFFIXES lib lib64 REQUIRED)
      set(library ${DODGE_OPENCV_${module}})
      set(headers ${DODGE_OPENCV_HEADERS})
    endif()
    add_library(dodge_opencv_${module} INTERFACE IMPORTED GLOBAL)
    target_include_directories(dodge_opencv_${module} SYSTEM INTERFACE ${headers})
    target_link_libraries(dodge_opencv_${module} INTERFACE ${library})
  endforeach()
endfunction()
