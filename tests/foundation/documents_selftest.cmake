# Plants documents in a small copy of the house and expects documents.cmake to refuse exactly the bad ones.
#
#   cmake -D SCRATCH=<folder to fill> -P documents_selftest.cmake
cmake_minimum_required(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/expected_refusal.cmake")

# expect(good|bad FILE TEXT): a house whose only interesting words are TEXT in FILE
function(expect outcome file text)
  file(REMOVE_RECURSE "${SCRATCH}")
  file(WRITE "${SCRATCH}/README.md" "# House\n")
  file(WRITE "${SCRATCH}/doc/theory/law.md" "# Law\n\n## 1. Equations\n\n$$\\operatorname{tr}(x)[y]$$\n\n## 2. Signs\n")
  file(WRITE "${SCRATCH}/tests/dem/law.cc" "TEST_CASE(\"the law holds; [always]\", \"[dem]\")\n")
  file(WRITE "${SCRATCH}/dem/law.h" "#pragma once\n")
  file(WRITE "${SCRATCH}/${file}" "first line\n${text}\nlast line\n")
  execute_process(COMMAND "${CMAKE_COMMAND}" -D ROOT=${SCRATCH} -P "${CMAKE_CURRENT_LIST_DIR}/documents.cmake"
                  RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE said)
  expect_refusal("${outcome}" "${file}" "${text}" "${status}" "${said}")
endfunction()

expect(good doc/other.md "[law](theory/law.md), [signs](theory/law.md#2-signs), [here](#first), [web](https://dealii.org)")
expect(bad doc/other.md "[law](law.md)")
expect(bad doc/tutorials/scene.md "![a picture](../picture.png)")
expect(bad README.md "see [law](doc/theory/gone.md#1)")

expect(good doc/other.md "Code: `dem/law.h`, `dem/law`, `tests/dem/`.")
expect(bad doc/other.md "Code: `dem/gone.h`.")

expect(good doc/other.md "| file | test |\n| `tests/dem/law.cc` | the law holds; [always] |")
expect(bad doc/other.md "| `tests/dem/law.cc` | the law holds |")
expect(bad doc/other.md "| `tests/dem/gone.cc` | the law holds |")

expect(good doc/tutorials/other.md "./breccia run apps/scenes/other.prm")
expect(bad apps/scenes/other.prm "set Kind = uniaxial")

expect(good dem/law.h "/// doc/theory/law.md, 2; and doc/theory/law.md")
expect(bad dem/law.h "/// doc/theory/gone.md, 2")
expect(bad tests/dem/law.cc "// doc/theory/law.md, 3")
expect(bad dem/law.h "/// as the specification, 3, has it")
file(REMOVE_RECURSE "${SCRATCH}")
