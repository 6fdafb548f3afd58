# SPDX-License-Identifier: Apache-2.0
foreach(format ply obj obj_large polygon shapes)
  vitrail_test(importers_${format} LABEL unit SOURCES ${format}_test.cpp LIBRARIES vitrail::geometry_importers)
endforeach()
