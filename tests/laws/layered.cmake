# SPDX-License-Identifier: Apache-2.0
foreach(model layered principled)
  vitrail_test(${model}_laws LABEL law SOURCES ${CMAKE_CURRENT_LIST_DIR}/${model}_laws_test.cpp
    LIBRARIES vitrail_bsdf_laws fmt::fmt)
endforeach()
