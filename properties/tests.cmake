# Every *_test.cpp of the tree is part of one test program; a new one is found with no edit here. labels.cmake says which
# tests carry a label: `long` is left out of the fast suite, `gpu` needs a device and is skipped without one.
find_package(GTest REQUIRED)
find_package(rapidcheck REQUIRED)
find_package(ZLIB REQUIRED)     # packed files are written by the tests themselves
find_package(pugixml REQUIRED)  # and .vtp files read
include(GoogleTest)

file(GLOB_RECURSE tests CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/core/*_test.cpp ${PROJECT_SOURCE_DIR}/variants/*_test.cpp
     ${PROJECT_SOURCE_DIR}/reference/*_test.cpp ${PROJECT_SOURCE_DIR}/properties/*_test.cpp
     ${PROJECT_SOURCE_DIR}/bench/*_test.cpp ${PROJECT_SOURCE_DIR}/reports/*_test.cpp)
add_executable(catena_tests ${tests})
target_link_libraries(catena_tests PRIVATE catena_reports catena_timing GTest::gtest_main rapidcheck hwy::hwy
                      nlohmann_json::nlohmann_json Eigen3::Eigen ZLIB::ZLIB)
string(JOIN " " library_folders ${CATENA_LIBRARY_FOLDERS})
target_compile_definitions(catena_tests PRIVATE CATENA_SOURCE_DIR="${PROJECT_SOURCE_DIR}" CATENA_LIBRARY_FOLDERS="${library_folders}"
                           CATENA_PROGRAM="$<TARGET_FILE:catena_cli>" CATENA_MPIRUN="$<$<TARGET_EXISTS:catena_part_mpi>:${MPIEXEC_EXECUTABLE}>")
target_compile_options(catena_tests PRIVATE $<$<AND:$<CONFIG:Release>,$<COMPILE_LANGUAGE:CXX>>:-O1>)  # a quarter sooner built, no slower
target_precompile_headers(catena_tests PRIVATE ${CATENA_PRECOMPILED} <gtest/gtest.h>)
# What tests call of a search compiled for one instruction set is inlined into them; on ARM see core/catena.cmake.
if(CATENA_INLINES_NEON)
  foreach(test IN LISTS tests)
    file(STRINGS ${test} inlines REGEX "#include .*(-inl\\.h|hwy/highway\\.h)" LIMIT_COUNT 1)
    if(inlines)
      set_source_files_properties(${test} PROPERTIES COMPILE_OPTIONS "${CATENA_INLINES_NEON}" SKIP_PRECOMPILE_HEADERS ON)
    endif()
  endforeach()
endif()
catena_together(catena_tests)
set(tests_of_cuda OFF)
if(TARGET catena_cuda)  # what a user's own resident search looks like, and a caller of one
  target_sources(catena_tests PRIVATE ${PROJECT_SOURCE_DIR}/properties/examples/resident_blocks.cu
                                      ${PROJECT_SOURCE_DIR}/properties/device_resident_test.cu
                                      ${PROJECT_SOURCE_DIR}/properties/device_repeats_test.cu
                                      ${PROJECT_SOURCE_DIR}/properties/device_memory_test.cu
                                      ${PROJECT_SOURCE_DIR}/properties/device_queue_test.cu
                                      ${PROJECT_SOURCE_DIR}/properties/device_look_test.cu)
  catena_compile_cuda(catena_tests)
  set(tests_of_cuda ON)
endif()
add_dependencies(catena_tests catena_cli)  # tests run the program too
set_target_properties(catena_tests PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
set(timeout 300)
if(CATENA_SANITIZE)
  set(timeout 1500)
endif()
# One process a test; but those of RunFile share a small run, which takes longer than they do;
# where Google Benchmark is missing it passes, as a skipped one among them would hide one that fails.
# None sees what `catena calibrate` keeps of its user: plans rest on the built-in figures.
set(no_figures XDG_CACHE_HOME=${PROJECT_BINARY_DIR}/no-cache)
gtest_discover_tests(catena_tests TEST_FILTER -RunFile.* PROPERTIES TIMEOUT ${timeout} ENVIRONMENT ${no_figures} DISCOVERY_TIMEOUT 120)
add_test(NAME RunFile COMMAND catena_tests --gtest_filter=RunFile.*)
set_tests_properties(RunFile PROPERTIES TIMEOUT ${timeout} ENVIRONMENT ${no_figures} COST 40)
set(said_to_labels ${PROJECT_BINARY_DIR}/said_to_labels.cmake)
file(CONFIGURE OUTPUT ${said_to_labels} CONTENT "set(CATENA_TESTS_OF_CUDA ${tests_of_cuda})\n")
set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${said_to_labels} ${PROJECT_SOURCE_DIR}/properties/labels.cmake)

# ThreadSanitizer needs the tests about threads only, and so a quarter of the build.
if(CATENA_SANITIZE MATCHES thread)
  file(GLOB threads_tests CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/core/executor/*_test.cpp ${PROJECT_SOURCE_DIR}/properties/threads_test.cpp)
  add_executable(catena_threads_tests ${threads_tests} ${PROJECT_SOURCE_DIR}/properties/tsan_suppressions.cpp)
  target_link_libraries(catena_threads_tests PRIVATE catena_program GTest::gtest_main rapidcheck)
  gtest_discover_tests(catena_threads_tests TEST_PREFIX threads. PROPERTIES LABELS threads TIMEOUT 600 DISCOVERY_TIMEOUT 120)
  # And what CI can afford: libcatena alone.
  add_executable(catena_library_threads_tests ${PROJECT_SOURCE_DIR}/properties/library_threads_test.cpp
                                              ${PROJECT_SOURCE_DIR}/properties/tsan_suppressions.cpp)
  target_link_libraries(catena_library_threads_tests PRIVATE catena catena_options GTest::gtest_main)
endif()

# Each header of the library compiles alone, and twice: a header that does not fails the build of the tests. One that a
# source of its name includes first is compiled so there, in every build without precompiled headers (CI's threads).
foreach(header ${CATENA_LIBRARY_HEADERS})
  string(REPLACE .h .cpp own ${PROJECT_SOURCE_DIR}/${header})
  set(first "")
  if(EXISTS ${own})
    file(STRINGS ${own} first REGEX "^#include" LIMIT_COUNT 1)
  endif()
  if(first STREQUAL "#include \"catena/${header}\"")
    continue()
  endif()
  string(REPLACE .h .cpp source ${PROJECT_BINARY_DIR}/headers/${header})
  file(CONFIGURE OUTPUT ${source} CONTENT "#include \"catena/${header}\"\n#include \"catena/${header}\"\n")
  list(APPEND header_sources ${source})
endforeach()
add_library(catena_headers OBJECT ${header_sources})
target_link_libraries(catena_headers PRIVATE catena)
target_compile_options(catena_headers PRIVATE -O0 -Wall -Wextra -Wshadow -Werror)
set_target_properties(catena_headers PROPERTIES CXX_VISIBILITY_PRESET hidden)  # what a user's library may choose
add_dependencies(catena_tests catena_headers)

add_test(NAME library.border COMMAND ${CMAKE_COMMAND} -DLIBRARY=$<TARGET_FILE:catena> -DNM=${CMAKE_NM} -DREADELF=${CMAKE_READELF}
         -DLOG=${PROJECT_BINARY_DIR}/.ninja_log -DSANITIZE=${CATENA_SANITIZE} -P ${PROJECT_SOURCE_DIR}/properties/library_test.cmake)

add_test(NAME labels COMMAND ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR} -DCTEST=${CMAKE_CTEST_COMMAND}
         -DWORK=${PROJECT_BINARY_DIR}/labels_test -P ${PROJECT_SOURCE_DIR}/properties/labels_test.cmake)
add_test(NAME choice COMMAND ${CMAKE_COMMAND} -DWORK=${PROJECT_BINARY_DIR}/choice_test -P ${PROJECT_SOURCE_DIR}/properties/choice_test.cmake)
add_test(NAME commit COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DWORK=${PROJECT_BINARY_DIR}/commit_test
         -P ${PROJECT_SOURCE_DIR}/properties/commit_test.cmake)

add_test(NAME smallest_build COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DWORK=${PROJECT_BINARY_DIR}/smallest_build
         -DREADELF=${CMAKE_READELF} -P ${PROJECT_SOURCE_DIR}/properties/smallest_build_test.cmake)
set_tests_properties(smallest_build PROPERTIES LABELS long TIMEOUT 3600 PROCESSORS 2)

# An installed catena is found by another project, which adds README's one-file variant from outside.
set(sanitize_flags "")
if(CATENA_SANITIZE)
  set(sanitize_flags "-fsanitize=${CATENA_SANITIZE}")
endif()
add_test(NAME install.find_package COMMAND ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR} -DSOURCE=${PROJECT_SOURCE_DIR}
         -DVERSION=${PROJECT_VERSION} -DWORK=${PROJECT_BINARY_DIR}/install_test -DFLAGS=${sanitize_flags} "-DFOLDERS=${CATENA_LIBRARY_FOLDERS}"
         -P ${PROJECT_SOURCE_DIR}/properties/install_test.cmake)
set_tests_properties(install.find_package PROPERTIES LABELS install COST 40)

if(CATENA_COVERAGE)
  include(${PROJECT_SOURCE_DIR}/properties/coverage.cmake)
endif()
include(${PROJECT_SOURCE_DIR}/properties/proofs/proofs.cmake)
include(${PROJECT_SOURCE_DIR}/properties/mutants/mutants.cmake)
