# cmake --install BUILD [--prefix DIR]: the program with its modules and parameters, which find each other relative to it; the libraries
# with their headers for find_package(rotordrop); documents and examples. Components: core, fe, studies, dev and python, one Debian package each.
set(data ${CMAKE_INSTALL_DATADIR}/rotordrop)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/rotordrop)

install(TARGETS rotordrop RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT core)
if(ROTORDROP_FE)
  install(TARGETS rotordrop_fe rotordrop_mesh LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/rotordrop COMPONENT fe)
  install(FILES $<TARGET_FILE:rotordrop_fe>.libraries $<TARGET_FILE:rotordrop_mesh>.libraries
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/rotordrop COMPONENT fe OPTIONAL)
endif()
# Modules of studies: with a package of their own (OpenTURNS and MPI are large, and few need them).
foreach(module rotordrop_mpi rotordrop_surrogate)
  if(TARGET ${module})
    install(TARGETS ${module} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/rotordrop COMPONENT studies)
  endif()
endforeach()
install(DIRECTORY src/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rotordrop COMPONENT dev FILES_MATCHING PATTERN "*.h"
        PATTERN thermal/fe EXCLUDE PATTERN cli EXCLUDE)

install(DIRECTORY params DESTINATION ${data} COMPONENT core)
install(DIRECTORY examples/ DESTINATION ${data}/examples COMPONENT core PATTERN __pycache__ EXCLUDE)
install(FILES README.md CHANGELOG.md CONTRIBUTING.md CITATION.cff LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT core)
# The program contains HDF5 (RotordropLibraries.cmake).
install(FILES /usr/share/doc/libhdf5-dev/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright.hdf5 COMPONENT core OPTIONAL)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT core FILES_MATCHING PATTERN "*.md" PATTERN "*.png" PATTERN "*.svg")
install(DIRECTORY ${ROTORDROP_HTML}/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/html COMPONENT core OPTIONAL)

# The Python package, where the prefix's Python looks for packages: Debian's own below /usr, those of the administrator below /usr/local, of a user or
# a virtual environment anywhere else. ROTORDROP_PYTHON_SITE: another folder below the prefix.
if(ROTORDROP_PYTHON)
  set(ROTORDROP_PYTHON_SITE "" CACHE STRING "Folder of Python packages below the prefix; empty: that of its Python")
  set(version python${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR})
  install(CODE "
    set(site \"${ROTORDROP_PYTHON_SITE}\")
    if(site STREQUAL \"\" AND CMAKE_INSTALL_PREFIX STREQUAL \"/usr\")
      set(site lib/python3/dist-packages)
    elseif(site STREQUAL \"\" AND CMAKE_INSTALL_PREFIX STREQUAL \"/usr/local\")
      set(site lib/${version}/dist-packages)
    elseif(site STREQUAL \"\")
      set(site lib/${version}/site-packages)
    endif()
    file(INSTALL DESTINATION \"\${CMAKE_INSTALL_PREFIX}/\${site}/rotordrop\" TYPE MODULE FILES \"$<TARGET_FILE:rotordrop_python>\")
    if(CMAKE_INSTALL_DO_STRIP)
      execute_process(COMMAND \"${CMAKE_STRIP}\" --strip-unneeded \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/\${site}/rotordrop/$<TARGET_FILE_NAME:rotordrop_python>\" COMMAND_ERROR_IS_FATAL ANY)
    endif()
    file(INSTALL DESTINATION \"\${CMAKE_INSTALL_PREFIX}/\${site}/rotordrop\" TYPE FILE FILES ${ROTORDROP_PYTHON_FILES})
  " COMPONENT python)
endif()

# Completions and manual pages as the program itself prints them.
set(texts ${CMAKE_BINARY_DIR}/texts)
add_custom_command(OUTPUT ${texts}/done
  COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:rotordrop> -DFOLDER=${texts} -P ${CMAKE_SOURCE_DIR}/cmake/write_texts.cmake
  DEPENDS rotordrop cmake/write_texts.cmake VERBATIM)
add_custom_target(texts ALL DEPENDS ${texts}/done)
install(DIRECTORY ${texts}/man1 ${texts}/man5 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT core OPTIONAL)
install(FILES ${texts}/rotordrop.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME rotordrop COMPONENT core OPTIONAL)
install(FILES ${texts}/rotordrop.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions RENAME _rotordrop COMPONENT core OPTIONAL)
install(FILES ${texts}/rotordrop.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT core OPTIONAL)

include(CMakePackageConfigHelpers)
install(EXPORT rotordrop NAMESPACE rotordrop:: FILE rotordropTargets.cmake DESTINATION ${package} COMPONENT dev)
configure_package_config_file(cmake/rotordropConfig.cmake.in ${CMAKE_BINARY_DIR}/rotordropConfig.cmake INSTALL_DESTINATION ${package}
                              PATH_VARS data)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/rotordropConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/rotordropConfig.cmake ${CMAKE_BINARY_DIR}/rotordropConfigVersion.cmake cmake/RotordropLibraries.cmake
        DESTINATION ${package} COMPONENT dev)
