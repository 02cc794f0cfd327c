# External packages, each looked for only when a room that uses it is built; what is missing is named all at once.
# The Debian packages that hold them stand in packages.txt.

set(missing_packages "")

# need(PACKAGE [arguments of find_package...])
macro(need package)
  find_package(${package} ${ARGN} QUIET)
  if(NOT ${package}_FOUND)
    list(APPEND missing_packages ${package})
  endif()
endmacro()

need(Eigen3 3.4 NO_MODULE)
need(OpenMP COMPONENTS CXX)
find_path(BRECCIA_SPECTRA_INCLUDE Spectra/SymEigsSolver.h)
if(NOT BRECCIA_SPECTRA_INCLUDE)
  list(APPEND missing_packages Spectra)
endif()

if("fem" IN_LIST BRECCIA_ROOMS OR "coupling" IN_LIST BRECCIA_ROOMS OR "apps" IN_LIST BRECCIA_ROOMS)
  need(deal.II 9.4)
endif()
if("postprocess" IN_LIST BRECCIA_ROOMS)
  # The MPI build of HDF5 is the one that deal.II is linked to: one program, one HDF5. Its header includes mpi.h.
  set(HDF5_PREFER_PARALLEL ON)
  need(HDF5 COMPONENTS C)
  if(HDF5_IS_PARALLEL)
    need(MPI COMPONENTS C)
  endif()
  need(VTK 9.1 COMPONENTS CommonCore CommonDataModel IOXML)
  need(nlohmann_json)
endif()
if("apps" IN_LIST BRECCIA_ROOMS)
  need(CLI11)
  need(fmt)
  need(spdlog)
endif()
if(BRECCIA_TESTS)
  need(Catch2 2.13)
endif()

if(missing_packages)
  list(JOIN missing_packages ", " missing_packages)
  message(FATAL_ERROR "Not found: ${missing_packages}. On Debian packages.txt names what to install; elsewhere name the "
                      "prefixes in CMAKE_PREFIX_PATH. BRECCIA_ROOMS=dem needs least.")
endif()

if(HDF5_FOUND AND HDF5_IS_PARALLEL)
  target_link_libraries(hdf5::hdf5 INTERFACE MPI::MPI_C)
endif()
