// SPDX-License-Identifier: Apache-2.0
// Small glTF files that tests write.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "importers/gltf/read/gltf.h"
#include "tests/importers/temporary_folder.h"

namespace vitrail::test {

inline std::string base64(const std::string& bytes) {
  constexpr const char* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      out += k > bytes.size() - i ? '=' : letters[group >> (18 - 6 * k) & 63];
  }
  return out;
}

class GltfText {
 public:
  std::string bytes;  // of the buffer
  std::string views, accessors;

  int view(const std::string& content, const std::string& more = "") {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    views += fmt::format("{}{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{}{}}}", views.empty() ? "" : ",",
                         bytes.size(), content.size(), more);
    bytes += content;
    return views_++;
  }
  template <class T>
  int numbers(const std::vector<T>& values, int component_type, const char* type, int components,
              const std::string& more = "") {
    std::string content(values.size() * sizeof(T), '\0');
    if (!values.empty()) std::memcpy(content.data(), values.data(), content.size());
    return accessor(fmt::format("\"bufferView\":{},\"componentType\":{},\"type\":\"{}\",\"count\":{}{}",
                                view(content), component_type, type,
                                values.size() / static_cast<std::size_t>(components), more));
  }
  int floats(const std::vector<float>& values, int components) {
    constexpr const char* types[]{"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    return numbers(values, 5126, types[components], components);
  }
  int accessor(const std::string& members) {
    accessors += (accessors.empty() ? "{" : ",{") + members + "}";
    return accessors_++;
  }

  // A square of side 2 in the plane y = 0, its front up, as accessors 0 (POSITION) and 1 (indices), with
  // (u,v) as 2.
  void add_square() {
    floats({-1, 0, 1, 1, 0, 1, 1, 0, -1, -1, 0, -1}, 3);
    numbers<std::uint16_t>({0, 1, 2, 0, 2, 3}, 5123, "SCALAR", 1);
    floats({0, 1, 1, 1, 1, 0, 0, 0}, 2);
  }

  // The file, of these further members.
  std::string text(const std::string& members) const {
    std::string out = "{\"asset\":{\"version\":\"2.0\"}";
    if (!bytes.empty())
      out += fmt::format(
          ",\n\"buffers\":[{{\"byteLength\":{},\"uri\":\"data:application/octet-stream;base64,{}\"}}],\n"
          "\"bufferViews\":[{}],\n\"accessors\":[{}]",
          bytes.size(), base64(bytes), views, accessors);
    return out + (members.empty() ? "" : ",\n" + members) + "}";
  }

 private:
  int views_ = 0, accessors_ = 0;
};

inline ImportedScene read_text(const std::string& text, const ImportOptions& options = {}) {
  const TemporaryFolder folder;
  return read_gltf(folder.write("scene.gltf", text), MeshMemory{}, options);
}

inline const std::string square_mesh =
    R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":1,"material":0}]}])";
inline const std::string one_node = R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}])";

// The square with that material.
inline ImportedScene square_of(const std::string& material, const std::string& more = "") {
  GltfText file;
  file.add_square();
  return read_text(file.text(square_mesh + "," + one_node + ",\"materials\":[" + material + "]" + more));
}

inline bool mentions(const Diagnostics& diagnostics, const std::string& words) {
  for (const Diagnostic& d : diagnostics)
    if (d.message.find(words) != std::string::npos) return true;
  return false;
}

}  // namespace vitrail::test
