# SPDX-License-Identifier: Apache-2.0
vitrail_test(instances LABEL law
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/instances_test.cpp ${CMAKE_CURRENT_LIST_DIR}/awkward_rays.cpp
  LIBRARIES vitrail::tracer vitrail::partitioner TBB::tbb)
