# The exact reference (Boost.Multiprecision) and the peers it is compared with (each when it is there).
catena_part(reference nlohmann_json::nlohmann_json Boost::headers)
target_compile_definitions(catena_part_reference PRIVATE
  CATENA_EXAMPLES_IN_SOURCE="${PROJECT_SOURCE_DIR}/core/readers/examples"
  CATENA_EXAMPLES_INSTALLED="${CMAKE_INSTALL_FULL_DATADIR}/catena/examples")


# catena_peer(FILE FOUND PACKAGE [LIBRARIES...]): reference/peers/FILE.cpp has its library where it was FOUND; otherwise
# `catena list` says why not. Peers belong to the program; the library that others link has none of them.
function(catena_peer file found package)
  string(TOUPPER CATENA_${file} option)
  if(${option} STREQUAL "OFF")
    return()
  elseif(found)
    target_link_libraries(catena_part_reference PRIVATE ${ARGN})
    set_property(SOURCE ${PROJECT_SOURCE_DIR}/reference/peers/${file}.cpp PROPERTY COMPILE_DEFINITIONS CATENA_HAS_PEER)
  elseif(${option} STREQUAL "ON")
    message(FATAL_ERROR "${option}=ON, but ${file} was not found; install ${package}, or set ${option}=OFF")
  endif()
endfunction()

find_package(fcl QUIET)
catena_peer(FCL "${fcl_FOUND}" libfcl-dev fcl)
find_package(embree 3 QUIET)
find_package(TBB QUIET)
catena_peer(Embree "${embree_FOUND}" libembree-dev embree TBB::tbb)
find_package(nanoflann QUIET)
catena_peer(nanoflann "${nanoflann_FOUND}" libnanoflann-dev nanoflann::nanoflann)
find_package(Bullet QUIET CONFIG)
if(Bullet_FOUND)
  add_library(catena_bullet INTERFACE)
  target_include_directories(catena_bullet SYSTEM INTERFACE ${BULLET_ROOT_DIR}/${BULLET_INCLUDE_DIR})
  target_link_libraries(catena_bullet INTERFACE BulletCollision LinearMath)
endif()
catena_peer(Bullet "${Bullet_FOUND}" libbullet-dev catena_bullet)
find_path(CATENA_CGAL_HEADERS CGAL/box_intersection_d.h)
mark_as_advanced(CATENA_CGAL_HEADERS)
catena_peer(CGAL "${CATENA_CGAL_HEADERS}" libcgal-dev)
if(CATENA_CGAL)
  message(STATUS "CATENA_CGAL=ON: what is built has CGAL's box_intersection_d in it, which is under the GPL")
endif()
