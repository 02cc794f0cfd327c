# External packages, each looked for only when a room that uses it is built.

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(OpenMP REQUIRED COMPONENTS CXX)

if("fem" IN_LIST BRECCIA_ROOMS OR "coupling" IN_LIST BRECCIA_ROOMS OR "apps" IN_LIST BRECCIA_ROOMS)
  include(BrecciaDealII)
endif()
if("postprocess" IN_LIST BRECCIA_ROOMS OR "apps" IN_LIST BRECCIA_ROOMS)
  find_package(VTK 9.1 REQUIRED COMPONENTS CommonCore CommonDataModel IOXML)
  # The MPI build of HDF5 is the one that deal.II is linked to: one program, one HDF5.
  set(HDF5_PREFER_PARALLEL ON)
  find_package(HDF5 REQUIRED COMPONENTS C)
  find_package(nlohmann_json REQUIRED)
endif()
if("apps" IN_LIST BRECCIA_ROOMS)
  find_package(CLI11 REQUIRED)
  find_package(fmt REQUIRED)
  find_package(spdlog REQUIRED)
endif()
if(BRECCIA_TESTS)
  find_package(Catch2 2.13 REQUIRED)
endif()
