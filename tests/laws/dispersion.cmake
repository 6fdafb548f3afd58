# SPDX-License-Identifier: Apache-2.0
vitrail_test(dispersion LABEL furnace SOURCES ${CMAKE_CURRENT_LIST_DIR}/dispersion_test.cpp
  LIBRARIES vitrail::test_support)
vitrail_test(nested_dielectrics LABEL furnace SOURCES ${CMAKE_CURRENT_LIST_DIR}/nested_dielectrics_test.cpp
  LIBRARIES vitrail::test_support)
