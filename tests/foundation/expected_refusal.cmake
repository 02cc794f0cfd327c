# expect_refusal(good|bad FILE WHAT STATUS SAID): a script that has read a planted FILE ends with STATUS, and names the file if it is bad
function(expect_refusal outcome file what status said)
  if(outcome STREQUAL "good" AND NOT status EQUAL 0)
    message(SEND_ERROR "${file}: ${what} was refused: ${said}")
  elseif(outcome STREQUAL "bad" AND (status EQUAL 0 OR NOT said MATCHES "${file}"))
    message(SEND_ERROR "${file}: ${what} was not refused by name: ${said}")
  endif()
endfunction()
