# Configures the room dem and its tests without deal.II, VTK, HDF5 and MPI, builds it, and finds the committed fingerprints of its scenes.
# All of its tests as well would be compiled, and run, a second time for nothing. The options are those of the build itself, so that ccache
# has every object already: seconds of work where it is installed, minutes where it is not.
#
#   cmake -D SOURCE=<root> -D SCRATCH=<build folder> -D CTEST=<ctest> -D "OPTIONS=<-D options of this build, blanks between them>" \
#         -P dem_alone.cmake
#
# A package that is installed all the same is hidden from find_package; that no source includes it, nor a test of the room, is the business
# of include_arrows.
cmake_minimum_required(VERSION 3.25)

separate_arguments(OPTIONS)
set(hidden deal.II VTK HDF5 MPI CLI11 nlohmann_json fmt)
list(TRANSFORM hidden REPLACE "(.+)" "-DCMAKE_DISABLE_FIND_PACKAGE_\\1=ON")
execute_process(COMMAND "${CMAKE_COMMAND}" -S "${SOURCE}" -B "${SCRATCH}" -G Ninja -D BRECCIA_ROOMS=dem ${OPTIONS} ${hidden}
                COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${CMAKE_COMMAND}" --build "${SCRATCH}" --parallel 1 --target dem test_fingerprints COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${CTEST}" --test-dir "${SCRATCH}" --output-on-failure --parallel 1
                        --tests-regex "^fingerprints: " --no-tests=error
                COMMAND_ERROR_IS_FATAL ANY)
