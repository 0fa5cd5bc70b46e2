# rotordrop_room(NAME SOURCES ... DEPENDS rooms... LIBRARIES external...)
#
# One static library per room, rotordrop_NAME. Its own headers are included as "NAME/header.h". Rooms named in
# DEPENDS are the only ones whose headers it may include; tests/check_arrows.py holds the same table and reads the sources.
function(rotordrop_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;DEPENDS;LIBRARIES" ${ARGN})
  add_library(rotordrop_${name} STATIC ${ROOM_SOURCES})
  target_include_directories(rotordrop_${name} PUBLIC ${CMAKE_SOURCE_DIR}/src)
  foreach(room IN LISTS ROOM_DEPENDS)
    target_link_libraries(rotordrop_${name} PUBLIC rotordrop_${room})
  endforeach()
  target_link_libraries(rotordrop_${name} PUBLIC ${ROOM_LIBRARIES} PRIVATE rotordrop_options)
endfunction()
