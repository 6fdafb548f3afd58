# SPDX-License-Identifier: Apache-2.0
vitrail_test(spectrum_files LABEL unit
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/measured_sheet_test.cpp ${CMAKE_CURRENT_LIST_DIR}/spectrum_files_test.cpp
  LIBRARIES vitrail::spectrum_files vitrail::importers)
