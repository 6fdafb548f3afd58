# SPDX-License-Identifier: Apache-2.0
# The readers to compare with are optional: Debian's libtinyobjloader-dev and libassimp-dev.
add_executable(bench_import ${CMAKE_CURRENT_LIST_DIR}/import_bench.cpp ${CMAKE_CURRENT_LIST_DIR}/import_files.cpp
  ${CMAKE_CURRENT_LIST_DIR}/import_readers.cpp)
target_link_libraries(bench_import PRIVATE vitrail::importers fmt::fmt)

find_package(tinyobjloader CONFIG QUIET)
if(tinyobjloader_FOUND)
  target_link_libraries(bench_import PRIVATE tinyobjloader::tinyobjloader)
  target_compile_definitions(bench_import PRIVATE VITRAIL_BENCH_TINYOBJLOADER)
else()
  message(STATUS "bench_import: no tinyobjloader (libtinyobjloader-dev), so no ratio to it")
endif()

find_package(assimp CONFIG QUIET)
if(assimp_FOUND)
  target_link_libraries(bench_import PRIVATE assimp::assimp)
  target_compile_definitions(bench_import PRIVATE VITRAIL_BENCH_ASSIMP)
else()
  message(STATUS "bench_import: no assimp (libassimp-dev), so no ratio to it")
endif()
