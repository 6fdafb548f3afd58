# SPDX-License-Identifier: Apache-2.0
vitrail_test(meshes LABEL unit
  SOURCES meshes/decimate_test.cpp meshes/edit_meshes_test.cpp meshes/orient_test.cpp meshes/repair_test.cpp meshes/shapes.cpp
  LIBRARIES vitrail::importers vitrail::meshes vitrail::test_support CGAL::CGAL)
