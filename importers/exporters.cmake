# SPDX-License-Identifier: Apache-2.0
# What writers share, and the writers that need no library of their reader.
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

# Images in another form than a scene has them.
vitrail_library(environment_images
  SOURCES images/environment_images.cpp
  LIBRARIES vitrail::image_files vitrail::scene)

vitrail_library(mitsuba_exporter
  SOURCES
    mitsuba/write_camera.cpp mitsuba/write_context.cpp mitsuba/write_film.cpp mitsuba/write_images.cpp
    mitsuba/write_lights.cpp mitsuba/write_materials.cpp mitsuba/write_media.cpp mitsuba/write_mitsuba.cpp
    mitsuba/write_models.cpp mitsuba/write_shapes.cpp mitsuba/write_sides.cpp mitsuba/write_spectra.cpp
    mitsuba/write_textures.cpp
  LIBRARIES vitrail::export_support vitrail::environment_images vitrail::geometry_importers vitrail::scene
            pugixml::pugixml fmt::fmt)
target_compile_definitions(vitrail_mitsuba_exporter PRIVATE VITRAIL_VERSION="${PROJECT_VERSION}")
