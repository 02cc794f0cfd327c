# Target `breccia_dealii`: deal.II with its include folders and definitions, but not its compiler flags.
#
# deal_ii_setup_target() would add -O2, its warnings and the gold linker to our targets; linking the
# imported library leaves the optimisation, the linker and C++17 ours.
#
# Sources that include deal.II are compiled for the baseline processor, unlike dem. It would be safe to do otherwise: the
# width of VectorizedArray is fixed in deal.II/base/config.h when the library is built (Debian: one double), not by our
# flags. But with that width there is little to gain, and fem would round differently from one processor to the next.

include("${DEAL_II_TARGET_CONFIG}")

add_library(breccia_dealii INTERFACE)
target_include_directories(breccia_dealii SYSTEM INTERFACE ${DEAL_II_INCLUDE_DIRS})
target_compile_definitions(breccia_dealii INTERFACE ${DEAL_II_USER_DEFINITIONS})
if(CMAKE_BUILD_TYPE STREQUAL "Release")
  set(dealii_library ${DEAL_II_TARGET_RELEASE})
else()
  # DEBUG switches deal.II's Assert on; it changes inline code and must match the library.
  target_compile_definitions(breccia_dealii INTERFACE ${DEAL_II_USER_DEFINITIONS_DEBUG})
  set(dealii_library ${DEAL_II_TARGET_DEBUG})
endif()
target_link_libraries(breccia_dealii INTERFACE ${dealii_library})

# A program starts by searching its 220 libraries for symbols, one after the other. Most are those of Gmsh and OpenCASCADE, which deal.II needs, and
# which would stand behind all others. Named first they are found first: a start takes a sixth less time.
get_target_property(searched_first ${dealii_library} INTERFACE_LINK_LIBRARIES)
list(FILTER searched_first INCLUDE REGEX "/lib(gmsh|TK[A-Za-z0-9]+)\\.so$")
if(searched_first)
  target_link_options(breccia_dealii INTERFACE
    LINKER:--push-state,--no-as-needed -lstdc++ $<TARGET_FILE:${dealii_library}> ${searched_first} LINKER:--pop-state)
endif()

# What most sources that include deal.II read of it, for PRECOMPILED.
set(BRECCIA_DEALII_HEADERS
    <deal.II/base/mpi.h>
    <deal.II/distributed/tria.h>
    <deal.II/dofs/dof_handler.h>
    <deal.II/fe/fe_system.h>
    <deal.II/fe/fe_values.h>
    <deal.II/lac/affine_constraints.h>
    <deal.II/lac/trilinos_sparse_matrix.h>
    <deal.II/lac/trilinos_vector.h>
    <deal.II/lac/la_parallel_vector.h>
)
