# compute-sanitizer as tests: label gpu; skipped, with the reason, where there is no device or no sanitizer.
foreach(tool memcheck racecheck initcheck synccheck)
  add_test(NAME compute-sanitizer.${tool} COMMAND ${PROJECT_SOURCE_DIR}/cuda/sanitize.sh ${tool} $<TARGET_FILE:catena_cli>)
  set_tests_properties(compute-sanitizer.${tool} PROPERTIES LABELS gpu SKIP_RETURN_CODE 77 RUN_SERIAL ON TIMEOUT 600)
endforeach()
