# Writes OUTPUT with the commit of SOURCE_DIR; run at build time, so that it is never stale. Where the
# commit does not say what is built, a digest of the sources does.
execute_process(COMMAND git -C ${SOURCE_DIR} rev-parse HEAD
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET
                RESULT_VARIABLE failed)
set(modified false)
if(failed)
  set(commit unknown)
else()
  # New sources are compiled although git does not know them yet.
  execute_process(COMMAND git -C ${SOURCE_DIR} status --porcelain --untracked-files=no
                  OUTPUT_VARIABLE changes ERROR_QUIET)
  execute_process(COMMAND git -C ${SOURCE_DIR} ls-files --others --exclude-standard
                          -- CMakeLists.txt dodge sim tools
                  OUTPUT_VARIABLE new ERROR_QUIET)
  string(APPEND changes "${new}")
  if(changes)
    set(modified true)
  endif()
endif()
set(digest "")
if(failed OR modified)
  file(GLOB_RECURSE sources ${SOURCE_DIR}/sim/* ${SOURCE_DIR}/dodge/* ${SOURCE_DIR}/tools/*)
  list(SORT sources)
  set(digests "")
  foreach(source ${SOURCE_DIR}/CMakeLists.txt ${sources})
    file(SHA1 ${source} one)
    string(APPEND digests ${one})
  endforeach()
  string(SHA1 digest "${digests}")
  string(SUBSTRING ${digest} 0 16 digest)
endif()
# Only when it changed, so that nothing is rebuilt without need.
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT
     "#define DODGESIM_COMMIT \"${commit}\"
#define DODGESIM_MODIFIED ${modified}
#define DODGESIM_SOURCES \"${digest}\"
")
