// SPDX-License-Identifier: Apache-2.0
// The formats that are read: a row each.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "importers/reading/import_options.h"
#include "importers/reading/skimmed_scene.h"
#include "scene/records/scene.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

// What a reader gets.
struct ReadRequest {
  const std::filesystem::path& file;
  MeshMemory memory;
  std::function<void(double)> progress;  // may be empty
  const ImportOptions& options;
};

// A format that is read.
struct Reader {
  std::string_view name;                   // "Mitsuba", for messages
  std::vector<std::string_view> suffixes;  // ".xml", in lower case
  bool gzipped;                            // .gz may follow
  // Whether a file without a known suffix is one, by its first bytes (of a gzipped one as they are). Null:
  // nothing tells.
  bool (*sniff)(std::string_view first_bytes);
  ImportedScene (*read)(ReadRequest request);
  bool adds_view;         // the reader itself adds a camera and light where the file has none
  bool has_definitions;   // ImportOptions::definitions mean something
  bool has_many_cameras;  // ImportOptions::camera does
  // Models, which people hand on without their images more often than not: those are replaced unasked.
  bool goes_on_without_images = false;
  // Null: the format has no reading without its long lists.
  SkimmedScene (*skim)(const ReadRequest& request) = nullptr;
};

// All of them, in the order in which they are asked.
const std::vector<Reader>& readers();

// By the file's suffix, else by its first bytes. Throws Error that lists the suffixes.
const Reader& reader_of(const std::filesystem::path& file);

}  // namespace vitrail
