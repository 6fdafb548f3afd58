# SPDX-License-Identifier: Apache-2.0
add_executable(bench_meshes meshes_bench.cpp ../partitioner/test_scenes.cpp)
target_link_libraries(bench_meshes PRIVATE vitrail::importers vitrail::meshes CGAL::CGAL)
