# What a build may choose, and the flags that every target shares.

set(BRECCIA_KNOWN_ROOMS base dem fem coupling postprocess apps) # in the order of the arrows
set(BRECCIA_ROOMS "${BRECCIA_KNOWN_ROOMS}" CACHE STRING "Rooms to build; `dem` alone needs only Eigen and OpenMP")
option(BRECCIA_TESTS "Build the tests (needs Catch2)" ON)
option(BRECCIA_NATIVE "Compile dem for the processor of this machine (-march=native)" ON)
option(BRECCIA_DISPATCH "Without BRECCIA_NATIVE: dem for x86-64-v2, v3 and v4, of which the loader takes the best" ON)
set(BRECCIA_VECTOR "" CACHE STRING "Bytes of dem's vectors: 64, 32 or 16, for x86-64-v4, v3 or v2; empty: what the processor has")
option(BRECCIA_TRAP_FPE "Stop at the first invalid, divide-by-zero or overflow operation" OFF)
option(BRECCIA_SANITIZE "Address and undefined-behaviour sanitizers" OFF)

foreach(room IN LISTS BRECCIA_ROOMS)
  if(NOT room IN_LIST BRECCIA_KNOWN_ROOMS)
    string(REPLACE ";" ", " known "${BRECCIA_KNOWN_ROOMS}")
    message(FATAL_ERROR "BRECCIA_ROOMS = ${room}: no such room. Rooms: ${known}.")
  endif()
endforeach()
# Keep the order of the arrows, whatever order was typed. Every room stands on base.
list(APPEND BRECCIA_ROOMS base)
set(ordered_rooms ${BRECCIA_KNOWN_ROOMS})
foreach(room IN LISTS BRECCIA_KNOWN_ROOMS)
  if(NOT room IN_LIST BRECCIA_ROOMS)
    list(REMOVE_ITEM ordered_rooms ${room})
  endif()
endforeach()
set(BRECCIA_ROOMS ${ordered_rooms})

if(NOT BRECCIA_VECTOR MATCHES "^(64|32|16)?$")
  message(FATAL_ERROR "BRECCIA_VECTOR = ${BRECCIA_VECTOR}: 64, 32, 16 or empty.")
endif()

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release, Debug or RelWithDebInfo" FORCE)
endif()

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
# Rooms may become part of a shared library, a Python module say; calls inside a room stay direct all the same.
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
add_compile_options(-fno-semantic-interposition)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

find_program(BRECCIA_CCACHE ccache)
if(BRECCIA_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # What ccache must be allowed before it stores a compilation that reads a precompiled header; and build folders side by side share
  # what they compile alike.
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env CCACHE_SLOPPINESS=pch_defines,time_macros
      "CCACHE_BASEDIR=${CMAKE_SOURCE_DIR}" CCACHE_NOHASHDIR=1 "${BRECCIA_CCACHE}")
endif()
find_program(BRECCIA_MOLD mold)
if(BRECCIA_MOLD)
  add_link_options(-fuse-ld=mold)
endif()

add_compile_options(-Wall -Wextra -Wpedantic -Wshadow)
# a * b + c is rounded twice, whatever instructions the processor has: a compiler that contracts it as it likes gives other bits on
# the next processor, and a packing, in which rounding grows, another specimen.
add_compile_options(-ffp-contract=off)
# Eigen aligns its storage to the widest vector of the *translation unit*; dem is compiled for wider
# vectors than the other rooms. One fixed value for all of them keeps allocation and layout the same everywhere. Its vectors it may not
# use: sums would be formed in the order of their width, and products fused where the processor can.
add_compile_definitions(EIGEN_MAX_ALIGN_BYTES=64 EIGEN_MAX_STATIC_ALIGN_BYTES=64 EIGEN_DONT_VECTORIZE)
# Threads are ours alone: Eigen's own would split sums by their number. Nobody speaks to MPI by the C++ classes that its header
# would otherwise bring into every source.
add_compile_definitions(EIGEN_DONT_PARALLELIZE OMPI_SKIP_MPICXX=1 MPICH_SKIP_MPICXX=1)
include_directories("${CMAKE_SOURCE_DIR}") # #include "dem/laws/cpm.h"

if(BRECCIA_TRAP_FPE)
  add_compile_definitions(BRECCIA_TRAP_FPE)
endif()
if(BRECCIA_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()
