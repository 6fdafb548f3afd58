# SPDX-License-Identifier: Apache-2.0
# Readers of bare geometry, which the scene formats use too.
vitrail_library(geometry_importers
  SOURCES
    obj/mtl.cpp obj/mtl_map.cpp obj/mtl_material.cpp obj/obj.cpp obj/obj_chunk.cpp obj/obj_faces.cpp obj/obj_group.cpp
    obj/obj_meshes.cpp obj/obj_parser.cpp obj/obj_scene.cpp obj/obj_statements.cpp
    ply/input_bytes.cpp ply/mesh_read_ahead.cpp ply/ply.cpp ply/ply_attributes.cpp ply/ply_body.cpp ply/ply_header.cpp ply/text_cursor.cpp
    shapes/bilinear.cpp shapes/curve.cpp shapes/loop_subdivide.cpp shapes/point_tree.cpp shapes/polygon.cpp shapes/quadrics.cpp shapes/unit_circle.cpp
    shapes/vertex_normals.cpp
  LIBRARIES vitrail::scene OpenMeshCore ZLIB::ZLIB FastFloat::fast_float TBB::tbb fmt::fmt)
