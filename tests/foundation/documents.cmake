# What documents say of the repository is there: pages that comments name, links between pages, tests that pages call their proof.
#
#   cmake -D ROOT=<root> -P documents.cmake
cmake_minimum_required(VERSION 3.25)

set(faults "")
string(ASCII 1 opening) # stand for square brackets, which mean something to CMake's lists, as semicolons do
string(ASCII 2 closing)

# A file as one text, in which a list can be made of anything.
function(read_plain file result)
  file(READ "${file}" text)
  string(REPLACE ";" "," text "${text}")
  string(REPLACE "[" "${opening}" text "${text}")
  string(REPLACE "]" "${closing}" text "${text}")
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

file(GLOB pages RELATIVE "${ROOT}" "${ROOT}/*.md" "${ROOT}/doc/*.md" "${ROOT}/doc/theory/*.md" "${ROOT}/doc/tutorials/*.md"
     "${ROOT}/coupling/*.md" "${ROOT}/meshes/*.md" "${ROOT}/tests/*.md")

foreach(page IN LISTS pages)
  read_plain("${ROOT}/${page}" text)
  get_filename_component(folder "${ROOT}/${page}" DIRECTORY)

  # Links and pictures: ](place), but for the web and for headings of the same page.
  string(REGEX MATCHALL "${closing}\\([^)\n ]+\\)" links "${text}")
  foreach(link IN LISTS links)
    string(REGEX REPLACE "^${closing}\\(([^)#]*)(#.*)?\\)$" "\\1" place "${link}")
    if(place STREQUAL "" OR place MATCHES "^(https?|mailto):")
      continue()
    endif()
    if(NOT EXISTS "${folder}/${place}")
      list(APPEND faults "${page}: links to ${place}, which is not there")
    endif()
  endforeach()

  # Code: a path of the house between back ticks.
  string(REGEX MATCHALL "`(apps|base|coupling|dem|fem|meshes|postprocess|tests)/[a-z0-9_./]+`" places "${text}")
  foreach(place IN LISTS places)
    string(REPLACE "`" "" place "${place}")
    file(GLOB found "${ROOT}/${place}.*")
    if(NOT found AND NOT EXISTS "${ROOT}/${place}")
      list(APPEND faults "${page}: names ${place}, which is not there")
    endif()
  endforeach()

  # Proofs: | `tests/file.cc` | name of the test |
  string(REGEX MATCHALL "\n\\| `tests/[^`]+` \\| [^\n]+ \\|" proofs "${text}")
  foreach(proof IN LISTS proofs)
    string(REGEX REPLACE "^\n\\| `([^`]+)` \\| (.+) \\|$" "\\1" file "${proof}")
    string(REGEX REPLACE "^\n\\| `([^`]+)` \\| (.+) \\|$" "\\2" name "${proof}")
    if(NOT EXISTS "${ROOT}/${file}")
      list(APPEND faults "${page}: names ${file}, which is not there")
      continue()
    endif()
    read_plain("${ROOT}/${file}" source)
    string(FIND "${source}" "\"${name}\"" at)
    if(at LESS 0)
      list(APPEND faults "${page}: ${file} has no test \"${name}\"")
    endif()
  endforeach()
endforeach()

# Every scene that is shipped has its page.
file(GLOB tutorials "${ROOT}/doc/tutorials/*.md")
set(taught "")
foreach(page IN LISTS tutorials)
  read_plain("${page}" text)
  string(APPEND taught "${text}")
endforeach()
file(GLOB scenes RELATIVE "${ROOT}" "${ROOT}/apps/scenes/*.prm" "${ROOT}/apps/scenes/*.json")
foreach(scene IN LISTS scenes)
  string(FIND "${taught}" "breccia run ${scene}" at)
  if(at LESS 0)
    list(APPEND faults "${scene}: no page of doc/tutorials runs it")
  endif()
endforeach()

file(STRINGS "${ROOT}/README.md" lines)
list(LENGTH lines count)
if(count GREATER 80)
  list(APPEND faults "README.md: ${count} lines, more than the 80 that invite")
endif()

# Comments: pages that they name exist, and nothing refers to papers that are not in the repository.
file(GLOB_RECURSE sources RELATIVE "${ROOT}" "${ROOT}/apps/*.h" "${ROOT}/apps/*.cc" "${ROOT}/apps/*.prm" "${ROOT}/base/*.h" "${ROOT}/dem/*.h"
     "${ROOT}/dem/*.cc" "${ROOT}/fem/*.h" "${ROOT}/fem/*.cc" "${ROOT}/coupling/*.h" "${ROOT}/coupling/*.cc"
     "${ROOT}/postprocess/*.h" "${ROOT}/postprocess/*.cc" "${ROOT}/tests/*.h" "${ROOT}/tests/*.cc")
foreach(file IN LISTS sources)
  read_plain("${ROOT}/${file}" text)
  if(text MATCHES "[Ss]pecification")
    list(APPEND faults "${file}: speaks of a specification; name the page of doc/theory and its section")
  endif()
  string(REGEX MATCHALL "doc/[a-z0-9_/-]+[.]md(, [0-9]+)?" references "${text}")
  foreach(reference IN LISTS references)
    string(REGEX MATCH "^doc/[a-z0-9_/-]+[.]md" page "${reference}")
    if(NOT EXISTS "${ROOT}/${page}")
      list(APPEND faults "${file}: names ${page}, which is not there")
    elseif(reference MATCHES ", ([0-9]+)$")
      set(section "${CMAKE_MATCH_1}")
      file(STRINGS "${ROOT}/${page}" heading REGEX "^## ${section}[.] ")
      if(NOT heading)
        list(APPEND faults "${file}: names section ${section} of ${page}, which is not there")
      endif()
    endif()
  endforeach()
endforeach()

if(faults)
  list(JOIN faults "\n  " text)
  message(FATAL_ERROR "documents that do not hold:\n  ${text}")
endif()
