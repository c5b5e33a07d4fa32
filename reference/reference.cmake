# The exact reference (Boost.Multiprecision) and the peers it is compared with (FCL, when there is one).
find_package(Boost REQUIRED)
catena_part(reference CLI11::CLI11 nlohmann_json::nlohmann_json Boost::headers)
target_compile_definitions(catena_part_reference PRIVATE
  CATENA_EXAMPLES_IN_SOURCE="${PROJECT_SOURCE_DIR}/core/readers/examples"
  CATENA_EXAMPLES_INSTALLED="${CMAKE_INSTALL_FULL_DATADIR}/catena/examples")

if(NOT CATENA_FCL STREQUAL "OFF")
  find_package(fcl QUIET)
  if(fcl_FOUND)
    target_link_libraries(catena_part_reference PRIVATE fcl)
    target_compile_definitions(catena_part_reference PRIVATE CATENA_HAS_FCL)
  elseif(CATENA_FCL STREQUAL "ON")
    message(FATAL_ERROR "CATENA_FCL=ON, but FCL was not found; install libfcl-dev or set CATENA_FCL=AUTO")
  endif()
endif()
