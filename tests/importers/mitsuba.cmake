# SPDX-License-Identifier: Apache-2.0
vitrail_test(importers_mitsuba_lights LABEL unit
  SOURCES mitsuba_emitters_test.cpp mitsuba_media_test.cpp mitsuba_objects.cpp mitsuba_sensor_test.cpp
  LIBRARIES vitrail::mitsuba vitrail::mitsuba_exporter pugixml::pugixml)
vitrail_test(importers_mitsuba LABEL unit SOURCES mitsuba_load_test.cpp LIBRARIES vitrail::mitsuba)
vitrail_test(importers_mitsuba_shapes LABEL unit
  SOURCES mitsuba_read_shapes_test.cpp
  LIBRARIES vitrail::mitsuba vitrail::export_support ZLIB::ZLIB)
