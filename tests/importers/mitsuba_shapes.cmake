# SPDX-License-Identifier: Apache-2.0
vitrail_test(importers_mitsuba_shapes LABEL unit
  SOURCES mitsuba_read_shapes_test.cpp
  LIBRARIES vitrail::mitsuba vitrail::export_support ZLIB::ZLIB)
