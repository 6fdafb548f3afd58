# SPDX-License-Identifier: Apache-2.0
vitrail_test(soups LABEL law TIMEOUT 300
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/soups_test.cpp ${CMAKE_CURRENT_LIST_DIR}/soup.cpp
          ${CMAKE_CURRENT_LIST_DIR}/soup_bundle.cpp ${CMAKE_CURRENT_LIST_DIR}/soup_laws.cpp
          ${CMAKE_CURRENT_LIST_DIR}/soup_rays.cpp ${CMAKE_CURRENT_LIST_DIR}/exact_view.cpp
          ${CMAKE_CURRENT_LIST_DIR}/ghost_free.cpp ${CMAKE_CURRENT_LIST_DIR}/clipping.cpp ${CMAKE_CURRENT_LIST_DIR}/edge_chain.cpp
          ${CMAKE_CURRENT_LIST_DIR}/../partitioner/test_scenes.cpp
  LIBRARIES vitrail::tracer vitrail::partitioner CGAL::CGAL TBB::tbb fmt::fmt)
