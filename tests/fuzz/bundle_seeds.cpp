// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/bundle_seeds.h"

#include <exception>
#include <utility>

#include "bundle/ray_profile.h"
#include "bundle/texture_file.h"
#include "film/film_progress.h"
#include "tests/bundle/sample_bundle.h"
#include "tests/fuzz/bundle_parts.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test {

namespace {

constexpr const char* image_name = "textures/000000.tex";

// Calls `use` with each kind of a variant, in its first state.
template <class Variant>
void for_each_kind(const auto& use) {
  [&]<std::size_t... i>(std::index_sequence<i...>) { (use(std::variant_alternative_t<i, Variant>{}), ...); }
  (std::make_index_sequence<std::variant_size_v<Variant>>());
}

// One whose camera is in the middle of what it holds.
SampleBundle seen_bundle() {
  SampleBundle b = whole_bundle();
  b.manifest.camera = SphericalCamera{translate({0.1, 0.2, 0.15}), SphericalCamera::Projection::equal_area};
  b.manifest.film = {.width = 16, .height = 16, .crop = {0, 16, 0, 16}};
  b.manifest.settings = {.samples_per_pixel = 4, .max_depth = 5};
  b.manifest.offset = {};
  return b;
}

// All kinds of records, each in a bundle: those that a bundle takes.
void add_bundles(const std::function<void(const std::string&)>& add) {
  const auto add_changed = [&](const auto& change) {
    try {
      SampleBundle b = seen_bundle();
      change(b.manifest);
      const TemporaryDirectory directory;
      write(b, directory.path());
      const auto records = [&](const char* name) {
        return read_text(directory / name).substr(fuzz::records_header_bytes);
      };
      add(fuzz::pack({read_text(directory / "manifest.json"), records("materials.bin"), records("lights.bin"),
                      records("domains.bin"), read_text(domain_path(directory.path(), 0)),
                      read_text(directory / image_name)}));
    } catch (const std::exception&) {
    }
  };
  add_changed([](Manifest&) {});
  add_changed([](Manifest& m) { m.camera_medium = -1; });
  add_changed([](Manifest& m) {
    m.media[1].emission = ConstantSpectrum{1};
    m.media[1].temperature = Grid{"", "", 2, 1, 1, 1, {900, 6000}};
    m.media[1].temperature_scale = 2, m.media[1].temperature_offset = 100;
  });
  for_each_kind<MaterialVariant>([&](const auto& kind) {
    add_changed([&](Manifest& m) {
      m.camera_medium = -1;
      for (Material& material : m.materials) material = {kind};
    });
  });
  for_each_kind<LightVariant>([&](auto kind) {
    if constexpr (requires { kind.filename; }) kind.filename = image_name;
    add_changed([&](Manifest& m) { m.camera_medium = -1, m.lights = {Light{kind, {}}}; });
  });
  for_each_kind<TextureVariant>([&](auto kind) {
    if constexpr (requires { kind.filename; }) kind.filename = image_name;
    add_changed([&](Manifest& m) {
      m.camera_medium = -1;
      m.textures.push_back({kind});
      for (Material& material : m.materials) material = {DiffuseMaterial{Id<Texture>{2}}};
    });
  });
  add_changed([](Manifest& m) {
    using Op = PatternStep::Op;
    PatternTexture formula;
    formula.kind = PatternTexture::Kind::formula;
    formula.patterns.emplace_back();
    formula.fractals.emplace_back();
    formula.steps = {{Op::pick, 0}, {Op::pick, 1}, {Op::fractal, 0}, {Op::constant, 0, 0.5},
                     {Op::pick, 1}, {Op::pick, 2}, {Op::pattern, 0}, {Op::slide, 1},
                     {Op::cos},     {Op::pick, 5}, {Op::add}};
    m.camera_medium = -1;
    m.textures.push_back({formula});
    for (Material& material : m.materials) material = {DiffuseMaterial{Id<Texture>{2}}};
  });
  for_each_kind<Camera>([&](const auto& kind) { add_changed([&](Manifest& m) { m.camera = kind; }); });
  add_changed([](Manifest& m) {
    m.film.layers.bits = all_layers;
    m.film.spectrum = {8, 400, 700};
  });
}

void add_films(const std::function<void(const Film&, const FilmProgress&)>& add) {
  FilmSettings settings;
  settings.width = settings.height = 2;
  settings.crop = {0, 2, 0, 2};
  FilmKey clamped, photons, groups, splats;
  clamped.clamp = 1;
  photons.photons = {1000, 0.5, 0.7};
  groups.groups = {{"lamp", "sun"}, 7};
  splats.splats = true;
  const FilmProgress whole{4, 1, {0xf}, 1.5, {}, "{}", false, {}};
  for (const FilmKey& key : {FilmKey{}, clamped, photons, groups, splats}) add(Film(settings, key), whole);
  FilmProgress begun = whole, adaptive = whole;
  begun.samples_per_pixel = 9, begun.earlier_ends = {2, 5}, begun.done = {5};
  add(Film(settings, {}), begun);
  adaptive.adaptive = true, adaptive.more = {1, 2, 0, 3};
  add(Film(settings, {}), adaptive);
  settings.layers.bits = all_layers;
  settings.spectrum = {4, 400, 700};
  add(Film(settings, {}), whole);
}

}  // namespace

void add_bundle_seeds(const std::function<void(const char*, const std::string&)>& add) {
  const TemporaryDirectory directory;
  write_sample_bundle(directory.path());
  add("manifest", read_text(directory / "manifest.json"));
  add("domain", read_text(domain_path(directory.path(), 0)));
  SampleBundle whole = whole_bundle();
  const TemporaryDirectory with_all;
  write(whole, with_all.path());
  for (std::uint32_t i = 0; i < whole.domains.size(); ++i)
    add("domain", read_text(domain_path(with_all.path(), i)));
  add("manifest", read_text(with_all / "manifest.json"));
  add("texture", read_text(with_all / image_name));
  for (std::uint32_t f = 0; f < texel_format_count; ++f) {
    write_texture_file(directory / "a.tex", {static_cast<TexelFormat>(f), 9, 5, 2},
                       [](std::uint32_t level, std::uint32_t x, std::uint32_t y) {
                         return TexelWords{level, x, y};
                       });
    add("texture", read_text(directory / "a.tex"));
  }
  add_bundles([&](const std::string& bundle) { add("bundle", bundle); });
  const std::vector<std::uint64_t> rays(whole.domains.size(), 10);
  const std::vector<double> seconds(whole.domains.size(), 0.5);
  write_ray_profile(directory / "profile.json", {whole.manifest, rays, seconds, {{0, 1, 5}}, {}});
  add("profile", read_text(directory / "profile.json"));
  add_films([&](const Film& film, const FilmProgress& progress) {
    write_film(directory / "a.film", film, progress);
    add("film", read_text(directory / "a.film"));
  });
}

}  // namespace vitrail::test
