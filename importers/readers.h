// SPDX-License-Identifier: Apache-2.0
// This table has a row for each format that is read.
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

// A reader gets a ReadRequest.
struct ReadRequest {
  const std::filesystem::path& file;
  MeshMemory memory;
  std::function<void(double)> progress;  // may be empty
  const ImportOptions& options;
};

// A Reader reads one format.
struct Reader {
  std::string_view name;                   // "Mitsuba", for messages
  std::vector<std::string_view> suffixes;  // ".xml", in lower case
  bool gzipped;                            // .gz may follow
  // It tells whether a file without a known suffix is of this format, by its first bytes, of a gzipped file
  // as they are. It is null where nothing tells.
  bool (*sniff)(std::string_view first_bytes);
  ImportedScene (*read)(ReadRequest request);
  bool adds_view;         // the reader itself adds a camera and light where the file has none
  bool has_definitions;   // ImportOptions::definitions mean something
  bool has_many_cameras;  // ImportOptions::camera does
  // It holds for formats of models. People hand those on without their images more often than not, so missing
  // images are replaced unasked.
  bool goes_on_without_images = false;
  // It is null where the format cannot be read without its long lists.
  SkimmedScene (*skim)(const ReadRequest& request) = nullptr;
};

// Returns all readers, in the order in which they are asked.
const std::vector<Reader>& readers();

// Returns the reader for the file's suffix, else for its first bytes. Throws Error that lists the suffixes.
const Reader& reader_of(const std::filesystem::path& file);

}  // namespace vitrail
