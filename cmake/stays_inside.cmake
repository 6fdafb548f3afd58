# SPDX-License-Identifier: Apache-2.0
# Fails where one of the OBJECTS (joined by |) defines a weak function. Weak data are the same whatever they are compiled for.
string(REPLACE "|" ";" objects "${OBJECTS}")
if(NOT objects)
  message(FATAL_ERROR "no object is named *_avx*")
endif()
foreach(object IN LISTS objects)
  execute_process(COMMAND ${NM} --defined-only --demangle ${object} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[0-9a-f]+ W [^\n]*" weak "${symbols}")
  if(weak)
    list(JOIN weak "\n  " names)
    message(SEND_ERROR "${object} defines weak functions:\n  ${names}")
  endif()
endforeach()
