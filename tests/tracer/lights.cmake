# SPDX-License-Identifier: Apache-2.0
vitrail_test(lights LABEL stat
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/light_tree_test.cpp ${CMAKE_CURRENT_LIST_DIR}/light_sampler_test.cpp
          ${CMAKE_CURRENT_LIST_DIR}/point_emitter_test.cpp ${CMAKE_CURRENT_LIST_DIR}/environment_test.cpp
          ${CMAKE_CURRENT_LIST_DIR}/light_textures_test.cpp
  LIBRARIES vitrail::lights)
