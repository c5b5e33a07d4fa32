# The report's tests: Python's unittest on Debian's packages, run by ctest (label report). What a machine lacks is said
# when it is configured, and by each test that is skipped for it.
find_program(CATENA_REPORT_PYTHON NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH DOC "Python with Debian's packages")
set(report_lacks "")
if(CATENA_REPORT_PYTHON)
  foreach(package numpy scipy matplotlib jinja2)
    execute_process(COMMAND ${CATENA_REPORT_PYTHON} -c "import ${package}" RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
    if(failed)
      string(APPEND report_lacks " python3-${package}")
    endif()
  endforeach()
else()
  set(report_lacks " python3")
endif()
if(report_lacks)
  message(STATUS "The report and its tests are left out, not installed:${report_lacks}")
endif()

# One process for all that need no browser nor the page as a file: what Python's packages take to load is most of what
# such a file of tests takes. -B: nothing is written into the source tree.
file(GLOB report_tests CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/reports/tests/test_*.py)
set(alone browser viewer_browser page)
foreach(file ${report_tests})
  get_filename_component(name ${file} NAME_WE)
  string(REPLACE test_ "" name ${name})
  if(name IN_LIST alone)
    list(APPEND files_of_${name} ${file})
  else()
    list(APPEND files_of_sections ${file})
  endif()
endforeach()
foreach(name sections ${alone})
  if(report_lacks)
    add_test(NAME report.${name} COMMAND ${CMAKE_COMMAND} -E echo "skipped, not installed:${report_lacks}")
    set_tests_properties(report.${name} PROPERTIES SKIP_REGULAR_EXPRESSION "^skipped")
  else()
    add_test(NAME report.${name} COMMAND ${CATENA_REPORT_PYTHON} -B -m unittest -v ${files_of_${name}}
             WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}/reports/tests)
    if(NOT name STREQUAL "sections")  # of hundreds, one that is skipped says nothing of the others
      set_tests_properties(report.${name} PROPERTIES SKIP_REGULAR_EXPRESSION "OK \\(skipped=[0-9]+\\)")
    endif()
  endif()
  set_tests_properties(report.${name} PROPERTIES LABELS report TIMEOUT 900 COST 50)
endforeach()

set_tests_properties(report.browser report.sections PROPERTIES COST 100)  # the longest of all start first
# A browser has processes of its own, and how soon it shows a page is measured.
set_tests_properties(report.browser report.viewer_browser PROPERTIES PROCESSORS 2)

# What the gate promises, on 200 pairs of runs instead of a few.
if(NOT report_lacks)
  add_test(NAME report.gate_long COMMAND ${CATENA_REPORT_PYTHON} -B ${PROJECT_SOURCE_DIR}/reports/tests/test_gate.py -v)
  set_tests_properties(report.gate_long PROPERTIES ENVIRONMENT CATENA_LONG=1 LABELS "report;long" TIMEOUT 1200)
endif()
