# No truth leaks: the flight core includes nothing from the simulator and nothing beyond Eigen and
# OpenCV's core, and a copy of it configures and builds by itself, as part of the example of a
# plug-in, which dodgesim loads.
# cmake -D SOURCE_DIR=<repository> [-D BUILD=ON -D WORK_DIR=<scratch> -D GENERATOR=Ninja
#       -D DODGESIM=<program>] -P core_alone.cmake
file(GLOB_RECURSE files ${SOURCE_DIR}/dodge/*.h ${SOURCE_DIR}/dodge/*.cc)
if(NOT files)
  message(FATAL_ERROR "There are no sources in ${SOURCE_DIR}/dodge.")
endif()
foreach(file ${files})
  file(STRINGS ${file} includes REGEX "^[ \t]*#[ \t]*include")
  foreach(line ${includes})
    string(REGEX MATCH "[<\"]([^>\"]*)[>\"]" ignored "${line}")
    set(header ${CMAKE_MATCH_1})
    # Ours, Eigen, OpenCV's core, or the C++ standard library (no folder, no suffix).
    if(NOT header MATCHES "^dodge/|^Eigen/|^opencv2/core\\.hpp$|^[a-z_]+$")
      message(FATAL_ERROR "${file} includes ${header}, which the flight core may not.")
    endif()
  endforeach()
endforeach()

if(BUILD)
  file(REMOVE_RECURSE ${WORK_DIR})
  file(COPY ${SOURCE_DIR}/dodge DESTINATION ${WORK_DIR})
  set(configure -S ${WORK_DIR}/dodge/example -B ${WORK_DIR}/build -G ${GENERATOR} -DCMAKE_BUILD_TYPE=Debug
                # Without -g: built to see whether it builds. -Og compiles faster than -O0.
                -DCMAKE_CXX_FLAGS_DEBUG=-Og
                -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=0
                -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON
                -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER})
  foreach(step "${configure}"
               "--build;${WORK_DIR}/build;--parallel;2;--target;dodge;my_pilot")
    execute_process(COMMAND ${CMAKE_COMMAND} ${step} RESULT_VARIABLE failed OUTPUT_VARIABLE output
                    ERROR_VARIABLE output)
    if(failed)
      message(FATAL_ERROR "The flight core does not build alone:\n${output}")
    endif()
  endforeach()
  execute_process(COMMAND ${DODGESIM} validate ${SOURCE_DIR}/scenarios/demo.yaml --set pilot=plugin
                          --set repeats=1 --plugin ${WORK_DIR}/build/libmy_pilot.so
                  RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(failed)
    message(FATAL_ERROR "The example of a plug-in makes no pilot:\n${output}")
  endif()
endif()
