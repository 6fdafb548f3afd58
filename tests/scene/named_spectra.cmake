# SPDX-License-Identifier: Apache-2.0
vitrail_test(named_spectra LABEL unit SOURCES ${CMAKE_CURRENT_LIST_DIR}/named_spectra_test.cpp LIBRARIES vitrail::scene)
