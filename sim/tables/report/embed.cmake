# Writes the files of the report into a C++ source, so that the program needs none of them beside it.
#   cmake -DSOURCE_DIR=... -DOUTPUT=... -P embed.cmake
set(code "// Generated from sim/tables/report/ by embed.cmake.\nnamespace dodgesim {\n\n")
foreach(part IN ITEMS page:report.html style:report.css script:data.js,trajectory.js,view3d.js,charts.js,throw.js,success.js,report.js)
  string(REGEX MATCH "^(.*):(.*)$" _ ${part})
  set(name ${CMAKE_MATCH_1})
  string(REPLACE "," ";" files ${CMAKE_MATCH_2})
  set(text "")
  foreach(file IN LISTS files)
    file(READ ${SOURCE_DIR}/${file} contents)
    string(APPEND text "${contents}")
  endforeach()
  # Compilers take string literals of 64 kB at least.
  string(APPEND code "extern const char* const kReport_${name};\nconst char* const kReport_${name} = R\"~~~~(${text})~~~~\";\n\n")
endforeach()
string(APPEND code "}  // namespace dodgesim\n")
file(WRITE ${OUTPUT} "${code}")
