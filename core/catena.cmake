# How every folder becomes part of one of two libraries. libcatena.so, what other projects use: chains, arithmetic,
# trees, strategies. libcatena_program.so, for this project's programs alone: scenes, readers, commands, the reference,
# the properties, the measurements. A new source file in a folder is in the build with no edit here (CONFIGURE_DEPENDS),
# and what it registers is never dropped, as nothing goes through a static library.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

find_package(Threads REQUIRED)
find_package(fmt REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(hwy REQUIRED)
find_package(TBB REQUIRED COMPONENTS tbb)
find_package(Boost REQUIRED)

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
target_link_libraries(catena_options INTERFACE Threads::Threads)
# GCC begins to collect garbage at 128 MB at most, which what is compiled here soon fills: a tenth of its time for nothing.
# The same objects, bit by bit, for a tenth more memory, and at most twice as much: 1.3 GB for search_blocks.cpp.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(catena_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:--param=ggc-min-heapsize=524288>)
endif()
# On ARM it says of every std::pair of floating-point numbers that versions before 10 passed it otherwise.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)$")
  target_compile_options(catena_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wno-psabi>)
endif()
if(CATENA_SANITIZE)
  target_compile_options(catena_options INTERFACE -fsanitize=${CATENA_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(catena_options INTERFACE -fsanitize=${CATENA_SANITIZE})
endif()
# A null pointer that is used ends AddressSanitizer's program, which says where; to look at each pointer before it is used
# takes up to a fourth of the time that a file takes to compile.
if(CATENA_SANITIZE MATCHES "address")
  target_compile_options(catena_options INTERFACE -fno-sanitize=null)
endif()

if(CATENA_SANITIZE MATCHES "thread")
  set_source_files_properties(${PROJECT_SOURCE_DIR}/core/executor/team.cpp PROPERTIES COMPILE_OPTIONS -fno-sanitize=thread SKIP_PRECOMPILE_HEADERS ON)
endif()

if(CATENA_COVERAGE)
  target_compile_options(catena_options INTERFACE --coverage -fprofile-update=atomic)
  target_link_options(catena_options INTERFACE --coverage)
endif()

# Read once a part and not once a file, half of a small file's time; preset debug goes without, and so finds a missing
# #include.
set(CATENA_PRECOMPILED <algorithm> <cmath> <cstdint> <functional> <memory> <optional> <string> <vector> <fmt/format.h>)

# catena_is_of_many_targets(FILE OUT): whether the file is compiled once for each instruction set.
function(catena_is_of_many_targets source out)
  file(STRINGS ${source} line REGEX "HWY_TARGET_INCLUDE" LIMIT_COUNT 1)
  set(${out} ${line} PARENT_SCOPE)
endfunction()

# catena_together(TARGET): compiles up to six files of a folder as one, which takes some half of what they take alone, or a
# third where they are tests, as they share headers and templates; names in their anonymous namespaces must differ. Alone
# stay, so that a name can be taken twice, files of folders where a new variant, scene, reader, writer, property or section
# is a new file; also what is compiled for many instruction sets, as such a file includes itself. What goes without
# precompiled headers compiles every file alone, and so finds a missing #include.
set(CATENA_ALONE "^(variants|core/(scenes|readers|writers)|properties/(generators|statements|mutants|counterexamples)|reports/sections)/")
function(catena_together target)
  if(CMAKE_DISABLE_PRECOMPILE_HEADERS)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  list(SORT sources)
  foreach(source IN LISTS sources)
    cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE name)
    catena_is_of_many_targets(${source} of_many_targets)
    if(name MATCHES "\\.cpp$" AND NOT name MATCHES "${CATENA_ALONE}" AND NOT of_many_targets)
      get_filename_component(folder ${name} DIRECTORY)
      string(MAKE_C_IDENTIFIER ${folder} folder)
      list(APPEND files_${folder} ${name})
      list(LENGTH files_${folder} count)
      math(EXPR batch "(${count} - 1) / 6")
      set_property(SOURCE ${source} PROPERTY UNITY_GROUP ${folder}_${batch})
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# What a command says, and how it is asked, is JSON and the option parser, which take longer to compile than all
# algorithms and run once: these files are one target, for which JSON is read once. It is linked last, so that what is
# in other files, too, is their better code.
set(CATENA_OPTIMIZE_COMMANDS $<$<CONFIG:Release,RelWithDebInfo>:-O1>)
if(CATENA_SANITIZE)
  set(CATENA_OPTIMIZE_COMMANDS -O0)
endif()
set(CATENA_COMMAND_FILES "(_(command|option|report|json)s?|/(command_line|report|json))\\.cpp$")
# catena_take_commands(LIST): takes these files off this list of files, for the target catena_commands.
function(catena_take_commands list)
  set(commands ${${list}})
  set(others ${${list}})
  list(FILTER commands INCLUDE REGEX ${CATENA_COMMAND_FILES})
  list(FILTER others EXCLUDE REGEX ${CATENA_COMMAND_FILES})
  set_property(GLOBAL APPEND PROPERTY CATENA_COMMANDS ${commands})
  set(${list} ${others} PARENT_SCOPE)
endfunction()

# catena_sources(OUT FOLDER...): the .cpp files below these folders, but for tests, other projects, main.cpp and what needs
# Google Benchmark or MPI.
function(catena_sources out)
  list(TRANSFORM ARGN REPLACE "(.+)" "${PROJECT_SOURCE_DIR}/\\1/*.cpp" OUTPUT_VARIABLE patterns)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${patterns})
  list(FILTER sources EXCLUDE REGEX "(_test|/main|_fuzz_target)\\.cpp$|/google/|/mpi/|/consumer/")
  set(${out} ${sources} PARENT_SCOPE)
endfunction()

# The library. Everything is hidden but what says CATENA_API (core/export.h), the standard library's templates too, and
# it calls its own functions: no other program's copy, compiled with other flags, takes their place.
set(CATENA_LIBRARY_FOLDERS arithmetic blocks cells chain executor frames grid hierarchy hybrid parameters parts plan policies space_tree sphere_tree strategy)  # of core
list(TRANSFORM CATENA_LIBRARY_FOLDERS PREPEND core/ OUTPUT_VARIABLE folders)
catena_sources(library_sources ${folders} variants)
add_library(catena SHARED ${library_sources})
add_library(catena::catena ALIAS catena)
set_target_properties(catena PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION 0 EXPORT_NAME catena
  CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON LINK_DEPENDS ${PROJECT_SOURCE_DIR}/core/exports.map)
target_link_libraries(catena PUBLIC Threads::Threads PRIVATE catena_options fmt::fmt hwy::hwy hwy::hwy_contrib TBB::tbb)
target_link_options(catena PRIVATE LINKER:--version-script=${PROJECT_SOURCE_DIR}/core/exports.map LINKER:-Bsymbolic-functions)
# Threads of oneTBB run its code until the process ends: where a plugin that linked it is closed, it stays.
target_link_options(catena PRIVATE LINKER:-z,nodelete)
if(NOT CATENA_SANITIZE)
  target_link_options(catena PRIVATE LINKER:--no-undefined)  # nothing of the program is missed
endif()
target_precompile_headers(catena PRIVATE ${CATENA_PRECOMPILED})
catena_together(catena)
target_compile_features(catena PUBLIC cxx_std_20)
# Compiled once for each instruction set, all of it inlined. With sanitizers GCC takes twice as long over checks that are
# spelt out as over calls of the checks; the sizes of objects are AddressSanitizer's own matter; and half of it goes into
# how each vector is aligned, which matters for time alone. (Not -O0: what is inlined nowhere is called with vectors that
# caller and callee pass differently.) On ARM it refuses to inline Highway's NEON functions, which are compiled for
# +crypto, into the constructors that it makes itself of structs that hold vectors, unless these are for +crypto too. No
# such instruction is ever used. FEW is for sanitizers, with which each instruction set is dear: AVX2's, as nearly all
# machines have it and its loads are wider than plain code's.
set(for_many_targets)
if(CATENA_INSTRUCTION_SETS STREQUAL "FEW" AND CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$")
  list(APPEND for_many_targets -march=haswell -maes -DHWY_COMPILE_ONLY_STATIC)
endif()
if(CATENA_SANITIZE MATCHES "address")
  list(APPEND for_many_targets --param=asan-instrumentation-with-call-threshold=0 -fno-sanitize=object-size,alignment)
endif()
set(CATENA_INLINES_NEON)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)$")
  set(CATENA_INLINES_NEON -march=armv8-a+crypto)
  list(APPEND for_many_targets ${CATENA_INLINES_NEON})
endif()
if(for_many_targets)
  catena_sources(sources core bench)
  foreach(source IN LISTS sources)
    catena_is_of_many_targets(${source} of_many_targets)
    if(of_many_targets)
      set_source_files_properties(${source} PROPERTIES COMPILE_OPTIONS "${for_many_targets}" SKIP_PRECOMPILE_HEADERS ON)
    endif()
  endforeach()
endif()
# Whoever builds trees by the library's headers must get the bits of the library's own.
target_compile_options(catena INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-ffp-contract=off>
                                        "$<$<COMPILE_LANGUAGE:CUDA>:SHELL:--fmad=false -Xcompiler=-ffp-contract=off>")
target_include_directories(catena PUBLIC $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>
                                         $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
include(${PROJECT_SOURCE_DIR}/cuda/cuda.cmake)

# The program's library.
add_library(catena_program SHARED)
target_link_libraries(catena_program PUBLIC catena catena_options fmt::fmt)
# catena_part(FOLDER [libraries...]): what the library has not of this folder, compiled with these libraries.
function(catena_part folder)
  catena_sources(sources ${folder})
  list(REMOVE_ITEM sources ${library_sources})
  if(NOT CATENA_MUTANTS)
    list(FILTER sources EXCLUDE REGEX "/properties/(mutants/|fuzz/faulty_variants)")
  endif()
  catena_take_commands(sources)
  add_library(catena_part_${folder} OBJECT ${sources})
  target_link_libraries(catena_part_${folder} PUBLIC catena_options fmt::fmt ${ARGN})
  target_precompile_headers(catena_part_${folder} PRIVATE ${CATENA_PRECOMPILED})
  target_link_libraries(catena_program PRIVATE catena_part_${folder})
endfunction()

# What every measurement says of its build; the commit is looked up again at every build.
set(commit_header ${PROJECT_BINARY_DIR}/generated/commit.h)
add_custom_target(catena_commit ALL BYPRODUCTS ${commit_header}
  COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DHEADER=${commit_header} -P ${PROJECT_SOURCE_DIR}/core/commit.cmake)
string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
set(flags "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type}} -ffp-contract=off")
string(REGEX REPLACE "([\\\"])" "\\\\\\1" flags "${flags}")  # in a string of C++
set_source_files_properties(${PROJECT_SOURCE_DIR}/core/environment.cpp PROPERTIES COMPILE_DEFINITIONS
  "CATENA_COMMIT_HEADER=\"${commit_header}\";CATENA_BUILD_TYPE=\"${CMAKE_BUILD_TYPE}\";CATENA_COMPILER=\"${CMAKE_CXX_COMPILER_ID}\";CATENA_FLAGS=\"${flags}\""
  OBJECT_DEPENDS ${commit_header})
set_source_files_properties(${PROJECT_SOURCE_DIR}/core/installed_files.cpp PROPERTIES COMPILE_DEFINITIONS
  "CATENA_DATADIR=\"${CMAKE_INSTALL_DATADIR}\"")

catena_part(core nlohmann_json::nlohmann_json Eigen3::Eigen Boost::headers hwy::hwy)
# What some readers need. Without it they refuse their files with the reason.
find_package(ZLIB QUIET)
if(ZLIB_FOUND)
  target_link_libraries(catena_part_core PRIVATE ZLIB::ZLIB)
  set_property(SOURCE ${PROJECT_SOURCE_DIR}/core/readers/compressed.cpp PROPERTY COMPILE_DEFINITIONS CATENA_HAS_ZLIB)
endif()
find_package(pugixml QUIET)
if(pugixml_FOUND)
  target_link_libraries(catena_part_core PRIVATE pugixml::pugixml)
  set_property(SOURCE ${PROJECT_SOURCE_DIR}/core/readers/vtk_xml.cpp PROPERTY COMPILE_DEFINITIONS CATENA_HAS_PUGIXML)
endif()
if(TARGET catena_cuda)
  target_sources(catena_part_core PRIVATE ${PROJECT_SOURCE_DIR}/cuda/environment.cpp)
endif()
add_dependencies(catena_part_core catena_commit)
include(${PROJECT_SOURCE_DIR}/reference/reference.cmake)
catena_part(properties)
set(parts core properties)  # not the reference, which computes a second time by functions of the same names
if(CATENA_BENCH)
  catena_part(bench nlohmann_json::nlohmann_json Eigen3::Eigen hwy::hwy)
  target_precompile_headers(catena_part_bench PRIVATE <nlohmann/json.hpp>)
  list(APPEND parts bench)
endif()
foreach(part IN LISTS parts)
  catena_together(catena_part_${part})
endforeach()
include(${PROJECT_SOURCE_DIR}/core/ranks/ranks.cmake)
get_property(commands GLOBAL PROPERTY CATENA_COMMANDS)
add_library(catena_commands OBJECT ${commands})
target_link_libraries(catena_commands PRIVATE catena_options fmt::fmt CLI11::CLI11 nlohmann_json::nlohmann_json Eigen3::Eigen
  Boost::headers hwy::hwy ${CATENA_MPI_LIBRARY})
target_compile_options(catena_commands PRIVATE ${CATENA_OPTIMIZE_COMMANDS})
target_precompile_headers(catena_commands PRIVATE ${CATENA_PRECOMPILED} <nlohmann/json.hpp>)
target_link_libraries(catena_program PRIVATE catena_commands)

# Commands that this build has not, by the names of their files: who asks for one is told so.
set(left_out)
if(NOT CATENA_BENCH)
  file(GLOB_RECURSE left_out CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/bench/*_command.cpp ${PROJECT_SOURCE_DIR}/reports/*_command.cpp)
  list(TRANSFORM left_out REPLACE "^.*/(.+)_command\\.cpp$" "\\1")
  string(REPLACE "_" "-" left_out "${left_out}")
  string(REPLACE ";" " " left_out "${left_out}")
endif()
set_source_files_properties(${PROJECT_SOURCE_DIR}/core/commands/command_line.cpp PROPERTIES COMPILE_DEFINITIONS
  "CATENA_LEFT_OUT=\"${left_out}\"")

add_executable(catena_cli ${PROJECT_SOURCE_DIR}/core/main.cpp)
add_executable(catena::program ALIAS catena_cli)
set_target_properties(catena_cli PROPERTIES OUTPUT_NAME catena EXPORT_NAME program RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
include(${PROJECT_SOURCE_DIR}/core/install.cmake)
target_link_libraries(catena_cli PRIVATE catena_program)
if(CATENA_BENCH)
  include(${PROJECT_SOURCE_DIR}/bench/bench.cmake)
  include(${PROJECT_SOURCE_DIR}/reports/reports.cmake)
  target_link_libraries(catena_cli PRIVATE catena_reports catena_timing)
elseif(CATENA_TESTS)
  message(FATAL_ERROR "CATENA_TESTS=ON needs CATENA_BENCH=ON, as what measures is tested too; or give CATENA_TESTS=OFF")
endif()
if(CATENA_SANITIZE MATCHES address)
  include(${PROJECT_SOURCE_DIR}/properties/search_tests.cmake)
endif()
if(CATENA_TESTS AND NOT CATENA_MUTANTS)
  message(FATAL_ERROR "CATENA_TESTS=ON needs CATENA_MUTANTS=ON, as properties are tested by them; or give CATENA_TESTS=OFF")
endif()
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
