# `cmake --install` gives what another project finds with find_package(catena): component `library`, with the headers of
# the library alone, and component `program`, with the files that the program reads.
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/catena)
set(private_libdir ${CMAKE_INSTALL_LIBDIR}/catena)
install(TARGETS catena EXPORT catena-library-targets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
        COMPONENT library NAMELINK_COMPONENT library)
foreach(folder ${CATENA_LIBRARY_FOLDERS})
  file(GLOB headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/core/${folder}/*.h)
  list(FILTER headers EXCLUDE REGEX "(-inl|/test_[a-z_]+)\\.h$")  # compiled once a target, and only in this library; tests'
  foreach(header ${headers})
    file(STRINGS ${PROJECT_SOURCE_DIR}/${header} highway REGEX "#include [<\"]hwy/")  # of which a user needs nothing
    if(NOT highway)
      list(APPEND CATENA_LIBRARY_HEADERS ${header})
    endif()
  endforeach()
endforeach()
list(APPEND CATENA_LIBRARY_HEADERS core/compiled_for.h core/default_floats.h core/error.h core/export.h core/host_device.h core/pair.h core/scattered.h core/sphere.h
     core/sphere_vector.h)
foreach(header ${CATENA_LIBRARY_HEADERS})
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES ${PROJECT_SOURCE_DIR}/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/catena/${folder} COMPONENT library)
endforeach()

set_target_properties(catena_cli PROPERTIES INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR};$ORIGIN/../${private_libdir}")
set_target_properties(catena_program PROPERTIES INSTALL_RPATH $ORIGIN/..)
install(TARGETS catena_cli EXPORT catena-program-targets RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(TARGETS catena_program LIBRARY DESTINATION ${private_libdir} COMPONENT program)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/core/readers/examples DESTINATION ${CMAKE_INSTALL_DATADIR}/catena COMPONENT program)

foreach(component library program)
  install(EXPORT catena-${component}-targets NAMESPACE catena:: DESTINATION ${package_dir} COMPONENT ${component})
endforeach()
# Not in the build tree's root, where a build that is on PATH would be found before what is installed in the system.
set(made ${PROJECT_BINARY_DIR}/generated)
file(REMOVE ${PROJECT_BINARY_DIR}/catena-config.cmake ${PROJECT_BINARY_DIR}/catena-config-version.cmake)  # of before
configure_package_config_file(${PROJECT_SOURCE_DIR}/core/catena-config.cmake.in ${made}/catena-config.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${made}/catena-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${made}/catena-config.cmake ${made}/catena-config-version.cmake DESTINATION ${package_dir} COMPONENT library)
