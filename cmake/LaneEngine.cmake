# One source, compiled for every level of x86-64 that the program chooses among when it starts (base/wide_vectors.h).
#
# Inline functions and templates of a higher level must not leave its object: the linker keeps one of each, and might keep the one that an older
# processor does not understand. So each object is closed: nothing but its factory is global. tests/cli/test_instruction_sets.py looks.

find_program(ROTORDROP_LD NAMES ${CMAKE_CXX_COMPILER_TARGET}-ld.bfd ld.bfd)

# rotordrop_lane_engine(room source prefix): adds the objects to the library of a room.
function(rotordrop_lane_engine room source prefix)
  set(levels base)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND ROTORDROP_LD)
    list(APPEND levels v3 v4 v4_newton)
  endif()
  foreach(level IN LISTS levels)
    set(engine rotordrop_${prefix}_${level})
    add_library(${engine} OBJECT ${source})
    target_include_directories(${engine} PRIVATE ${CMAKE_SOURCE_DIR}/src)
    target_compile_features(${engine} PRIVATE cxx_std_20)
    target_compile_definitions(${engine} PRIVATE ROTORDROP_LANE_FACTORY=${prefix}_${level})
    set_target_properties(${engine} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_link_libraries(${engine} PRIVATE rotordrop_options)
    get_target_property(libraries rotordrop_${room} INTERFACE_LINK_LIBRARIES)
    target_compile_options(${engine} PRIVATE -fno-semantic-interposition -Wno-psabi)
    if(level STREQUAL base)
      target_sources(rotordrop_${room} PRIVATE $<TARGET_OBJECTS:${engine}>)
    else()
      string(SUBSTRING ${level} 0 2 instructions)
      target_compile_options(${engine} PRIVATE -march=x86-64-${instructions} $<$<CXX_COMPILER_ID:GNU>:-fno-gnu-unique>)
      if(level STREQUAL v4_newton)
        target_compile_definitions(${engine} PRIVATE ROTORDROP_ROOTS_BY_NEWTON)
      endif()
      set(closed ${CMAKE_CURRENT_BINARY_DIR}/${engine}.o)
      string(LENGTH ${prefix}_${level} length)
      add_custom_command(
        OUTPUT ${closed}
        DEPENDS $<TARGET_OBJECTS:${engine}>
        COMMAND ${ROTORDROP_LD} -r --force-group-allocation $<TARGET_OBJECTS:${engine}> -o ${closed}
        COMMAND ${CMAKE_OBJCOPY} --wildcard --keep-global-symbol=_ZN9rotordrop${length}${prefix}_${level}* ${closed}
        COMMAND_EXPAND_LISTS VERBATIM
        COMMENT "Closing ${prefix} of ${level}")
      set_source_files_properties(${closed} PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
      target_sources(rotordrop_${room} PRIVATE ${closed})
    endif()
  endforeach()
endfunction()
