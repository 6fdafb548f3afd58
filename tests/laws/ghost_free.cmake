# SPDX-License-Identifier: Apache-2.0
vitrail_test(ghost_free LABEL law
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/ghost_free_test.cpp ${CMAKE_CURRENT_LIST_DIR}/ghost_free.cpp
          ${CMAKE_CURRENT_LIST_DIR}/clipping.cpp ${CMAKE_CURRENT_LIST_DIR}/edge_chain.cpp
          ${CMAKE_CURRENT_LIST_DIR}/../partitioner/test_scenes.cpp
  LIBRARIES vitrail::partitioner CGAL::CGAL OpenMeshCore)
