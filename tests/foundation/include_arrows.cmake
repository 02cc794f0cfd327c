# Reads every #include of the rooms and fails on an arrow that the architecture does not have.
#
#   cmake -D ROOT=<folder of the rooms> -P include_arrows.cmake
#
# A room may include itself, the standard library, and what is listed for it here: rooms by name, outside libraries
# by the beginning of what stands between < and >. Its sources and its tests (tests/<room>) obey the same list, the
# tests with Catch2 besides, and may name a header of their own folder without it; tests that belong to no room may
# include everything.

cmake_minimum_required(VERSION 3.25)
set(rooms dem fem coupling postprocess apps)
set(suffixes h hh hpp inl c cc cpp cxx in)

set(dem_rooms "")
# Spectra is Eigen's eigenvalue solver, headers only; CHOLMOD factorises for statics; the last two are the vectors of
# the compiler.
set(dem_libraries Eigen/ Spectra/ cholmod.h omp.h experimental/simd immintrin.h)
set(fem_rooms "")
# Eigen carries the 6-vectors of the material points: the library that dem has too, hence no new dependency. Epetra is what
# deal.II's own matrices are made of: to gather one on a rank.
set(fem_libraries deal.II/ umfpack.h cholmod.h mpi.h Eigen/ Epetra_)
# Adapters and writers speak the types in the interfaces of both sides.
set(coupling_rooms dem fem)
set(coupling_libraries deal.II/ mpi.h Eigen/ unsupported/Eigen/)
set(postprocess_rooms dem fem)
set(postprocess_libraries deal.II/ mpi.h Eigen/ hdf5 vtk fmt/ nlohmann/)
set(apps_rooms dem fem coupling postprocess)
set(apps_libraries anything)
# The operating system (POSIX) is under every room.
set(system_headers fcntl.h signal.h spawn.h stdlib.h sys/ unistd.h)

function(starts_with_any result text)
  set(${result} FALSE PARENT_SCOPE)
  foreach(prefix IN LISTS ARGN)
    string(FIND "${text}" "${prefix}" position)
    if(position EQUAL 0 OR prefix STREQUAL "anything")
      set(${result} TRUE PARENT_SCOPE)
    endif()
  endforeach()
endfunction()

# judge_*: what is wrong with a header that `file` of `room` includes; empty if nothing is.
function(judge_own problem room header)
  set(${problem} "" PARENT_SCOPE)
  cmake_path(GET file PARENT_PATH folder)
  if(is_test AND NOT header MATCHES "/" AND EXISTS "${ROOT}/${folder}/${header}")
    return()
  endif()
  set(allowed ${room} ${${room}_rooms})
  string(REGEX MATCH "^(tests/)?([^/]+)" owner "${header}")
  set(owner "${CMAKE_MATCH_2}")
  if(header MATCHES "\\.\\." OR NOT EXISTS "${ROOT}/${header}")
    set(${problem} "no such file from the root; own headers are included with the folder name" PARENT_SCOPE)
  elseif(owner IN_LIST rooms AND NOT owner IN_LIST allowed)
    set(${problem} "no arrow ${room} -> ${owner}" PARENT_SCOPE)
  elseif(header MATCHES "^tests/" AND NOT is_test)
    set(${problem} "the product does not include its tests" PARENT_SCOPE)
  endif()
endfunction()

function(judge_library problem room header)
  set(${problem} "" PARENT_SCOPE)
  set(allowed ${${room}_libraries} ${system_headers})
  if(is_test)
    list(APPEND allowed catch2/)
  endif()
  starts_with_any(known "${header}" ${allowed})
  if(NOT known AND NOT header MATCHES "^[a-z_0-9]+$") # <vector>, <cmath>: the standard library has no dot, no folder
    set(${problem} "${room} does not know this library" PARENT_SCOPE)
  endif()
endfunction()

function(check_file file room is_test)
  file(STRINGS "${ROOT}/${file}" lines REGEX "^[ \t]*#[ \t]*include")
  foreach(line IN LISTS lines)
    if(line MATCHES "include[ \t]*\"([^\"]+)\"")
      set(header "${CMAKE_MATCH_1}")
      judge_own(problem ${room} "${header}")
    elseif(line MATCHES "include[ \t]*<([^>]+)>")
      set(header "${CMAKE_MATCH_1}")
      judge_library(problem ${room} "${header}")
    else()
      set(header "${line}")
      set(problem "an include must name its file")
    endif()
    if(problem)
      list(APPEND problems "  ${file}: ${header}: ${problem}")
    endif()
  endforeach()
  set(problems ${problems} PARENT_SCOPE)
endfunction()

function(check_folder folder room is_test)
  set(patterns ${suffixes})
  list(TRANSFORM patterns PREPEND "${ROOT}/${folder}/*.")
  file(GLOB_RECURSE files RELATIVE "${ROOT}" ${patterns})
  foreach(file IN LISTS files)
    check_file(${file} ${room} ${is_test})
  endforeach()
  list(LENGTH files here)
  math(EXPR count "${count} + ${here}")
  set(count ${count} PARENT_SCOPE)
  set(problems ${problems} PARENT_SCOPE)
endfunction()

set(count 0)
set(problems "")
foreach(room IN LISTS rooms)
  check_folder(${room} ${room} FALSE)
  check_folder(tests/${room} ${room} TRUE)
endforeach()
if(count EQUAL 0)
  message(FATAL_ERROR "no source found below ${ROOT}")
endif()
if(problems)
  list(JOIN problems "\n" problems)
  message(FATAL_ERROR "includes against the architecture:\n${problems}")
endif()
message(STATUS "${count} files read")
