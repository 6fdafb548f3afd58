# SPDX-License-Identifier: Apache-2.0
# The programs that make bundles and look into files.
target_sources(vitrail_cli PRIVATE diagnostics_report.cpp)
vitrail_program(partition SOURCES partition.cpp partition_report.cpp apply_mesh_options.cpp
  LIBRARIES vitrail::cli vitrail::importers vitrail::meshes vitrail::partitioner nlohmann_json::nlohmann_json)
vitrail_program(convert SOURCES apply_mesh_options.cpp convert.cpp conversion_report.cpp
  LIBRARIES vitrail::cli vitrail::exporters vitrail::importers vitrail::meshes nlohmann_json::nlohmann_json)
vitrail_program(inspect SOURCES inspect.cpp inspect_appearance.cpp inspect_bundle.cpp inspect_domain.cpp inspect_scene.cpp report_text.cpp
  LIBRARIES vitrail::cli vitrail::bundle vitrail::environment_images vitrail::film vitrail::importers vitrail::partitioner nlohmann_json::nlohmann_json)
vitrail_program(verify SOURCES verify.cpp LIBRARIES vitrail::cli vitrail::bundle nlohmann_json::nlohmann_json)
