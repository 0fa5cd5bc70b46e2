# rotordrop_room(NAME [SEPARATE] SOURCES ... DEPENDS rooms... LIBRARIES external...)
#
# One static library per room, rotordrop_NAME. Its own headers are included as "NAME/header.h". Rooms named in
# DEPENDS are the only ones whose headers it may include; tests/check_arrows.py holds the same table and reads the sources.
# SEPARATE: its sources are compiled one by one even with ROTORDROP_UNITY, for loops whose code is to depend on nothing else.
function(rotordrop_room name)
  cmake_parse_arguments(ROOM "SEPARATE" "" "SOURCES;DEPENDS;LIBRARIES" ${ARGN})
  add_library(rotordrop_${name} STATIC ${ROOM_SOURCES})
  target_include_directories(rotordrop_${name} PUBLIC $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}/src>
                                                      $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/rotordrop>)
  target_compile_features(rotordrop_${name} PUBLIC cxx_std_20)
  # Also for shared libraries, such as the Python module; calls stay as in a program.
  set_target_properties(rotordrop_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  # A module of parts (machine/parts_module.h) shares no inline variables of its own with other modules.
  target_compile_options(rotordrop_${name} PRIVATE -fno-semantic-interposition
                                           INTERFACE $<INSTALL_INTERFACE:$<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fno-gnu-unique>>)
  if(NOT ROOM_SEPARATE)
    rotordrop_unity(rotordrop_${name})
  endif()
  set_target_properties(rotordrop_${name} PROPERTIES EXPORT_NAME ${name})
  foreach(room IN LISTS ROOM_DEPENDS)
    target_link_libraries(rotordrop_${name} PUBLIC rotordrop_${room})
  endforeach()
  target_link_libraries(rotordrop_${name} PUBLIC ${ROOM_LIBRARIES} PRIVATE $<BUILD_INTERFACE:rotordrop_options>)
  install(TARGETS rotordrop_${name} EXPORT rotordrop DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
endfunction()

# With ROTORDROP_UNITY, compiles the sources of a target eight at a time. Names in anonymous namespaces must then be the only ones of their eight.
function(rotordrop_unity target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${ROTORDROP_UNITY} UNITY_BUILD_BATCH_SIZE 8)
endfunction()

# Sources without kernels whose small structures are to be copied number by number: a vector loaded from what was just stored as single numbers
# waits for the stores. 8 % of an observed right-hand side.
function(rotordrop_number_by_number)
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS
    "$<$<CXX_COMPILER_ID:GNU>:-fno-tree-vectorize>$<$<CXX_COMPILER_ID:Clang>:-fno-vectorize>")
endfunction()
