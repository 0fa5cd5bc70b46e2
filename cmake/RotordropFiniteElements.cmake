# deal.II as the target rotordrop_dealii, for the finite-element room alone. Its own macro deal_ii_setup_target adds optimisation flags,
# an older language standard and another linker in public, so its library is taken as it is.
find_package(deal.II 9.4.1 REQUIRED HINTS /usr/share/cmake/deal.II)
include(${DEAL_II_TARGET_CONFIG})
set(directories ${DEAL_II_INCLUDE_DIRS})
list(REMOVE_ITEM directories /usr/include)
add_library(rotordrop_dealii INTERFACE)
target_include_directories(rotordrop_dealii SYSTEM INTERFACE ${directories})
target_compile_definitions(rotordrop_dealii INTERFACE BOOST_NO_AUTO_PTR OMPI_SKIP_MPICXX)
if(CMAKE_BUILD_TYPE STREQUAL "Debug")
  target_link_libraries(rotordrop_dealii INTERFACE deal.ii.g)
  target_compile_definitions(rotordrop_dealii INTERFACE DEBUG)
else()
  target_link_libraries(rotordrop_dealii INTERFACE deal.ii)
endif()
find_library(ROTORDROP_PETSC NAMES petsc_real petsc REQUIRED)
find_library(ROTORDROP_MPI NAMES mpi REQUIRED)
target_link_libraries(rotordrop_dealii INTERFACE umfpack cholmod ${ROTORDROP_PETSC} ${ROTORDROP_MPI})
# The usual linker takes 9 s for what lld does in half a second.
target_link_options(rotordrop_dealii INTERFACE -fuse-ld=lld -Wl,--as-needed)

# Leaves the list beside a module by which the program opens its libraries (src/case/modules/load_module.cpp).
function(rotordrop_list_libraries module)
  if(CMAKE_CROSSCOMPILING)
    return()  # ldd runs on the machine that the module is for
  endif()
  add_custom_command(TARGET ${module} POST_BUILD VERBATIM
    COMMAND ${CMAKE_SOURCE_DIR}/cmake/list_libraries $<TARGET_FILE:${module}> > $<TARGET_FILE:${module}>.libraries)
endfunction()
