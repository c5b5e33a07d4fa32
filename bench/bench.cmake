# What measures with Google Benchmark: catena_bench, and `catena report`, which says what is missing where the library
# is not there. It is a part of the programs and not of their library.
find_package(benchmark QUIET)
if(benchmark_FOUND)
  add_library(catena_timing OBJECT ${PROJECT_SOURCE_DIR}/bench/timing/google/benchmarks.cpp ${PROJECT_SOURCE_DIR}/bench/timing/google/rounds.cpp)
  target_link_libraries(catena_timing PUBLIC catena_program nlohmann_json::nlohmann_json benchmark::benchmark)
  add_executable(catena_bench ${PROJECT_SOURCE_DIR}/bench/timing/google/main.cpp)
  target_link_libraries(catena_bench PRIVATE catena_timing)
  set_target_properties(catena_bench PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
else()
  message(STATUS "catena_bench is not built, and catena report cannot measure: Google Benchmark was not found (libbenchmark-dev)")
  add_library(catena_timing OBJECT ${PROJECT_SOURCE_DIR}/bench/timing/google/absent.cpp)
  target_link_libraries(catena_timing PUBLIC catena_program nlohmann_json::nlohmann_json)
endif()
