# `cmake --install` gives a library that another project finds with find_package(catena).
install(TARGETS catena EXPORT catena-targets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS catena_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
foreach(folder core reference properties)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/catena
          FILES_MATCHING PATTERN "*.h" PATTERN "testing" EXCLUDE PATTERN "test_*.h" EXCLUDE)
endforeach()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/core/readers/examples DESTINATION ${CMAKE_INSTALL_DATADIR}/catena)
install(EXPORT catena-targets NAMESPACE catena:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/catena)
configure_package_config_file(${PROJECT_SOURCE_DIR}/core/catena-config.cmake.in ${PROJECT_BINARY_DIR}/catena-config.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/catena)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/catena-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/catena-config.cmake ${PROJECT_BINARY_DIR}/catena-config-version.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/catena)
