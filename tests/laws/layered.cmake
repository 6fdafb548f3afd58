# SPDX-License-Identifier: Apache-2.0
vitrail_test(principled_laws LABEL law SOURCES ${CMAKE_CURRENT_LIST_DIR}/principled_laws_test.cpp
  LIBRARIES vitrail_bsdf_laws fmt::fmt)
