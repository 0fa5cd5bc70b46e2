# Compiler options of our own code, and the external libraries as targets. Everything comes from Debian's packages.
add_library(rotordrop_options INTERFACE)
target_compile_options(rotordrop_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Werror
  # GCC 12 sees overlapping copies in std::string's operator+ where there are none (GCC bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  # Clang warns of each "omp simd" loop that it does not vectorise: below -O2 of all.
  $<$<CXX_COMPILER_ID:Clang>:-Wno-pass-failed>
  # Neighbouring numbers that were just stored one by one, loaded as a pair, wait for the store: 3 % of a drop, 7 % with finite elements beside.
  $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize> $<$<CXX_COMPILER_ID:Clang>:-fno-slp-vectorize>
  # Small structures are set to zero by stores: "rep stos" takes some 30 cycles to begin. 5 % of a right-hand side.
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<STREQUAL:${CMAKE_SYSTEM_PROCESSOR},x86_64>>:-mstringop-strategy=unrolled_loop>
  # Structures are copied and set to zero by the widest vectors that a level has: what was stored in pieces and is then loaded as a whole waits for the
  # stores. Left to itself, GCC takes pieces of 16 bytes for level v3.
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<STREQUAL:${CMAKE_SYSTEM_PROCESSOR},x86_64>>:-mmove-max=512 -mstore-max=512>
  # Lets sqrt and min/max vectorise; NaN keeps its meaning (unlike -ffast-math), and only loops marked "omp simd" are reordered.
  -fno-math-errno -fno-trapping-math -fopenmp-simd)
if(ROTORDROP_SANITIZE)
  # GCC warns of <regex> as uninitialised where it is sanitized (GCC bug 105562).
  add_compile_options(-fsanitize=address,undefined -fno-omit-frame-pointer -fno-sanitize-recover=undefined
    -Wno-maybe-uninitialized)
  add_link_options(-fsanitize=address,undefined)
endif()

if(ROTORDROP_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link,address -g)
  add_link_options(-fsanitize=address)
endif()

# A library that is not there is an error here, as if it were asked for by find_package(rotordrop REQUIRED).
set(CMAKE_FIND_PACKAGE_NAME rotordrop)
set(rotordrop_FIND_REQUIRED TRUE)
include(RotordropLibraries)
find_package(CLI11 REQUIRED)
