# cmake -DBUILD=... -DSOURCE=... -DVERSION=... -DWORK=... -DFOLDERS=core's;folders [-DFLAGS=...] -P install_test.cmake
# Installs catena below WORK, builds a stranger's project against it with find_package, and runs it. That project is
# compiled with -O3 -march=native, as researchers do, and must get the library's bits.
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${ARGV}: exit code ${code}\n${output}")
  endif()
  message("${output}")
endfunction()

# must_fail(WORDS COMMAND...): fails, and says so in these words.
function(must_fail words)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  string(REGEX REPLACE "[ \n]+" " " output "${output}")  # CMake breaks the lines of its errors
  string(FIND "${output}" "${words}" found)
  if(code EQUAL 0 OR found EQUAL -1)
    message(FATAL_ERROR "${ARGN}: exit code ${code}, expected a failure that says '${words}'\n${output}")
  endif()
  message("refused, as it should be: ${words}")
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/library_alone --component library)

# The library's headers and no others.
file(GLOB_RECURSE headers RELATIVE ${WORK}/prefix/include/catena ${WORK}/prefix/include/*)
list(JOIN FOLDERS "|" folders)
set(foreign ${headers})
list(FILTER foreign EXCLUDE REGEX "^core/((${folders})/)?[a-zA-Z0-9_]+\\.h$")
list(FIND headers core/strategy/registry.h registry)
if(foreign OR registry EQUAL -1)
  message(FATAL_ERROR "installed, but no headers of the library: '${foreign}'; its registry: ${registry}")
endif()

# Each can be included, with what is installed and no more.
set(includes "")
foreach(header ${headers})
  string(APPEND includes "#include <catena/${header}>\n")
endforeach()
file(WRITE ${WORK}/every_header.cpp "${includes}")

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

set(configure ${CMAKE_COMMAND} -S ${SOURCE}/properties/consumer -DCMAKE_BUILD_TYPE=Release
    -DEXTRA_SOURCES=${WORK}/example.cpp -DEVERY_HEADER=${WORK}/every_header.cpp
    -DLIBRARY_EXAMPLE=${WORK}/library_example.cpp "-DCMAKE_CXX_FLAGS=-march=native ${FLAGS}")
run(${configure} -B ${WORK}/build -DCMAKE_PREFIX_PATH=${WORK}/prefix -DMORE_COMPONENTS=program)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer CPU1 aCPU2+CPU2 aGPU2@host+GPUv2@host Sweep)
run(${WORK}/build/library_example)
run(${WORK}/prefix/bin/catena --version)

# The program reads the files that were installed with it, wherever that was; the library has none.
execute_process(COMMAND ${WORK}/prefix/bin/catena verify --variant CPU1 --json RESULT_VARIABLE code OUTPUT_VARIABLE verified)
string(FIND "${verified}" "\"input\":\"${WORK}/prefix/share/catena/examples/" found)
if(NOT code EQUAL 0 OR found EQUAL -1)
  message(FATAL_ERROR "the installed program does not verify its sample files (exit code ${code})\n${verified}")
endif()
foreach(file __main__.py assets/report.js templates/page.html paper_tables.json)  # or the source tree's would be taken
  if(NOT EXISTS ${WORK}/prefix/share/catena/catena_report/${file})
    message(FATAL_ERROR "the page writer's ${file} is not installed with the program")
  endif()
endforeach()
file(GLOB_RECURSE files RELATIVE ${WORK}/library_alone ${WORK}/library_alone/*)
list(FILTER files EXCLUDE REGEX "^(include|lib[^/]*)/")
if(files)
  message(FATAL_ERROR "installed with the library, but not of it: ${files}")
endif()

# The library and the library's headers compiled elsewhere give the same trees and pairs; with contraction they do not.
execute_process(COMMAND ${WORK}/build/same_bits RESULT_VARIABLE code OUTPUT_VARIABLE bits)
message("${bits}")
if(NOT code EQUAL 0)
  message(FATAL_ERROR "a consumer compiled with -O3 -march=native does not get the library's bits")
endif()
execute_process(COMMAND ${WORK}/build/contracted RESULT_VARIABLE code OUTPUT_VARIABLE contracted)
if(bits MATCHES "has fused multiply-add" AND NOT code EQUAL 1)
  message(FATAL_ERROR "contraction goes unnoticed (exit code ${code}), so the check before shows nothing\n${contracted}")
endif()
run(${WORK}/build/wrong_copy)
execute_process(COMMAND ${WORK}/build/flushed RESULT_VARIABLE code OUTPUT_VARIABLE flushed)
message("${flushed}")
if(NOT code EQUAL 0 AND NOT (code EQUAL 2 AND NOT CMAKE_HOST_SYSTEM_PROCESSOR MATCHES "^(x86_64|aarch64)$"))
  message(FATAL_ERROR "a program linked with -ffast-math gets another answer, or nothing was flushed: ${code}")
endif()

foreach(target fast_math fast_core_frames_within fast_core_chain_centre_distance)
  must_fail("catena cannot be compiled with -ffast-math" ${CMAKE_COMMAND} --build ${WORK}/build --target ${target})
endforeach()
must_fail("catena needs C++20" ${CMAKE_COMMAND} --build ${WORK}/build --target too_old)
# Of a project without languages, which has no compiler.
file(WRITE ${WORK}/no_language/CMakeLists.txt "cmake_minimum_required(VERSION 3.25)
project(no_language NONE)
find_package(catena REQUIRED COMPONENTS program)
add_custom_target(program_version ALL COMMAND catena::program --version)
")
run(${CMAKE_COMMAND} -S ${WORK}/no_language -B ${WORK}/no_language/build -DCMAKE_PREFIX_PATH=${WORK}/prefix)
run(${CMAKE_COMMAND} --build ${WORK}/no_language/build)
must_fail("catena has no component 'engine'; there are: library, program"
          ${configure} -B ${WORK}/unknown_component -DCMAKE_PREFIX_PATH=${WORK}/prefix -DMORE_COMPONENTS=engine)
# The files that are installed, as they lie in a build tree: nobody finds them, and alone they say what is missing.
must_fail("Could not find a package configuration file provided by \"catena\"" ${CMAKE_COMMAND} -E env "PATH=${BUILD}:$ENV{PATH}"
          ${configure} -B ${WORK}/by_path -DCMAKE_FIND_USE_CMAKE_SYSTEM_PATH=FALSE)
file(GLOB_RECURSE config ${WORK}/prefix/catena-config.cmake)
file(COPY ${config} DESTINATION ${WORK}/config_alone/lib/cmake/catena)
must_fail("catena's component 'library' is not installed"
          ${configure} -B ${WORK}/without_library -DCMAKE_PREFIX_PATH=${WORK}/config_alone)
must_fail("that is compatible with requested version \"99.0\""
          ${configure} -B ${WORK}/other_version -DCMAKE_PREFIX_PATH=${WORK}/prefix -DWANTED_VERSION=99.0)
run(${configure} -B ${WORK}/same_version -DCMAKE_PREFIX_PATH=${WORK}/library_alone -DWANTED_VERSION=${VERSION}
    "-DMORE_COMPONENTS=OPTIONAL_COMPONENTS;program")
must_fail("catena's component 'program' is not installed"
          ${configure} -B ${WORK}/without_program -DCMAKE_PREFIX_PATH=${WORK}/library_alone -DMORE_COMPONENTS=program)
