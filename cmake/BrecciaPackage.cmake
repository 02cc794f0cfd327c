# What `cmake --install` leaves for programs of others: the rooms, their headers, and what find_package(Breccia) reads.
#
# Rooms of several levels of processors (BRECCIA_LEVELS) are installed for breccia alone: a program of one's own is built from a
# build for one processor.

if(BRECCIA_LEVELS)
  return()
endif()

include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/Breccia")

# Eigen's alignment is part of the layout of what headers define: a program must be compiled as the rooms are.
target_compile_definitions(base INTERFACE
  $<INSTALL_INTERFACE:EIGEN_MAX_ALIGN_BYTES=64> $<INSTALL_INTERFACE:EIGEN_MAX_STATIC_ALIGN_BYTES=64>)
target_compile_features(base INTERFACE cxx_std_17)
target_include_directories(base INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/breccia>)

set(BRECCIA_PACKAGE_TARGETS "")
foreach(target IN ITEMS breccia_native breccia_suitesparse breccia_dealii breccia_muparser breccia_ceres ${BRECCIA_ROOMS} runs scenes statistics optimisation)
  if(TARGET ${target})
    list(APPEND BRECCIA_PACKAGE_TARGETS ${target})
  endif()
endforeach()
install(TARGETS ${BRECCIA_PACKAGE_TARGETS} EXPORT BrecciaTargets
        ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}/breccia" COMPONENT development)
install(EXPORT BrecciaTargets NAMESPACE Breccia:: DESTINATION "${package_folder}" COMPONENT development)
foreach(room IN LISTS BRECCIA_ROOMS)
  install(DIRECTORY "${CMAKE_SOURCE_DIR}/${room}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/breccia"
          COMPONENT development FILES_MATCHING PATTERN "*.h")
endforeach()

configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/BrecciaConfig.cmake.in"
                              "${CMAKE_CURRENT_BINARY_DIR}/BrecciaConfig.cmake" INSTALL_DESTINATION "${package_folder}")
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/BrecciaConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/BrecciaConfig.cmake" "${CMAKE_CURRENT_BINARY_DIR}/BrecciaConfigVersion.cmake"
        DESTINATION "${package_folder}" COMPONENT development)
