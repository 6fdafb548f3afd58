# SPDX-License-Identifier: Apache-2.0
# run(COMMAND …): ends the script where it fails; what it says is in `said`.
function(run)
  execute_process(COMMAND ${ARGV} OUTPUT_VARIABLE said ERROR_VARIABLE said RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGV}: ${status}\n${said}")
  endif()
  set(said ${said} PARENT_SCOPE)
endfunction()
