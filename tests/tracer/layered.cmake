# SPDX-License-Identifier: Apache-2.0
vitrail_test(principled LABEL unit
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/measured_test.cpp ${CMAKE_CURRENT_LIST_DIR}/principled_test.cpp
  LIBRARIES vitrail::bsdf)
