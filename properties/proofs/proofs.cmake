# Every *.g here is a proof about constants of core/, checked by gappa; without it, a skipped test that
# says so.
find_program(CATENA_GAPPA gappa)
file(GLOB proofs CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/properties/proofs/*.g)
foreach(proof ${proofs})
  get_filename_component(name ${proof} NAME_WE)
  if(CATENA_GAPPA)
    add_test(NAME proof.${name} COMMAND ${CATENA_GAPPA} ${proof})
  else()
    add_test(NAME proof.${name} COMMAND ${CMAKE_COMMAND} -E echo "skipped, not installed: gappa")
    set_tests_properties(proof.${name} PROPERTIES SKIP_REGULAR_EXPRESSION "^skipped")
  endif()
  set_tests_properties(proof.${name} PROPERTIES LABELS proof TIMEOUT 120)
endforeach()
