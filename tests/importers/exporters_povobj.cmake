# SPDX-License-Identifier: Apache-2.0
vitrail_test(importers_povray_oracle LABEL conformance SOURCES povray_materials_test.cpp povray_oracle_test.cpp
  LIBRARIES vitrail::povray_exporter)
vitrail_test(importers_write_obj LABEL unit SOURCES write_obj_test.cpp
  LIBRARIES vitrail::obj_exporter vitrail::geometry_importers)
vitrail_test(importers_write_ply LABEL unit SOURCES write_ply_test.cpp
  LIBRARIES vitrail::export_support vitrail::geometry_importers)
