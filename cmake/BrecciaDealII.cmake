# Target `breccia_dealii`: deal.II with its include folders and definitions, but not its compiler flags.
#
# deal_ii_setup_target() would add -O2, its warnings and the gold linker to our targets; linking the
# imported library leaves the optimisation, the linker and C++17 ours.
#
# -march=native is not given to sources that include deal.II: the library was compiled for the
# baseline processor, and classes whose size follows the vector width (VectorizedArray) must have one layout
# on both sides.

include("${DEAL_II_TARGET_CONFIG}")

add_library(breccia_dealii INTERFACE)
target_include_directories(breccia_dealii SYSTEM INTERFACE ${DEAL_II_INCLUDE_DIRS})
target_compile_definitions(breccia_dealii INTERFACE ${DEAL_II_USER_DEFINITIONS})
if(CMAKE_BUILD_TYPE STREQUAL "Release")
  target_link_libraries(breccia_dealii INTERFACE ${DEAL_II_TARGET_RELEASE})
else()
  # DEBUG switches deal.II's Assert on; it changes inline code and must match the library.
  target_compile_definitions(breccia_dealii INTERFACE ${DEAL_II_USER_DEFINITIONS_DEBUG})
  target_link_libraries(breccia_dealii INTERFACE ${DEAL_II_TARGET_DEBUG})
endif()
