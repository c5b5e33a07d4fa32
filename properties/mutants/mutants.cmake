# Label `long`: mutates the sources and asks whether the fast tests notice; the score and the survivors are printed. It
# builds in a scratch copy, never here. Half an hour of budget; by hand, give --budget and --paths as you like.
find_package(Python3 COMPONENTS Interpreter)
if(Python3_Interpreter_FOUND)
  add_test(NAME mutants.sources COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/properties/mutants/mutate_sources.py
           --source ${PROJECT_SOURCE_DIR} --work ${PROJECT_BINARY_DIR}/mutate_sources --budget 1800)
  set_tests_properties(mutants.sources PROPERTIES LABELS long TIMEOUT 3600)
endif()
