# cmake -DSOURCE=... -DWORK=... -P commit_test.cmake
# What core/commit.cmake says of a checkout, of one with a new file, of a copy within another's checkout, of a
# repository without commits, and of no checkout.
cmake_minimum_required(VERSION 3.25)
set(git git -c user.name=somebody -c user.email=somebody@example.org)
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK}/repository)
foreach(command "init;-q" "commit;-q;--allow-empty;-m;first")
  execute_process(COMMAND ${git} ${command} WORKING_DIRECTORY ${WORK}/repository COMMAND_ERROR_IS_FATAL ANY)
endforeach()

function(expect folder pattern)
  execute_process(COMMAND ${CMAKE_COMMAND} -DSOURCE=${folder} -DHEADER=${WORK}/commit.h -P ${SOURCE}/core/commit.cmake
                  COMMAND_ERROR_IS_FATAL ANY)
  file(READ ${WORK}/commit.h said)
  if(NOT said MATCHES "^#define CATENA_COMMIT \"${pattern}\"\n$")
    message(SEND_ERROR "of ${folder}: ${said} is not ${pattern}")
  endif()
endfunction()

expect(${WORK}/repository "[0-9a-f]+")
file(CREATE_LINK ${WORK}/repository ${WORK}/link SYMBOLIC)
expect(${WORK}/link "[0-9a-f]+")
file(WRITE ${WORK}/repository/copy/new "")
expect(${WORK}/repository "[0-9a-f]+-dirty")
expect(${WORK}/repository/copy "unknown: not built in a git checkout")
execute_process(COMMAND git init -q ${WORK}/empty COMMAND_ERROR_IS_FATAL ANY)
expect(${WORK}/empty "unknown: not built in a git checkout")
# Git looks past a ceiling that it starts in.
cmake_path(GET WORK PARENT_PATH above)
set(ENV{GIT_CEILING_DIRECTORIES} ${above})
expect(${WORK} "unknown: not built in a git checkout")
