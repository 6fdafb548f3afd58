# SPDX-License-Identifier: Apache-2.0
add_executable(bench_lights ${CMAKE_CURRENT_LIST_DIR}/lights_bench.cpp)
target_link_libraries(bench_lights PRIVATE vitrail::lights fmt::fmt)
