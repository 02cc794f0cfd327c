# Headers of other packages that most sources of a target read, parsed once; each source still includes what it uses.
option(BRECCIA_PRECOMPILE "Parse the headers of other packages once per library" ON)
function(breccia_precompile target)
  if(BRECCIA_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()

# The headers that another target has parsed, where the flags of both are the same.
function(breccia_share_precompiled target from)
  if(BRECCIA_PRECOMPILE)
    target_precompile_headers(${target} REUSE_FROM ${from})
  endif()
endfunction()

# Sources that are compiled together read their headers once between them: a clean build takes about three quarters of the time
# (857 against 1197 processor seconds, NATIVE rooms apart). Off: a change of one source compiles that one alone, and each must include what it uses.
# Bits do not hang on what the compiler sees at once: nothing is contracted that is not written so (BrecciaOptions.cmake).
option(BRECCIA_UNITY "Compile several sources of a library together" ON)
function(breccia_unite target)
  if(BRECCIA_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
    # GCC takes a source that is included for a header, whose unnamed namespaces others would see.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()

# breccia_room(NAME [SOURCES file...] [LIBRARIES target...] [PRIVATE_LIBRARIES target...] [PRECOMPILED header...] [NATIVE])
#
# One library for the room NAME: sources sorted and listed one by one; LIBRARIES are those that its own
# headers include. A room without a source is header-only. NATIVE: compiled for this processor (BRECCIA_NATIVE), or for several
# levels of processors (BRECCIA_DISPATCH).
function(breccia_room name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "NATIVE" "" "SOURCES;LIBRARIES;PRIVATE_LIBRARIES;PRECOMPILED")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "breccia_room(${name}): unknown argument ${arg_UNPARSED_ARGUMENTS}")
  endif()
  foreach(library IN LISTS arg_LIBRARIES arg_PRIVATE_LIBRARIES)
    if(library IN_LIST BRECCIA_KNOWN_ROOMS AND NOT TARGET ${library})
      message(FATAL_ERROR "BRECCIA_ROOMS = ${BRECCIA_ROOMS}: ${name} needs ${library} as well.")
    endif()
  endforeach()
  if(NOT arg_SOURCES)
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE ${arg_LIBRARIES} ${arg_PRIVATE_LIBRARIES})
    return()
  endif()
  if(arg_NATIVE AND BRECCIA_LEVELS)
    breccia_room_of_levels(${name} SOURCES ${arg_SOURCES} LIBRARIES ${arg_LIBRARIES}
                           PRIVATE_LIBRARIES ${arg_PRIVATE_LIBRARIES} PRECOMPILED ${arg_PRECOMPILED})
    return()
  endif()
  add_library(${name} STATIC ${arg_SOURCES})
  target_link_libraries(${name} PUBLIC ${arg_LIBRARIES} PRIVATE ${arg_PRIVATE_LIBRARIES})
  if(arg_NATIVE)
    target_link_libraries(${name} PRIVATE breccia_native)
  endif()
  breccia_unite(${name})
  if(arg_PRECOMPILED)
    breccia_precompile(${name} ${arg_PRECOMPILED})
  endif()
endfunction()

# Flags of the particle and link kernels. -fno-math-errno lets sqrt become one instruction; -ffast-math is
# refused: it would reorder sums and drop NaN, and with them "the same bits" and "NaN stops the run".
add_library(breccia_native INTERFACE)
target_compile_options(breccia_native INTERFACE -fno-math-errno)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC before 13 takes the deliberately undefined operands of its own AVX-512 header for a mistake, thousands of times
  # (its bug 105593).
  target_compile_options(breccia_native INTERFACE -Wno-maybe-uninitialized -Wno-uninitialized)
endif()
if(BRECCIA_VECTOR)
  # Every width on any machine: the instructions that all processors with such vectors have.
  set(level_of_64 v4)
  set(level_of_32 v3)
  set(level_of_16 v2)
  target_compile_options(breccia_native INTERFACE -march=x86-64-${level_of_${BRECCIA_VECTOR}})
  target_compile_definitions(breccia_native INTERFACE BRECCIA_VECTOR=${BRECCIA_VECTOR})
elseif(BRECCIA_NATIVE)
  # The same words mean other instructions on another machine: with the processor's name in the command, neither
  # ninja nor a compiler cache in a shared home folder takes an object file that was made elsewhere.
  set(processor "")
  if(EXISTS /proc/cpuinfo)
    file(STRINGS /proc/cpuinfo processor REGEX "^(flags|Features)" LIMIT_COUNT 1)
  endif()
  string(MD5 processor "${processor}")
  target_compile_options(breccia_native INTERFACE -march=native)
  target_compile_definitions(breccia_native INTERFACE BRECCIA_PROCESSOR=${processor})
endif()
