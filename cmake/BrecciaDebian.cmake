# What `cpack -G DEB` packs: the program with the libraries beside it, its page for man and completion for shells, dependent on the Debian packages whose libraries it is linked with
# (dpkg-shlibdeps, of dpkg-dev, reads them). Headers and archives for programs of one's own stay with `cmake --install`.
#
# A build for one processor is packed as well, and its file says so: `native` in its name runs on processors like the builder's alone.
# For others: the preset `package`.

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME breccia)
set(CPACK_PACKAGE_VENDOR "Breccia developers")
set(CPACK_PACKAGE_CONTACT "Breccia developers")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_CMAKE_PROJECTS "${CMAKE_BINARY_DIR};${PROJECT_NAME};Unspecified;/")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "Breccia developers")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS gnuplot-nox) # pictures; without it a run says which are missing
if(BRECCIA_LEVELS)
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_BINARY_DIR}/lib")
else()
  set(CPACK_DEBIAN_FILE_NAME "breccia_${PROJECT_VERSION}_native.deb")
endif()
include(CPack)
