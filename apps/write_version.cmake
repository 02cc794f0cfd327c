# Writes the source of apps/process/version.h at build time, and only when the commit has changed (so that nothing else is rebuilt).
execute_process(COMMAND git -C "${SOURCE_FOLDER}" describe --always --dirty --abbrev=10
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
set(BRECCIA_COMMIT "")
if(NOT failed AND commit)
  set(BRECCIA_COMMIT " (${commit})")
endif()
configure_file("${SOURCE_FOLDER}/apps/version.cc.in" "${DESTINATION}" @ONLY)
