# One program for every x86-64: kernels for x86-64-v2 (SSE4.2), v3 (AVX2) and v4 (AVX-512), of which the loader takes the best that the
# processor has. The bits are the same (doc/theory/numbers.md), so nobody can tell from results which it was.
#
# The loader of glibc (2.33 and later) looks for a shared library in glibc-hwcaps/x86-64-v4 and -v3 beside it first. So a room of
# several levels is one shared library each, of the same name; no source knows of it.

set(BRECCIA_LEVELS "")
if(BRECCIA_DISPATCH AND NOT BRECCIA_NATIVE AND NOT BRECCIA_VECTOR AND CMAKE_SYSTEM_NAME STREQUAL "Linux"
   AND CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|amd64|AMD64)$")
  set(BRECCIA_LEVELS v2 v3 v4)
endif()

include(GNUInstallDirs)
set(BRECCIA_LIBRARIES_BESIDE "${CMAKE_INSTALL_LIBDIR}/breccia") # of an installed program; no other program uses them

# breccia_room_of_levels(NAME SOURCES file... LIBRARIES target... PRIVATE_LIBRARIES target... PRECOMPILED header...)
#
# Target NAME is what others link, of the lowest level; NAME_v3 and NAME_v4 are built with it.
function(breccia_room_of_levels name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LIBRARIES;PRIVATE_LIBRARIES;PRECOMPILED")
  foreach(level IN LISTS BRECCIA_LEVELS)
    if(level STREQUAL "v2")
      set(target ${name})
      set(folder "")
    else()
      set(target ${name}_${level})
      set(folder "/glibc-hwcaps/x86-64-${level}")
      add_dependencies(${name} ${target})
    endif()
    add_library(${target} SHARED ${arg_SOURCES})
    target_link_libraries(${target} PUBLIC ${arg_LIBRARIES} PRIVATE ${arg_PRIVATE_LIBRARIES} breccia_native)
    target_compile_options(${target} PRIVATE -march=x86-64-${level})
    breccia_unite(${target})
    # Its own functions call each other, not what a program compiled for less has under the same name.
    target_link_options(${target} PRIVATE -Wl,-Bsymbolic-functions)
    set_target_properties(${target} PROPERTIES OUTPUT_NAME breccia_${name}
                                               LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/lib${folder}")
    if(arg_PRECOMPILED)
      breccia_precompile(${target} ${arg_PRECOMPILED})
    endif()
    install(TARGETS ${target} LIBRARY DESTINATION "${BRECCIA_LIBRARIES_BESIDE}${folder}")
  endforeach()
endfunction()
