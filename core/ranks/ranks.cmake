# A search shared by ranks: threads of one process are built everywhere; processes, in the folders ranks/mpi, where MPI is.
# AUTO takes MPI when it is found; OFF leaves no trace of it in the build.
set(CATENA_MPI AUTO CACHE STRING "Ranks under mpirun: AUTO, ON or OFF")

if(NOT CATENA_MPI STREQUAL "OFF")
  find_package(MPI QUIET COMPONENTS CXX)
  if(NOT MPI_CXX_FOUND AND CATENA_MPI STREQUAL "ON")
    message(FATAL_ERROR "CATENA_MPI=ON, but MPI was not found; install libopenmpi-dev, or set CATENA_MPI=AUTO")
  endif()
endif()
if(MPI_CXX_FOUND AND NOT CATENA_MPI STREQUAL "OFF")
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/core/ranks/mpi/*.cpp
       ${PROJECT_SOURCE_DIR}/reference/ranks/mpi/*.cpp ${PROJECT_SOURCE_DIR}/bench/ranks/mpi/*.cpp)
  add_library(catena_part_mpi OBJECT ${sources})
  target_link_libraries(catena_part_mpi PUBLIC catena_options fmt::fmt CLI11::CLI11 nlohmann_json::nlohmann_json MPI::MPI_CXX)
  target_compile_definitions(catena_part_mpi PUBLIC OMPI_SKIP_MPICXX)
  target_precompile_headers(catena_part_mpi PRIVATE ${CATENA_PRECOMPILED})
  target_link_libraries(catena_program PRIVATE catena_part_mpi)
endif()
