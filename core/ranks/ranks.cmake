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
  catena_take_commands(sources)
  add_library(catena_mpi INTERFACE)
  target_link_libraries(catena_mpi INTERFACE MPI::MPI_CXX)
  target_compile_definitions(catena_mpi INTERFACE OMPI_SKIP_MPICXX)
  set(CATENA_MPI_LIBRARY catena_mpi)  # for the commands
  add_library(catena_part_mpi OBJECT ${sources})
  target_link_libraries(catena_part_mpi PUBLIC catena_options fmt::fmt nlohmann_json::nlohmann_json catena_mpi)
  target_precompile_headers(catena_part_mpi PRIVATE ${CATENA_PRECOMPILED})
  target_link_libraries(catena_program PRIVATE catena_part_mpi)
endif()
