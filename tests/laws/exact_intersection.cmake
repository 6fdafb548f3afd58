# SPDX-License-Identifier: Apache-2.0
vitrail_test(exact_intersection LABEL law
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/exact_intersection_test.cpp ${CMAKE_CURRENT_LIST_DIR}/awkward_rays.cpp
          ${CMAKE_CURRENT_LIST_DIR}/exact_oracle.cpp ${CMAKE_CURRENT_LIST_DIR}/../partitioner/test_scenes.cpp
  LIBRARIES vitrail::tracer vitrail::partitioner CGAL::CGAL TBB::tbb)
