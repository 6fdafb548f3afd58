# SPDX-License-Identifier: Apache-2.0
# What every writer shares, and the writers that have no reader of their own library.
vitrail_library(export_support
  SOURCES export_colors.cpp flat_shapes.cpp mesh_files.cpp ply/write_ply.cpp ply/write_ply_scene.cpp
  LIBRARIES vitrail::scene fmt::fmt)

vitrail_library(povray_exporter
  SOURCES
    povray/camera.cpp povray/emitters.cpp povray/environment.cpp povray/images.cpp povray/lights.cpp povray/material_uses.cpp
    povray/materials.cpp povray/meshes.cpp povray/pigments.cpp povray/units.cpp povray/write_povray.cpp
  LIBRARIES vitrail::export_support vitrail::scene fmt::fmt)

vitrail_library(obj_exporter
  SOURCES obj/mtl_text.cpp obj/write_mtl.cpp obj/write_obj.cpp
  LIBRARIES vitrail::export_support vitrail::scene fmt::fmt)
