# What CI can afford of the tests under AddressSanitizer, a program of its own that needs neither mutants nor what measures:
# libcatena's searches, their trees, cells and queues, who is a neighbour, Grid and Hybrid with borders set by hand, and
# what is left of a build without memory.
find_package(GTest REQUIRED)
find_package(rapidcheck REQUIRED)
set(search_tests ${PROJECT_SOURCE_DIR}/properties/allocations_test.cpp)
foreach(folder arithmetic blocks cells chain grid hierarchy space_tree sphere_tree)
  file(GLOB tests CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/core/${folder}/*_test.cpp)
  list(APPEND search_tests ${tests})
endforeach()
foreach(test cells certified crowded_cells grid_levels hybrid hybrid_frames hybrid_work many_decades out_of_memory
        wide_cells)
  list(APPEND search_tests ${PROJECT_SOURCE_DIR}/properties/${test}_test.cpp)
endforeach()
add_executable(catena_search_tests EXCLUDE_FROM_ALL ${search_tests})
target_link_libraries(catena_search_tests PRIVATE catena_program GTest::gtest_main rapidcheck hwy::hwy)
target_precompile_headers(catena_search_tests PRIVATE ${CATENA_PRECOMPILED} <gtest/gtest.h>)
catena_together(catena_search_tests)
set_target_properties(catena_search_tests PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
