// SPDX-License-Identifier: Apache-2.0
#include "importers/writing/packed_files.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <map>
#include <set>
#include <span>

#include "scene/system/atomic_file.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

namespace fs = std::filesystem;

bool lies_in(const fs::path& file, const fs::path& folder) {
  const fs::path from_there = fs::weakly_canonical(file).lexically_relative(fs::weakly_canonical(folder));
  return !from_there.empty() && *from_there.begin() != "..";
}

void copy_bytes(const fs::path& from, const fs::path& to) {
  std::ifstream in(from, std::ios::binary);
  if (!in) throw Error("cannot read the file " + from.string());
  AtomicFile file(to);
  std::array<char, 1 << 16> piece{};
  while (in.read(piece.data(), piece.size()), in.gcount() > 0)
    file.write(std::as_bytes(std::span(piece).first(static_cast<std::size_t>(in.gcount()))));
  file.commit_part();
}

class Packer {
 public:
  explicit Packer(const fs::path& out)
      : home_(fs::absolute(out).parent_path()), folder_(home_ / (out.stem().string() + "-files")) {}

  void operator()(std::string& filename) {
    if (filename.empty() || lies_in(filename, home_)) return;
    const auto [known, is_new] = copies_.try_emplace(filename);
    if (is_new) known->second = copied(filename);
    filename = known->second;
  }

  // The file of a record that has one.
  void look_at(auto& record) {
    if constexpr (requires { record.filename; }) (*this)(record.filename);
  }

 private:
  std::string copied(const fs::path& file) {
    std::error_code error;
    fs::create_directory(folder_, error);
    if (error) throw MachineError("cannot create " + folder_.string() + ": " + error.message());
    const std::string stem = file.stem().string(), extension = file.extension().string();
    std::string name = stem + extension;
    for (int i = 2; !names_.insert(name).second; ++i) name = fmt::format("{}-{}{}", stem, i, extension);
    copy_bytes(file, folder_ / name);
    return (folder_ / name).string();
  }

  fs::path home_, folder_;
  std::map<std::string, std::string> copies_;
  std::set<std::string> names_;
};

}  // namespace

void pack_files(Scene& scene, const std::filesystem::path& out) {
  Packer pack(out);
  const auto record = [&](auto& model) { pack.look_at(model); };
  const auto grid = [&](auto& value) {
    if (auto* g = std::get_if<Grid>(&value)) pack.look_at(*g);
  };
  for (Texture& texture : scene.textures) std::visit(record, texture.model);
  for (Material& material : scene.materials) std::visit(record, material.model);
  for (Light& light : scene.lights) std::visit(record, light.model);
  for (Medium& medium : scene.media) {
    grid(medium.density);
    if (auto* both = std::get_if<AbsorptionScattering>(&medium.coefficients))
      grid(both->sigma_a), grid(both->sigma_s);
    if (auto* e = std::get_if<ExtinctionAlbedo>(&medium.coefficients)) grid(e->sigma_t), grid(e->albedo);
  }
}

}  // namespace vitrail
