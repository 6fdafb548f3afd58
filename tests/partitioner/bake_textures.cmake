# SPDX-License-Identifier: Apache-2.0
# What is baked is looked up, too: the two must agree on every convention.
vitrail_test(bake_textures LABEL unit SOURCES bake_textures_test.cpp reflectance_fitter_test.cpp texture_graph_test.cpp
  LIBRARIES vitrail::partitioner vitrail::textures PkgConfig::OpenImageIO)
