// SPDX-License-Identifier: Apache-2.0
// A Document is a glTF file with its buffers, as tinygltf has it. It knows where the parts of the file stand.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "importers/bytes/input_bytes.h"
#include "importers/gltf/read/json_places.h"
#include "importers/gltf/tinygltf.h"
#include "scene/records/scene.h"

namespace vitrail::gltf {

// Returns whether a file is a .glb by its first bytes, or a .gltf.
bool is_gltf(std::string_view first_bytes);

class Document {
 public:
  // Throws Error for a file that is no glTF 2.0, a buffer that is not there or too short, and an extension
  // that is required and not known here, with what to do where a tool takes it away.
  explicit Document(const std::filesystem::path& file);

  const tinygltf::Model& model() const { return model_; }
  const std::filesystem::path& file() const { return file_; }

  // `array` is a path as JsonPlaces has it: "meshes".
  SourceLocation place(const std::string& array, int index) const { return places_.at(array, index); }
  Origin origin(const std::string& array, int index) const;
  // Throws Error "meshes[3]: what", at its place.
  [[noreturn]] void fail(const std::string& array, int index, const std::string& what) const;
  // Returns the element, where there is one; else fails as `user` that refers to it.
  template <class T>
  const T& element(const std::vector<T>& all, int index, const char* name, const std::string& array,
                   int user) const {
    if (index < 0 || static_cast<std::size_t>(index) >= all.size())
      fail(array, user,
           "refers to " + std::string(name) + "[" + std::to_string(index) + "], and there are " +
               std::to_string(all.size()));
    return all[static_cast<std::size_t>(index)];
  }

  // Returns the name by which a record refers to an image: of its file, or of the part that holds it
  // (images/file_part.h).
  std::string image_file(int image) const;

  // Returns the extensions that are used and mean nothing here, by name.
  std::vector<std::string> unknown_extensions() const;

 private:
  void load();
  void require_known() const;

  std::filesystem::path file_;
  InputBytes bytes_;
  bool is_binary_;
  std::size_t json_at_ = 0;  // in the file
  std::size_t bin_at_ = 0;   // of the .glb's own buffer
  JsonPlaces places_;
  tinygltf::Model model_;
};

}  // namespace vitrail::gltf
