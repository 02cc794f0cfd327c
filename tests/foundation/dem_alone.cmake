# Configures and builds the room dem without deal.II, VTK, HDF5 and MPI, and runs its fast tests.
#
#   cmake -D SOURCE=<root> -D SCRATCH=<build folder> -D CTEST=<ctest> -D "OPTIONS=<-D options of this build>" \
#         -P dem_alone.cmake
#
# A package that is installed all the same is hidden from find_package; that no source includes it is the business
# of include_arrows.
cmake_minimum_required(VERSION 3.25)

set(hidden deal.II VTK HDF5 MPI CLI11 nlohmann_json fmt)
list(TRANSFORM hidden REPLACE "(.+)" "-DCMAKE_DISABLE_FIND_PACKAGE_\\1=ON")
execute_process(COMMAND "${CMAKE_COMMAND}" -S "${SOURCE}" -B "${SCRATCH}" -G Ninja -D BRECCIA_ROOMS=dem ${OPTIONS} ${hidden}
                COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${CMAKE_COMMAND}" --build "${SCRATCH}" --parallel 1 COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${CTEST}" --test-dir "${SCRATCH}" --output-on-failure --parallel 1
                        --label-regex "^fast$" --exclude-regex "^foundation: " --no-tests=error
                COMMAND_ERROR_IS_FATAL ANY)
