# SPDX-License-Identifier: Apache-2.0
add_executable(bench_textures texture_bench.cpp)
target_link_libraries(bench_textures PRIVATE vitrail::partitioner vitrail::textures benchmark::benchmark)
