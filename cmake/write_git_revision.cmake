# cmake -DSOURCE=... -DOUTPUT=... -P write_git_revision.cmake: a header with the revision, rewritten only if it changed.
find_package(Git QUIET)
set(revision "unknown")
if(Git_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} describe --always --dirty=+ --abbrev=10 --exclude=*
                  WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE found ERROR_QUIET RESULT_VARIABLE code OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(code EQUAL 0)
    set(revision "${found}")
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#pragma once\n#define ROTORDROP_GIT_REVISION \"${revision}\"\n")
