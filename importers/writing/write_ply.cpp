// SPDX-License-Identifier: Apache-2.0
#include "importers/writing/write_ply.h"

#include <fmt/format.h>

#include <bit>
#include <string>
#include <string_view>

#include "importers/writing/own_scene.h"
#include "scene/system/atomic_file.h"

namespace vitrail {

namespace {

static_assert(std::endian::native == std::endian::little, "values are written as they lie in memory");

// Mitsuba finds an attribute by the element that it belongs to, and by a suffix for its channel.
void declare(std::string& header, const MeshAttribute& attribute) {
  if (attribute.name == face_indices) {
    header += "property float face_indices\n";
    return;
  }
  const std::string_view element = attribute.per_face ? "face_" : "vertex_";
  std::string_view name = attribute.name;
  if (name.starts_with(element)) name.remove_prefix(element.size());
  for (int c = 0; c < attribute.channels; ++c) header += fmt::format("property float {}_{}\n", name, c);
}

std::string header_of(const TriangleMesh& mesh) {
  std::string header = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment {}\nelement vertex {}\nproperty float x\nproperty float "
      "y\nproperty "
      "float "
      "z\n",
      scene_signature, mesh.positions.size());
  if (!mesh.normals.empty()) header += "property float nx\nproperty float ny\nproperty float nz\n";
  if (!mesh.uvs.empty()) header += "property float u\nproperty float v\n";
  for (const MeshAttribute& attribute : mesh.attributes)
    if (!attribute.per_face) declare(header, attribute);
  header += fmt::format("element face {}\nproperty list uchar int vertex_indices\n", mesh.triangles.size());
  for (const MeshAttribute& attribute : mesh.attributes)
    if (attribute.per_face) declare(header, attribute);
  return header + "end_header\n";
}

// Gathers small values into large writes.
class Buffer {
 public:
  explicit Buffer(AtomicFile& file) : file_(file) { bytes_.reserve(capacity); }
  template <class T>
  void put(const T& value) {
    const auto bytes = std::as_bytes(std::span(&value, 1));
    if (bytes_.size() + bytes.size() > capacity) flush();
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  void flush() {
    file_.write(bytes_);
    bytes_.clear();
  }

 private:
  static constexpr std::size_t capacity = 1 << 20;
  AtomicFile& file_;
  std::vector<std::byte> bytes_;
};

void put_attributes(Buffer& out, const TriangleMesh& mesh, bool per_face, std::size_t i) {
  for (const MeshAttribute& attribute : mesh.attributes) {
    if (attribute.per_face != per_face) continue;
    const auto channels = static_cast<std::size_t>(attribute.channels);
    for (std::size_t c = 0; c < channels; ++c) out.put(attribute.values[i * channels + c]);
  }
}

void put_mesh(const TriangleMesh& mesh, AtomicFile& file) {
  const std::string header = header_of(mesh);
  file.write(std::as_bytes(std::span(header)));
  Buffer out(file);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    out.put(mesh.positions[i]);
    if (!mesh.normals.empty()) out.put(mesh.normals[i]);
    if (!mesh.uvs.empty()) out.put(mesh.uvs[i]);
    put_attributes(out, mesh, false, i);
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    out.put(std::uint8_t{3});
    out.put(mesh.triangles[i]);
    put_attributes(out, mesh, true, i);
  }
  out.flush();
}

}  // namespace

void write_ply(const TriangleMesh& mesh, const std::filesystem::path& path) {
  AtomicFile file(path);
  put_mesh(mesh, file);
  file.commit();
}

void write_ply_part(const TriangleMesh& mesh, const std::filesystem::path& path) {
  AtomicFile file(path);
  put_mesh(mesh, file);
  file.commit_part();
}

}  // namespace vitrail
