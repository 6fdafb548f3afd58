# SPDX-License-Identifier: Apache-2.0
vitrail_test(intersect LABEL unit
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/intersect_test.cpp ${CMAKE_CURRENT_LIST_DIR}/build_bvh_test.cpp
          ${CMAKE_CURRENT_LIST_DIR}/binary_tree_test.cpp
  LIBRARIES vitrail::intersect vitrail::partitioner embree TBB::tbb)
