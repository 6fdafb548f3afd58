# SPDX-License-Identifier: Apache-2.0
# What every writer shares, and the writers that have no reader of their own library.
vitrail_library(export_support
  SOURCES mesh_files.cpp ply/write_ply.cpp
  LIBRARIES vitrail::scene fmt::fmt)
