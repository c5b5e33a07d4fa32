# `cmake --preset coverage && cmake --build --preset coverage` runs the fast suite and reports lines and branches of core/,
# variants/ and reference/ that it executes. Fails below 95 percent of the lines. Tests that only repeat the same lines on
# far more input (label volume) are left out: atomic counters make them ten times slower.
cmake_host_system_information(RESULT cores QUERY NUMBER_OF_LOGICAL_CORES)
find_program(GCOVR gcovr REQUIRED)
add_custom_target(coverage
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${PROJECT_BINARY_DIR}/coverage
  COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_BINARY_DIR}/coverage
  COMMAND find ${PROJECT_BINARY_DIR} -name *.gcda -delete
  COMMAND ${CMAKE_CTEST_COMMAND} --test-dir ${PROJECT_BINARY_DIR} --parallel ${cores} --output-on-failure --progress
          --label-exclude "^(long|gpu|report|volume|install)$"
  COMMAND ${GCOVR} --root ${PROJECT_SOURCE_DIR} --object-directory ${PROJECT_BINARY_DIR} ${PROJECT_BINARY_DIR}
          --filter ${PROJECT_SOURCE_DIR}/core/ --filter ${PROJECT_SOURCE_DIR}/variants/ --filter ${PROJECT_SOURCE_DIR}/reference/
          --exclude ".*_test\\.cpp" --exclude ".*/testing/.*" --exclude ".*/test_[a-z]*\\.h" --exclude-throw-branches --exclude-unreachable-branches
          --sort-percentage --txt ${PROJECT_BINARY_DIR}/coverage/report.txt --html-details ${PROJECT_BINARY_DIR}/coverage/index.html
          --print-summary --fail-under-line 95
  WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
  DEPENDS catena_tests catena_cli VERBATIM USES_TERMINAL)
