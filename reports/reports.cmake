# `catena report`: a part of the program, not of its library. It measures through catena_timing; the page is made by
# the Python package catena_report, which needs Debian's python3 and its packages.
if(EXISTS /usr/bin/python3)
  set(python /usr/bin/python3)  # the distribution's, for which the packages are installed
else()
  set(python python3)
endif()
set(CATENA_PYTHON ${python} CACHE STRING "Python interpreter that writes the report's page")

file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/reports/*.cpp)
list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
add_library(catena_reports OBJECT ${sources})
target_link_libraries(catena_reports PUBLIC catena_program nlohmann_json::nlohmann_json Boost::headers)
target_precompile_headers(catena_reports PRIVATE ${CATENA_PRECOMPILED} <nlohmann/json.hpp>)
catena_together(catena_reports)
set_source_files_properties(${PROJECT_SOURCE_DIR}/reports/page_writer.cpp PROPERTIES COMPILE_DEFINITIONS
  "CATENA_PYTHON=\"${CATENA_PYTHON}\";CATENA_REPORTS_IN_SOURCE=\"${PROJECT_SOURCE_DIR}/reports\"")
install(DIRECTORY ${PROJECT_SOURCE_DIR}/reports/catena_report DESTINATION ${CMAKE_INSTALL_DATADIR}/catena COMPONENT program
        OPTIONAL PATTERN "__pycache__" EXCLUDE)
