# A search that is shared by ranks: threads of one process wherever it is built, processes where MPI is there. AUTO takes
# MPI when it is found; OFF leaves no trace of it in the build.
set(CATENA_MPI AUTO CACHE STRING "Ranks under mpirun: AUTO, ON or OFF")
catena_part(ranks CLI11::CLI11 nlohmann_json::nlohmann_json)

if(NOT CATENA_MPI STREQUAL "OFF")
  find_package(MPI QUIET COMPONENTS CXX)
  if(NOT MPI_CXX_FOUND AND CATENA_MPI STREQUAL "ON")
    message(FATAL_ERROR "CATENA_MPI=ON, but MPI was not found; install libopenmpi-dev, or set CATENA_MPI=AUTO")
  endif()
endif()
