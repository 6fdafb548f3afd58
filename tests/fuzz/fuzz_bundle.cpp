// SPDX-License-Identifier: Apache-2.0
// A bundle whose checksums are put right: read, made ready and rendered, as far as a reader takes it.
#include <fmt/format.h>

#include "bundle/binary_records.h"
#include "bundle/checked_json.h"
#include "bundle/loaded_domain.h"
#include "tests/bundle/sample_bundle.h"
#include "tests/fuzz/bundle_parts.h"
#include "tests/fuzz/fuzz_reader.h"
#include "tests/fuzz/repair.h"
#include "tracer/prepared/film_exponent.h"
#include "tracer/transport/waves/tracer.h"

namespace {

using namespace vitrail;
using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

struct Sample {
  fs::path bundle;
  Manifest manifest;
};

const Sample& sample() {
  static const Sample written = [] {
    test::SampleBundle whole = test::whole_bundle();
    const fs::path bundle = fuzz::folder() / "sample.vit";
    test::write(whole, bundle);
    return Sample{bundle, whole.manifest};
  }();
  return written;
}

void write_bytes(const char* name, const std::vector<std::byte>& bytes) {
  fuzz::write(name, reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

// Returns the checksum that the manifest is to have.
std::uint64_t write_records(const char* name, const char* magic, const std::string& payload) {
  const std::uint64_t sum = checksum(std::as_bytes(std::span(payload)));
  std::string file(magic, 8);
  for (const std::uint64_t word : {std::uint64_t{1}, std::uint64_t{payload.size()}, sum})
    file.append(reinterpret_cast<const char*>(&word), sizeof word);
  fuzz::write(name, file + payload);
  return sum;
}

std::vector<std::byte> bytes_of(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

std::string hexadecimal(std::uint64_t number) { return fmt::format("{:016x}", number); }

// The records of domains with what the files beside them really have.
std::string repaired(const std::string& payload, const std::vector<std::byte>& domain, std::uint64_t hash) {
  Manifest m;
  decode_domains(bytes_of(payload), "domains.bin", m);
  const Manifest& whole = sample().manifest;
  for (std::size_t i = 0; i < std::min(m.domains.size(), whole.domains.size()); ++i)
    m.domains[i].bytes = whole.domains[i].bytes, m.domains[i].hash = whole.domains[i].hash;
  if (!m.domains.empty()) m.domains[0].bytes = domain.size(), m.domains[0].hash = hash;
  for (std::size_t i = 0; i < std::min(m.objects.size(), whole.objects.size()); ++i)
    m.objects[i].bytes = whole.objects[i].bytes, m.objects[i].hash = whole.objects[i].hash;
  std::string text;
  encode_domains(m, [&](std::span<const std::byte> bytes) {
    text.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  });
  return text;
}

// Throws what the JSON library does where the manifest is not as it should be, Error where records are not.
void write_bundle(const fuzz::BundleParts& parts) {
  Json json = Json::parse(parts[fuzz::manifest]);
  json.erase("checksum");
  json["materials_checksum"] =
      hexadecimal(write_records("sample.vit/materials.bin", "VITRMAT\n", parts[fuzz::materials]));
  json["lights_checksum"] =
      hexadecimal(write_records("sample.vit/lights.bin", "VITRLIT\n", parts[fuzz::lights]));
  std::vector<std::byte> domain = bytes_of(parts[fuzz::domain]), image = bytes_of(parts[fuzz::image]);
  const std::uint64_t domain_hash = fuzz::repair_domain(domain), image_hash = fuzz::repair_texture(image);
  json["domains_checksum"] = hexadecimal(write_records("sample.vit/domains.bin", "VITRDOS\n",
                                                       repaired(parts[fuzz::domains], domain, domain_hash)));
  if (Json& images = json.at("texture_files"); !images.empty() && images[0].is_object())
    images[0]["bytes"] = image.size(), images[0]["hash"] = hexadecimal(image_hash);
  write_bytes("sample.vit/domains/000000.dom", domain);
  write_bytes("sample.vit/textures/000000.tex", image);
  write_checked_json(sample().bundle / "manifest.json", json);
}

constexpr int most_depth = 6, most_pixels = 1 << 12, seen = 5;

void render(Manifest m) {
  const PixelRect crop = m.film.crop;
  const auto size = std::int64_t{crop.x1 - crop.x0} * (crop.y1 - crop.y0);
  if (size > most_pixels || m.domains.size() > 3) return;
  m.settings.max_depth = std::min(m.settings.max_depth, most_depth);
  RenderScene scene(std::move(m), sample().bundle, 1 << 20, 1);
  const Manifest& made = scene.manifest;
  std::vector<std::unique_ptr<const LoadedDomain>> domains;
  std::vector<const DomainView*> views;
  for (std::uint32_t i = 0; i < made.domains.size(); ++i) {
    domains.push_back(load_domain(made, sample().bundle, i));
    views.push_back(&domains.back()->view());
  }
  Film film(made.film, {}, film_exponent(scene),
            made.film.layers.any() ? length_exponent(scene) : default_exponent);
  Outbox outbox;
  TraceCounters counters;
  Wave wave;
  Tracer tracer({.scene = scene, .resident = views, .film = film, .outbox = outbox, .counters = counters},
                wave);
  for (int y = 0; y < seen; ++y)
    for (int x = 0; x < seen; ++x)
      tracer.trace_camera(crop.x0 + x * (film.width() - 1) / (seen - 1),
                          crop.y0 + y * (film.height() - 1) / (seen - 1), 0);
  tracer.finish();
  fuzz::require(counters.born == counters.died);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::BundleParts parts = fuzz::unpack({reinterpret_cast<const char*>(data), size});
  static_cast<void>(sample());
  try {
    write_bundle(parts);
  } catch (const nlohmann::json::exception&) {
    return 0;
  } catch (const Error&) {
    return 0;
  }
  return fuzz::run([&] { render(read_manifest(sample().bundle)); });
}
