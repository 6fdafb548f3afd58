# SPDX-License-Identifier: Apache-2.0
add_executable(bench_intersect ${CMAKE_CURRENT_LIST_DIR}/intersect_bench.cpp)
target_link_libraries(bench_intersect PRIVATE vitrail::intersect vitrail::partitioner embree fmt::fmt)
add_executable(bench_instances ${CMAKE_CURRENT_LIST_DIR}/instances_bench.cpp)
target_link_libraries(bench_instances PRIVATE vitrail::intersect vitrail::partitioner embree fmt::fmt)
