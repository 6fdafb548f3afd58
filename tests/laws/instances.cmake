# SPDX-License-Identifier: Apache-2.0
vitrail_test(instances LABEL law
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/instances_test.cpp ${CMAKE_CURRENT_LIST_DIR}/awkward_rays.cpp
  LIBRARIES vitrail::tracer vitrail::partitioner TBB::tbb)
vitrail_test(kept_instances LABEL equiv TIMEOUT 900
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/kept_instances_test.cpp ${CMAKE_CURRENT_LIST_DIR}/../partitioner/test_scenes.cpp
  LIBRARIES vitrail::test_support)
set_tests_properties(kept_instances PROPERTIES RUN_SERIAL TRUE)
