# cmake -DBUILD=... -DCTEST=... -DWORK=... -P labels_test.cmake
# ctest finds labels.cmake right in a build without CUDA too, whose tests are those of this build but for what *.cu files
# hold, and names what is wrong: a label of no test.
cmake_minimum_required(VERSION 3.25)
set(source ${CMAKE_CURRENT_LIST_DIR})

set(suites_of_cuda "")
file(GLOB files ${source}/*_test.cu)
foreach(file IN LISTS files)
  file(STRINGS ${file} tests REGEX "^TEST(_F|_P)?\\(")
  list(TRANSFORM tests REPLACE "^TEST(_F|_P)?\\(([A-Za-z]+),.*" "\\2")
  list(APPEND suites_of_cuda ${tests})
endforeach()
list(REMOVE_DUPLICATES suites_of_cuda)
if(NOT suites_of_cuda)
  message(FATAL_ERROR "no test in ${source}/*_test.cu")
endif()
list(JOIN suites_of_cuda "|" of_cuda)

# Asks ctest for the tests that carry `label`, in a build whose tests.cmake says `of_cuda` and names them without `left_out`.
function(tests_labelled label of_cuda left_out wanted)
  file(WRITE ${WORK}/CTestTestfile.cmake "
include(\"${discovered}\")
set(CATENA_TESTS_OF_CUDA ${of_cuda})
list(FILTER catena_tests_TESTS EXCLUDE REGEX \"${left_out}\")
include(\"${source}/labels.cmake\")
")
  execute_process(COMMAND ${CTEST} --test-dir ${WORK} -N -L "^${label}$" OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT said MATCHES "${wanted}")
    message(SEND_ERROR "ctest -N -L ${label}, CUDA ${of_cuda}, without ${left_out}: not ${wanted} but\n${said}")
  endif()
  if(wanted STREQUAL "${some}" AND said MATCHES "CMake Error")
    message(SEND_ERROR "${said}")
  endif()
endfunction()

file(GLOB discovered ${BUILD}/catena_tests*_include.cmake)
file(MAKE_DIRECTORY ${WORK})
set(of_cuda "(^|/)(${of_cuda})[./]")
set(some "Total Tests: [1-9]")
tests_labelled(gpu OFF "${of_cuda}" "${some}")
tests_labelled(long OFF "${of_cuda}" "${some}")
tests_labelled(long OFF "${of_cuda}|^Sizes[.]|(^|/)SizesLong" "no test is named Sizes")
