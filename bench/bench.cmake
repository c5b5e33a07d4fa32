# catena_bench: every variant on Google Benchmark. Left out, with a word, when the library is not there.
find_package(benchmark QUIET)
if(benchmark_FOUND)
  add_executable(catena_bench ${PROJECT_SOURCE_DIR}/bench/main.cpp ${PROJECT_SOURCE_DIR}/bench/benchmarks.cpp)
  target_link_libraries(catena_bench PRIVATE catena catena_options benchmark::benchmark)
  set_target_properties(catena_bench PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
else()
  message(STATUS "catena_bench is not built: Google Benchmark was not found (libbenchmark-dev)")
endif()
