# cmake --install BUILD [--prefix DIR]: the program with its modules and parameters, which find each other relative to it; the libraries
# with their headers for find_package(rotordrop); documents and examples.
set(data ${CMAKE_INSTALL_DATADIR}/rotordrop)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/rotordrop)

install(TARGETS rotordrop RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(ROTORDROP_FE)
  install(TARGETS rotordrop_fe rotordrop_mesh LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/rotordrop)
endif()
install(DIRECTORY src/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rotordrop FILES_MATCHING PATTERN "*.h"
        PATTERN thermal/fe EXCLUDE PATTERN cli EXCLUDE PATTERN study/report EXCLUDE)

install(DIRECTORY params DESTINATION ${data})
install(DIRECTORY examples/ DESTINATION ${data}/examples PATTERN __pycache__ EXCLUDE)
install(FILES README.md CHANGELOG.md CONTRIBUTING.md CITATION.cff LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} FILES_MATCHING PATTERN "*.md" PATTERN "*.png")
install(DIRECTORY ${ROTORDROP_HTML}/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/html OPTIONAL)

include(CMakePackageConfigHelpers)
install(EXPORT rotordrop NAMESPACE rotordrop:: FILE rotordropTargets.cmake DESTINATION ${package})
configure_package_config_file(cmake/rotordropConfig.cmake.in ${CMAKE_BINARY_DIR}/rotordropConfig.cmake INSTALL_DESTINATION ${package}
                              PATH_VARS data)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/rotordropConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/rotordropConfig.cmake ${CMAKE_BINARY_DIR}/rotordropConfigVersion.cmake cmake/RotordropLibraries.cmake
        DESTINATION ${package})
