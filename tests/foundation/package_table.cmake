# The table of packages in README.md says what packages.txt says: same packages, same reasons, same order; then, in a row each, those of
# the documentation and of the Python module.
#
#   cmake -D ROOT=<root> -P package_table.cmake
cmake_minimum_required(VERSION 3.25)

file(STRINGS "${ROOT}/packages.txt" lines REGEX "^[a-z0-9]")
set(expected "")
foreach(line IN LISTS lines)
  if(NOT line MATCHES "^([^ ]+) +([a-z]+:[^ ]+) +(.+)$")
    message(FATAL_ERROR "packages.txt: not `name probe reason`: ${line}")
  endif()
  list(APPEND expected "| `${CMAKE_MATCH_1}` | ${CMAKE_MATCH_3} |")
endforeach()
file(STRINGS "${ROOT}/doc/site/packages.txt" of_site REGEX "^[a-z0-9]")
list(TRANSFORM of_site REPLACE "^([^ ]+) .*" "`\\1`")
list(JOIN of_site ", " of_site)
list(APPEND expected "| ${of_site} | the documentation as a site, installed by `./breccia doc` alone |")
file(STRINGS "${ROOT}/python/packages.txt" of_python REGEX "^[a-z0-9]")
list(TRANSFORM of_python REPLACE "^([^ ]+) .*" "`\\1`")
list(JOIN of_python ", " of_python)
list(APPEND expected "| ${of_python} | the Python module, installed by `./breccia python` alone |")
file(STRINGS "${ROOT}/README.md" found REGEX "^\\| `")
if(NOT found OR NOT found STREQUAL expected)
  list(JOIN expected "\n" expected)
  message(FATAL_ERROR "the table of packages in README.md should be\n${expected}")
endif()
