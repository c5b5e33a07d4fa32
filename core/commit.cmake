# cmake -DSOURCE=... -DHEADER=... -P commit.cmake
# Writes which commit of catena is built, not of a repository that holds a copy of it; "-dirty" when anything
# differs from it, new files included. Run at every build; the header is touched only when its content
# changes, so that at most one file is compiled again.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND git describe --always --abbrev=12 --exclude=* WORKING_DIRECTORY ${SOURCE}
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE no_commit)
execute_process(COMMAND git rev-parse --show-toplevel WORKING_DIRECTORY ${SOURCE}
                OUTPUT_VARIABLE top OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
file(REAL_PATH "${SOURCE}" source)
execute_process(COMMAND git status --porcelain WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE changes ERROR_QUIET)
if(no_commit OR NOT top STREQUAL source)
  set(commit "unknown: not built in a git checkout")
elseif(changes)
  string(APPEND commit "-dirty")
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#define CATENA_COMMIT \"@commit@\"\n" @ONLY)
