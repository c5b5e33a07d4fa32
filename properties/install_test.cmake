# cmake -DBUILD=... -DSOURCE=... -DWORK=... [-DEXTRA=file.cpp -DVARIANT=name] -P install_test.cmake
# Installs catena below WORK, builds a stranger's project against it with find_package, and runs it.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${ARGV}: exit code ${code}\n${output}")
  endif()
  message("${output}")
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)

# README's example of a variant in one file, taken from README itself.
file(READ ${SOURCE}/README.md readme)
string(REGEX MATCH "```cpp\n// variants/[A-Za-z0-9_]+\\.cpp.*" rest "${readme}")
string(REGEX REPLACE "^```cpp\n(.*)" "\\1" rest "${rest}")
string(FIND "${rest}" "```" end)
if(end LESS 1)
  message(FATAL_ERROR "README shows no variant in one file")
endif()
string(SUBSTRING "${rest}" 0 ${end} example)
file(WRITE ${WORK}/example.cpp "${example}")

# What README says under "Using the library", made a program.
string(REGEX MATCH "## Using the library.*" rest "${readme}")
string(FIND "${rest}" "```cpp\n" begin)
string(SUBSTRING "${rest}" ${begin} -1 rest)
string(SUBSTRING "${rest}" 7 -1 rest)
string(FIND "${rest}" "```" end)
if(begin LESS 1 OR end LESS 1)
  message(FATAL_ERROR "README does not show how to use the library")
endif()
string(SUBSTRING "${rest}" 0 ${end} library_example)
configure_file(${SOURCE}/properties/consumer/library_example.cpp.in ${WORK}/library_example.cpp @ONLY)

run(${CMAKE_COMMAND} -S ${SOURCE}/properties/consumer -B ${WORK}/build -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_PREFIX_PATH=${WORK}/prefix -DEXTRA_SOURCES=${WORK}/example.cpp -DLIBRARY_EXAMPLE=${WORK}/library_example.cpp "-DCMAKE_CXX_FLAGS=${FLAGS}")
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer CPU1 aCPU2+CPU2 aGPU2@host+GPUv2@host Sweep)
run(${WORK}/build/library_example)
run(${WORK}/prefix/bin/catena --version)
