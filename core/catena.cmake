# How every folder becomes part of the one library. A new source file in a folder is in the build with no edit
# here (CONFIGURE_DEPENDS), and its self-registered strategies are never dropped (OBJECT libraries).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

find_package(Threads REQUIRED)
find_package(fmt REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)

# Headers are included as "catena/core/chain/chain.h", here and after installation.
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/include)
file(CREATE_LINK ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/include/catena SYMBOLIC)

# What every part of catena is compiled with. No contraction: host and device must round alike, and the
# constants of robust.h are proved for operations that are rounded one by one.
add_library(catena_options INTERFACE)
target_compile_features(catena_options INTERFACE cxx_std_20)
target_compile_options(catena_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wshadow -ffp-contract=off>)
target_compile_definitions(catena_options INTERFACE CATENA_VERSION="${PROJECT_VERSION}")
target_include_directories(catena_options INTERFACE $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>)
target_link_libraries(catena_options INTERFACE fmt::fmt Threads::Threads)
if(CATENA_SANITIZE)
  target_compile_options(catena_options INTERFACE -fsanitize=${CATENA_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(catena_options INTERFACE -fsanitize=${CATENA_SANITIZE})
endif()

if(CATENA_COVERAGE)
  target_compile_options(catena_options INTERFACE --coverage -fprofile-update=atomic)
  target_link_options(catena_options INTERFACE --coverage)
endif()

# Read once a part and not once a file, half of a small file's time; preset debug goes without, and so finds a missing
# #include.
set(CATENA_PRECOMPILED <algorithm> <cmath> <cstdint> <functional> <memory> <optional> <string> <vector> <fmt/format.h>)

# The file of a command is mostly the option parser, which takes the sanitizers longer to compile than all algorithms.
if(CATENA_SANITIZE)
  foreach(folder core reference properties bench reports)
    file(GLOB_RECURSE commands CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*_command.cpp ${PROJECT_SOURCE_DIR}/${folder}/*_option*.cpp)
    list(APPEND parsing ${commands})
  endforeach()
  set_source_files_properties(${parsing} ${PROJECT_SOURCE_DIR}/core/main.cpp PROPERTIES COMPILE_OPTIONS -O0 SKIP_PRECOMPILE_HEADERS ON)
endif()

set(CATENA_PARTS "")
# catena_part(name [libraries...]): all .cpp files below this folder, but for tests, main.cpp and what needs Google
# Benchmark, as one OBJECT library.
function(catena_part name)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${name}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "(_test|/main|_fuzz_target)\\.cpp$|/google/")
  if(NOT sources)
    return()
  endif()
  add_library(catena_part_${name} OBJECT ${sources})
  target_link_libraries(catena_part_${name} PUBLIC catena_options ${ARGN})
  target_precompile_headers(catena_part_${name} PRIVATE ${CATENA_PRECOMPILED})
  set(CATENA_PARTS ${CATENA_PARTS} catena_part_${name} PARENT_SCOPE)
endfunction()

# What every measurement says of its build; the commit is looked up again at every build.
set(commit_header ${PROJECT_BINARY_DIR}/generated/commit.h)
add_custom_target(catena_commit ALL BYPRODUCTS ${commit_header}
  COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DHEADER=${commit_header} -P ${PROJECT_SOURCE_DIR}/core/commit.cmake)
string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
set_source_files_properties(${PROJECT_SOURCE_DIR}/core/environment.cpp PROPERTIES COMPILE_DEFINITIONS
  "CATENA_COMMIT_HEADER=\"${commit_header}\";CATENA_BUILD_TYPE=\"${CMAKE_BUILD_TYPE}\";CATENA_COMPILER=\"${CMAKE_CXX_COMPILER_ID}\";CATENA_FLAGS=\"${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type}} -ffp-contract=off\""
  OBJECT_DEPENDS ${commit_header})

catena_part(core CLI11::CLI11 nlohmann_json::nlohmann_json Eigen3::Eigen)
add_dependencies(catena_part_core catena_commit)
catena_part(variants)
include(${PROJECT_SOURCE_DIR}/cuda/cuda.cmake)
include(${PROJECT_SOURCE_DIR}/reference/reference.cmake)
catena_part(properties)
catena_part(bench CLI11::CLI11 nlohmann_json::nlohmann_json Eigen3::Eigen)

add_library(catena SHARED)
add_library(catena::catena ALIAS catena)
set_target_properties(catena PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION 0)
foreach(part ${CATENA_PARTS})
  target_link_libraries(catena PRIVATE ${part})
endforeach()
target_compile_features(catena PUBLIC cxx_std_20)
target_include_directories(catena PUBLIC $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>
                                         $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)

add_executable(catena_cli ${PROJECT_SOURCE_DIR}/core/main.cpp)
set_target_properties(catena_cli PROPERTIES OUTPUT_NAME catena INSTALL_RPATH $ORIGIN/../${CMAKE_INSTALL_LIBDIR}
                                            RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
include(${PROJECT_SOURCE_DIR}/core/install.cmake)
include(${PROJECT_SOURCE_DIR}/bench/bench.cmake)
include(${PROJECT_SOURCE_DIR}/reports/reports.cmake)
target_link_libraries(catena_cli PRIVATE catena catena_options catena_reports catena_timing CLI11::CLI11)
if(CATENA_TESTS)
  enable_testing()
  include(${PROJECT_SOURCE_DIR}/properties/tests.cmake)
  include(${PROJECT_SOURCE_DIR}/reports/tests/tests.cmake)
  if(TARGET catena_cuda)
    include(${PROJECT_SOURCE_DIR}/cuda/tests.cmake)
  endif()
endif()
if(CATENA_FUZZ_TARGETS)
  include(${PROJECT_SOURCE_DIR}/properties/fuzz_targets/fuzz_targets.cmake)
endif()
