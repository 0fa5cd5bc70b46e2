# Compiler options of our own code, and the external libraries as targets. Everything comes from Debian's packages.
add_library(rotordrop_options INTERFACE)
target_compile_options(rotordrop_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Werror
  # GCC 12 sees overlapping copies in std::string's operator+ where there are none (GCC bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  # Lets sqrt and min/max vectorise; NaN keeps its meaning (unlike -ffast-math), and only loops marked "omp simd" are reordered.
  -fno-math-errno -fno-trapping-math -fopenmp-simd)
if(ROTORDROP_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
  add_link_options(-fsanitize=address,undefined)
endif()

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(Boost 1.74 REQUIRED)
find_package(HDF5 REQUIRED COMPONENTS C)
find_package(SUNDIALS REQUIRED COMPONENTS arkode cvodes kinsol sunlinsoldense sunmatrixdense nvecserial)
find_package(CLI11 REQUIRED)

find_package(tomlplusplus REQUIRED)

# UDUNITS-2 ships no CMake package in Debian 12.
find_path(UDUNITS2_INCLUDE_DIR udunits2.h REQUIRED)
find_library(UDUNITS2_LIBRARY udunits2 REQUIRED)
add_library(udunits2 INTERFACE)
target_include_directories(udunits2 SYSTEM INTERFACE ${UDUNITS2_INCLUDE_DIR})
target_link_libraries(udunits2 INTERFACE ${UDUNITS2_LIBRARY})
add_library(hdf5_c INTERFACE)
target_include_directories(hdf5_c SYSTEM INTERFACE ${HDF5_C_INCLUDE_DIRS})
target_link_libraries(hdf5_c INTERFACE ${HDF5_C_LIBRARIES})
target_compile_definitions(hdf5_c INTERFACE ${HDF5_C_DEFINITIONS})
