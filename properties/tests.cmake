# Every *_test.cpp of the tree is part of one test program; a new one is found with no edit here. A test whose
# suite name ends in "Long" gets the label `long` and is left out of the fast suite (ctest -LE long). A test of the
# instantiation "Device" runs device variants and gets the label `gpu` (ctest -L gpu); without a device it is skipped.
find_package(GTest REQUIRED)
find_package(rapidcheck REQUIRED)
include(GoogleTest)

file(GLOB_RECURSE tests CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/core/*_test.cpp ${PROJECT_SOURCE_DIR}/variants/*_test.cpp
     ${PROJECT_SOURCE_DIR}/reference/*_test.cpp ${PROJECT_SOURCE_DIR}/properties/*_test.cpp
     ${PROJECT_SOURCE_DIR}/bench/*_test.cpp ${PROJECT_SOURCE_DIR}/reports/*_test.cpp)
add_executable(catena_tests ${tests})
target_link_libraries(catena_tests PRIVATE catena catena_options catena_reports catena_timing GTest::gtest_main rapidcheck
                      nlohmann_json::nlohmann_json Eigen3::Eigen)
target_compile_definitions(catena_tests PRIVATE CATENA_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                           CATENA_PROGRAM="$<TARGET_FILE:catena_cli>")
target_precompile_headers(catena_tests PRIVATE ${CATENA_PRECOMPILED} <gtest/gtest.h>)
add_dependencies(catena_tests catena_cli)  # tests run the program too
set_target_properties(catena_tests PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
gtest_discover_tests(catena_tests TEST_FILTER "-*Long.*:Device*" PROPERTIES TIMEOUT 300 DISCOVERY_TIMEOUT 120)
gtest_discover_tests(catena_tests TEST_FILTER "Device*" TEST_SUFFIX " (gpu)" PROPERTIES LABELS gpu TIMEOUT 300 DISCOVERY_TIMEOUT 120)
gtest_discover_tests(catena_tests TEST_FILTER "*Long.*" TEST_SUFFIX " (long)" PROPERTIES LABELS long TIMEOUT 3600 DISCOVERY_TIMEOUT 120)

# An installed catena is found by another project, which adds README's one-file variant from outside.
set(sanitize_flags "")
if(CATENA_SANITIZE)
  set(sanitize_flags "-fsanitize=${CATENA_SANITIZE}")
endif()
add_test(NAME install.find_package COMMAND ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR} -DSOURCE=${PROJECT_SOURCE_DIR}
         -DWORK=${PROJECT_BINARY_DIR}/install_test -DFLAGS=${sanitize_flags} -P ${PROJECT_SOURCE_DIR}/properties/install_test.cmake)

if(CATENA_COVERAGE)
  include(${PROJECT_SOURCE_DIR}/properties/coverage.cmake)
endif()
include(${PROJECT_SOURCE_DIR}/properties/proofs/proofs.cmake)
include(${PROJECT_SOURCE_DIR}/properties/mutants/mutants.cmake)
