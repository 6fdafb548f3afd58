# SPDX-License-Identifier: Apache-2.0
vitrail_test(importers_environment_images LABEL unit
  SOURCES environment_images_test.cpp LIBRARIES vitrail::environment_images)
vitrail_test(importers_write_mitsuba LABEL unit
  SOURCES write_mitsuba_test.cpp LIBRARIES vitrail::mitsuba_exporter)
vitrail_test(importers_mitsuba_oracle LABEL conformance TIMEOUT 300
  SOURCES mitsuba_camera_test.cpp mitsuba_lights_test.cpp mitsuba_materials_test.cpp mitsuba_shapes_test.cpp
  LIBRARIES vitrail::mitsuba_exporter nlohmann_json::nlohmann_json)
