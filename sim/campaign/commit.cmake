# Writes OUTPUT with the commit of SOURCE_DIR; run at build time, so that it is never stale.
execute_process(COMMAND git -C ${SOURCE_DIR} rev-parse HEAD
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET
                RESULT_VARIABLE failed)
set(modified false)
if(failed)
  set(commit unknown)
else()
  execute_process(COMMAND git -C ${SOURCE_DIR} status --porcelain --untracked-files=no
                  OUTPUT_VARIABLE changes ERROR_QUIET)
  if(changes)
    set(modified true)
  endif()
endif()
# Only when it changed, so that nothing is rebuilt without need.
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT
     "#define DODGESIM_COMMIT \"${commit}\"\n#define DODGESIM_MODIFIED ${modified}\n")
