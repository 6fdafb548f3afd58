// SPDX-License-Identifier: Apache-2.0
#include "bundle/manifest.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <span>

#include "bundle/binary_records.h"
#include "bundle/checked_json.h"
#include "bundle/checksum.h"
#include "bundle/loaded_domain.h"
#include "bundle/manifest_json.h"
#include "bundle/read_file.h"
#include "bundle/record_fields.h"
#include "bundle/record_names.h"
#include "bundle/write_file.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

constexpr int manifest_version = 8;

// The binary files: 32 bytes of header, then the payload.

struct RecordsHeader {
  std::array<char, 8> magic;
  std::uint32_t version = 1;
  std::uint32_t reserved = 0;
  std::uint64_t payload_bytes = 0;
  std::uint64_t payload_checksum = 0;
};
static_assert(sizeof(RecordsHeader) == 32);

struct RecordsFile {
  const char* checksum;  // its key in the manifest
  std::array<char, 8> magic;
  void (*encode)(const Manifest&, const ByteSink&);
  void (*decode)(std::vector<std::byte>, const std::filesystem::path&, Manifest&);
};
// In the order of records_file_names.
constexpr std::array<RecordsFile, records_file_names.size()> records_files{{
    {"materials_checksum", {'V', 'I', 'T', 'R', 'M', 'A', 'T', '\n'}, encode_materials, decode_materials},
    {"lights_checksum", {'V', 'I', 'T', 'R', 'L', 'I', 'T', '\n'}, encode_lights, decode_lights},
    {"domains_checksum", {'V', 'I', 'T', 'R', 'D', 'O', 'S', '\n'}, encode_domains, decode_domains},
}};

// Goes through the records twice: the header, which comes first, has their size and checksum. Gives the
// latter.
std::uint64_t write_records(const std::filesystem::path& file, const RecordsFile& kind, const Manifest& m) {
  RecordsHeader header{kind.magic};
  Hasher hasher;
  kind.encode(m, [&](std::span<const std::byte> bytes) {
    hasher.add(bytes);
    header.payload_bytes += bytes.size();
  });
  header.payload_checksum = hasher.digest();
  write_file(file, [&](const ByteSink& write) {
    write(std::as_bytes(std::span(&header, 1)));
    kind.encode(m, write);
  });
  return header.payload_checksum;
}

// `expected` is the checksum that the manifest has for this file; empty: unknown.
std::vector<std::byte> read_records(const std::filesystem::path& file, std::array<char, 8> magic,
                                    const std::string& expected) {
  std::vector<std::byte> bytes = read_file(file);
  RecordsHeader header{};
  if (bytes.size() < sizeof header) throw Error("damaged file: its header is cut short", {file.string()});
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.magic != magic) throw Error("not a file of this bundle", {file.string()});
  if (header.version != 1)
    throw Error(fmt::format("version {}; this program reads version 1", header.version), {file.string()});
  bytes.erase(bytes.begin(), bytes.begin() + sizeof header);
  if (header.reserved != 0 || header.payload_bytes != bytes.size() ||
      header.payload_checksum != checksum(bytes))
    throw Error("damaged file: its size or checksum is wrong; partition the scene again", {file.string()});
  if (!expected.empty() && expected != fmt::format("{:016x}", header.payload_checksum))
    throw Error("this file belongs to another bundle; partition the scene again", {file.string()});
  return bytes;
}

void check_version(const Json& json, const std::filesystem::path& file) {
  if (json.at("format") != "vitrail bundle") throw Error("not the manifest of a bundle", {file.string()});
  if (json.at("version") != manifest_version)
    throw Error(fmt::format("bundle of version {}; this program reads version {}: partition the scene again",
                            json.at("version").dump(), manifest_version),
                {file.string()});
  required_bits(json.at("features").at("required").get<std::vector<std::string>>(), file);
}

bool has_correlated_masking(const Material& material) {
  return std::visit(
      [](const auto& m) {
        bool found = false;
        const auto look = [&](const Roughness& r) { found |= r.masking == Masking::correlated; };
        if constexpr (requires { m.roughness.masking; }) look(m.roughness);
        if constexpr (requires { m.conductor_roughness; }) look(m.conductor_roughness);
        if constexpr (requires { m.interface_roughness; }) look(m.interface_roughness);
        return found;
      },
      material.model);
}

}  // namespace

std::filesystem::path domain_path(const std::filesystem::path& bundle, std::uint32_t domain) {
  return bundle / "domains" / fmt::format("{:06}.dom", domain);
}

std::filesystem::path pack_path(const std::filesystem::path& bundle, std::uint32_t pack) {
  return bundle / "domains" / fmt::format("pack-{:04}", pack);
}

Stored stored_domain(const Manifest& m, const std::filesystem::path& bundle, std::uint32_t domain) {
  const DomainInfo& d = m.domains.at(domain);
  if (!d.pack) return {domain_path(bundle, domain)};
  return {pack_path(bundle, d.pack->pack), d.pack->offset, d.bytes};
}

std::filesystem::path object_path(const std::filesystem::path& bundle, std::uint32_t object) {
  return bundle / "objects" / fmt::format("{:06}.dom", object);
}

namespace {

// That end in 0, or have colours that shine.
bool has_newer_grids(const Medium& medium) {
  const auto ends_in_0 = [](const auto& volume) {
    const auto* grid = std::get_if<Grid>(&volume);
    return grid && grid->edge == GridEdge::zero;
  };
  const auto* sum = std::get_if<AbsorptionScattering>(&medium.coefficients);
  const auto* product = std::get_if<ExtinctionAlbedo>(&medium.coefficients);
  return ends_in_0(medium.density) || (sum && (ends_in_0(sum->sigma_a) || ends_in_0(sum->sigma_s))) ||
         (product && (ends_in_0(product->sigma_t) || ends_in_0(product->albedo))) ||
         (medium.emission_scale &&
          (medium.emission_scale->edge == GridEdge::zero || medium.emission_scale->channels > 1)) ||
         (medium.temperature && ends_in_0(VolumeParameter{*medium.temperature}));
}

}  // namespace

Features features_of(const Manifest& m) {
  Features f;
  const auto require = [&](bool needed, std::uint32_t bit) { f.required |= needed ? bit : 0; };
  require(m.requirements.shading_normals, required_feature::normals);
  require(m.requirements.uv, required_feature::uvs);
  require(m.attributes > 0, required_feature::attributes);
  require(!m.objects.empty(), required_feature::instances);
  require(!m.texture_files.empty(), required_feature::textures);
  require(std::ranges::any_of(m.texture_files, [](const TextureFileEntry& t) { return t.read_bytes > 0; }),
          required_feature::codes);
  require(std::ranges::any_of(m.objects, [](const ObjectInfo& o) { return o.quadric.has_value(); }),
          required_feature::quadrics);
  require(std::ranges::any_of(m.objects,
                              [](const ObjectInfo& o) { return o.quadric && is_curve(o.quadric->quadric); }),
          required_feature::curves);
  require(std::ranges::any_of(m.textures,
                              [](const Texture& t) {
                                return std::holds_alternative<NoiseTexture>(t.model) ||
                                       std::holds_alternative<DotsTexture>(t.model);
                              }),
          required_feature::procedural);
  require(std::ranges::any_of(m.textures,
                              [](const Texture& t) {
                                const auto* image = std::get_if<ImageTexture>(&t.model);
                                return image && std::holds_alternative<AttributeMapping>(image->mapping);
                              }),
          required_feature::faces);
  require(std::ranges::any_of(m.textures,
                              [](const Texture& t) {
                                const auto* image = std::get_if<ImageTexture>(&t.model);
                                return image && std::holds_alternative<GlobeMapping>(image->mapping);
                              }),
          required_feature::globes);
  require(std::ranges::any_of(
              m.textures, [](const Texture& t) { return std::holds_alternative<PatternTexture>(t.model); }),
          required_feature::patterns);
  require(std::ranges::any_of(m.textures,
                              [](const Texture& t) {
                                const auto* pattern = std::get_if<PatternTexture>(&t.model);
                                return pattern && pattern->kind == PatternTexture::Kind::formula;
                              }),
          required_feature::formulas);
  require(std::ranges::any_of(m.lights,
                              [](const Light& light) {
                                return std::visit([](const auto& l) { return records::fades(l); },
                                                  light.model);
                              }),
          required_feature::fadings);
  require(std::ranges::any_of(m.area_lights, [](const AreaLight& light) { return !light.sampled; }),
          required_feature::glows);
  require(m.requirements.motion, required_feature::motion);
  require(!m.tables.empty(), required_feature::tables);
  require(std::ranges::any_of(
              m.materials, [](const Material& a) { return std::holds_alternative<SlabMaterial>(a.model); }),
          required_feature::slabs);
  require(std::ranges::any_of(
              m.materials, [](const Material& of) { return std::holds_alternative<HairMaterial>(of.model); }),
          required_feature::hair);
  require(std::ranges::any_of(m.materials, has_correlated_masking), required_feature::masking);
  require(has_vertex_doubts(m), required_feature::decimals);
  require(std::ranges::any_of(m.media, has_newer_grids), required_feature::media_grids);
  require(m.settings.hides_emitters, required_feature::hidden_emitters);
  require(std::ranges::any_of(
              m.materials, [](const Material& a) { return std::holds_alternative<FinishMaterial>(a.model); }),
          required_feature::finishes);
  require(std::ranges::any_of(
              m.materials, [](const Material& a) { return std::holds_alternative<GlazedMaterial>(a.model); }),
          required_feature::glazes);
  require(std::ranges::any_of(m.media, &Medium::veils), required_feature::veils);
  require(std::ranges::any_of(m.media, [](const Medium& medium) { return medium.temperature.has_value(); }),
          required_feature::temperatures);
  require(std::ranges::any_of(m.lights,
                              [](const Light& light) {
                                const auto* sky = std::get_if<SkyLight>(&light.model);
                                return sky && (sky->distribution->has_value() || sky->ground != 0 ||
                                               sky->color_temperature_k != 0);
                              }),
          required_feature::skies);
  require(has_shadowless_materials(m) || !std::ranges::all_of(m.lights, &Light::casts_shadows),
          required_feature::shadowless);
  require(m.film.working_gamma != 1, required_feature::working_gamma);
  require(std::ranges::any_of(m.domains, [](const DomainInfo& d) { return d.pack.has_value(); }),
          required_feature::packs);
  require(clip_of(m.camera) != ClipRange{}, required_feature::clips);
  if (m.cut_triangles > 0) f.optional |= optional_feature::pieces;
  return f;
}

bool has_vertex_doubts(const Manifest& m) {
  return std::ranges::any_of(m.surfaces, [](const Surface& s) { return s.vertex_doubt > 0; });
}

bool has_shadowless_materials(const Manifest& m) {
  return !std::ranges::all_of(m.materials, &Material::casts_shadow);
}

std::span<const Surface> scene_surfaces(const Manifest& m) {
  return std::span(m.surfaces).first(m.objects.empty() ? m.surfaces.size() : m.objects[0].first_surface);
}

std::span<const Surface> surfaces_of(const Manifest& m, const ObjectInfo& object) {
  return std::span(m.surfaces).subspan(object.first_surface, object.surface_count);
}

std::uint64_t bytes_needed(const Manifest& manifest, std::uint32_t domain) {
  std::uint64_t bytes = bytes_loaded(manifest, domain);
  for (const std::uint32_t object : manifest.domains[domain].objects) bytes += manifest.objects[object].bytes;
  return bytes;
}

void check_records_file(const std::filesystem::path& file) {
  const auto kind = std::ranges::find(records_file_names, file.filename());
  read_records(file, records_files.at(static_cast<std::size_t>(kind - records_file_names.begin())).magic, "");
}

Manifest read_domains(const std::filesystem::path& bundle) {
  const std::filesystem::path file = bundle / records_file_names.back();
  Manifest m;
  decode_domains(read_records(file, records_files.back().magic, ""), file, m);
  return m;
}

std::uint64_t checksum_of_records(const std::filesystem::path& file) {
  RecordsHeader header{};
  std::ifstream in(file, std::ios::binary);
  if (!in.read(reinterpret_cast<char*>(&header), sizeof header))
    throw Error("damaged file: its header is cut short", {file.string()});
  return header.payload_checksum;
}

void write_manifest(const std::filesystem::path& bundle, const Manifest& manifest) {
  const std::filesystem::path file = bundle / "manifest.json";
  check_manifest(manifest, file);
  const Features features = features_of(manifest);
  Json json{{"format", "vitrail bundle"}, {"version", manifest_version}};
  json["features"] = {{"required", required_names(features.required)},
                      {"optional", optional_names(features.optional)}};
  for (std::size_t i = 0; i < records_files.size(); ++i)
    json[records_files[i].checksum] =
        fmt::format("{:016x}", write_records(bundle / records_file_names[i], records_files[i], manifest));
  json.update(manifest_to_json(manifest));
  if (Json names = names_to_json(manifest); !names.empty()) json["names"] = std::move(names);
  write_checked_json(file, json);
}

Manifest read_manifest(const std::filesystem::path& bundle) {
  const std::filesystem::path file = bundle / "manifest.json";
  if (!std::filesystem::exists(file)) throw Error("not a bundle: it has no manifest.json", {bundle.string()});
  try {
    const Json json = read_checked_json(file, "the manifest");
    check_version(json, file);
    Manifest manifest = manifest_from_json(json);
    for (std::size_t i = 0; i < records_files.size(); ++i) {
      const std::filesystem::path records = bundle / records_file_names[i];
      const RecordsFile& kind = records_files[i];
      kind.decode(read_records(records, kind.magic, json.at(kind.checksum)), records, manifest);
    }
    if (json.contains("names")) take_names(json.at("names"), manifest);
    check_manifest(manifest, file);
    return manifest;
  } catch (const Json::exception& e) {
    throw Error(fmt::format("the manifest is not as it should be: {}", e.what()), {file.string()});
  } catch (const Error& e) {
    if (!e.location.file.empty()) throw;
    throw Error(e.what(), {file.string()});
  }
}

}  // namespace vitrail
