// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/import_readers.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <bit>
#include <chrono>
#include <fstream>
#include <functional>
#include <memory>
#include <stdexcept>

#include "importers/import.h"
#include "importers/ply/read/ply.h"
#include "scene/system/resource_usage.h"
#ifdef VITRAIL_BENCH_TINYOBJLOADER
#include <tiny_obj_loader.h>
#endif
#ifdef VITRAIL_BENCH_ASSIMP
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>
#endif

namespace vitrail::bench {

namespace {

// A line of /proc/self/status, in bytes.
std::uint64_t process_memory(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::uint64_t kibibytes = 0;
    if (word == name && status >> kibibytes) return kibibytes * 1024;
  }
  throw std::runtime_error("no " + name + " in /proc/self/status");
}

template <class Read>
auto timed(Measurement& measurement, Read&& read) {
  const std::uint64_t before = process_memory("VmHWM:");
  const auto start = std::chrono::steady_clock::now();
  const double cpu_before = cpu_seconds();
  auto result = read();
  measurement.cpu_seconds = cpu_seconds() - cpu_before;
  measurement.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  measurement.peak_bytes = process_memory("VmHWM:") - before;
  return result;
}

std::uint64_t mixed(std::uint64_t sum, float value) {
  sum = (sum ^ std::bit_cast<std::uint32_t>(value)) * 0x9e3779b97f4a7c15u;
  return sum ^ (sum >> 29);
}

void account(const TriangleMesh& mesh, Measurement& m) {
  m.triangles += mesh.triangles.size();
  m.final_bytes += mesh.positions.size() * sizeof(Point3f) +
                   mesh.triangles.size() * sizeof mesh.triangles[0] + mesh.normals.size() * sizeof(Normal3f) +
                   mesh.uvs.size() * sizeof(Point2f);
  for (const auto& triangle : mesh.triangles) {
    std::uint64_t sum = 1;
    for (const std::uint32_t i : triangle) {
      const Point3f p = mesh.positions[i];
      const Normal3f n = mesh.normals.empty() ? Normal3f{} : mesh.normals[i];
      const Point2f uv = mesh.uvs.empty() ? Point2f{} : mesh.uvs[i];
      for (const float value : {p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y}) sum = mixed(sum, value);
    }
    m.digest += sum;
  }
}

Measurement with_vitrail(const std::filesystem::path& file) {
  Measurement m;
  if (file.extension() == ".ply") {
    account(timed(m, [&] { return read_ply(file); }), m);
  } else {
    const ImportedScene imported = timed(m, [&] { return import_scene(file); });
    for (const TriangleMesh& mesh : imported.scene.meshes) account(mesh, m);
  }
  return m;
}

std::uint64_t read_into(const std::filesystem::path& file, char* to, std::size_t size, bool onward) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw std::runtime_error("cannot open " + file.string());
  std::uint64_t total = 0;
  for (ssize_t got = 0; (got = ::read(descriptor, to + (onward ? total : 0), size)) > 0;)
    total += static_cast<std::uint64_t>(got);
  ::close(descriptor);
  return total;
}

Measurement through_buffer(const std::filesystem::path& file) {
  constexpr std::size_t size = 1u << 20;
  Measurement m;
  timed(m, [&] { return read_into(file, std::make_unique<char[]>(size).get(), size, false); });
  return m;
}

Measurement into_memory(const std::filesystem::path& file) {
  Measurement m;
  const auto size = static_cast<std::size_t>(std::filesystem::file_size(file));
  timed(m, [&] {
    std::unique_ptr<char[]> bytes(new char[size]);
    read_into(file, bytes.get(), size, true);
    return bytes;
  });
  return m;
}

#ifdef VITRAIL_BENCH_TINYOBJLOADER
struct TinyObj {
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
};

Measurement with_tinyobjloader(const std::filesystem::path& file) {
  Measurement m;
  const auto read = timed(m, [&] {
    auto obj = std::make_unique<TinyObj>();
    std::string warnings, errors;
    if (!tinyobj::LoadObj(&obj->attributes, &obj->shapes, &obj->materials, &warnings, &errors, file.c_str(),
                          nullptr, true, false))
      throw std::runtime_error(errors);
    return obj;
  });
  for (const tinyobj::shape_t& shape : read->shapes) m.triangles += shape.mesh.num_face_vertices.size();
  return m;
}
#endif

#ifdef VITRAIL_BENCH_ASSIMP
Measurement with_assimp(const std::filesystem::path& file) {
  Measurement m;
  Assimp::Importer importer;
  const aiScene* const scene =
      timed(m, [&] { return importer.ReadFile(file.string(), aiProcess_Triangulate); });
  if (!scene) throw std::runtime_error(importer.GetErrorString());
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) m.triangles += scene->mMeshes[i]->mNumFaces;
  return m;
}
#endif

using Reader = std::pair<std::string, Measurement (*)(const std::filesystem::path&)>;
const std::vector<Reader> all_readers{
    {"vitrail", with_vitrail},
    {"read", through_buffer},
    {"load", into_memory},
#ifdef VITRAIL_BENCH_TINYOBJLOADER
    {"tinyobjloader", with_tinyobjloader},
#endif
#ifdef VITRAIL_BENCH_ASSIMP
    {"assimp", with_assimp},
#endif
};

}  // namespace

std::vector<std::string> readers() {
  std::vector<std::string> names;
  for (const Reader& reader : all_readers) names.push_back(reader.first);
  return names;
}

Measurement measure(const std::string& reader, const std::filesystem::path& file) {
  for (const auto& [name, read] : all_readers)
    if (name == reader) return read(file);
  throw std::runtime_error("no reader " + reader);
}

}  // namespace vitrail::bench
