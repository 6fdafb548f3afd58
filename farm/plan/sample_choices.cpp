// SPDX-License-Identifier: Apache-2.0
#include "farm/plan/sample_choices.h"

#include <fmt/format.h>

#include "bundle/checksum.h"

namespace vitrail {

namespace {

// What shapes a filter, besides its kind: radii, then what else it has.
std::string numbers_of(const BoxFilter&) { return {}; }
std::string numbers_of(const TriangleFilter&) { return {}; }
std::string numbers_of(const GaussianFilter& f) { return fmt::format(",sigma={}", f.sigma); }
std::string numbers_of(const MitchellFilter& f) { return fmt::format(",b={},c={}", f.b, f.c); }
std::string numbers_of(const SincFilter& f) { return fmt::format(",tau={}", f.tau); }

std::string words_of(const Filter& filter) {
  constexpr const char* names[] = {"box", "triangle", "gaussian", "mitchell", "sinc"};
  return std::visit(
      [&](const auto& f) {
        const std::string radius = f.radius_x == f.radius_y ? fmt::format("{}", f.radius_x)
                                                            : fmt::format("{}x{}", f.radius_x, f.radius_y);
        return fmt::format("--filter {}:{}{}", names[filter.index()], radius, numbers_of(f));
      },
      filter);
}

TextureFilter chosen(TextureFilter own, TextureChoice choice) {
  if (choice == TextureChoice::nearest || own == TextureFilter::nearest) return TextureFilter::nearest;
  return TextureFilter::bilinear;
}

// Whether an image is looked up in another way than before.
bool put_textures(TextureChoice choice, Manifest& m) {
  bool changed = false;
  for (Texture& texture : m.textures)
    if (auto* image = std::get_if<ImageTexture>(&texture.model)) {
      const TextureFilter filter = chosen(image->filter, choice);
      changed = changed || filter != image->filter;
      image->filter = filter;
    }
  m.requirements.filtering = false;
  return changed;
}

}  // namespace

std::string words_of(const SampleChoices& c) {
  const SamplingChoices usual;
  std::string words;
  const auto add = [&](const std::string& word) { words += (words.empty() ? "" : " ") + word; };
  if (c.filter) add(words_of(*c.filter));
  if (c.sampling.splat) add("--splat");
  if (c.sampling.one_sequence) add("--one-sequence");
  if (c.textures)
    add(fmt::format("--texture-filter {}", *c.textures == TextureChoice::nearest ? "nearest" : "none"));
  if (c.sampling.roulette != usual.roulette)
    add(fmt::format("--roulette {}", c.sampling.roulette == Roulette::early ? "early" : "never"));
  if (c.sampling.one_wavelength) add("--wavelengths 1");
  if (c.sampling.lights != usual.lights) add("--light-sampling power");
  if (c.sampling.light_candidates != usual.light_candidates)
    add(fmt::format("--light-candidates {}", c.sampling.light_candidates));
  return words;
}

void apply(const SampleChoices& choices, Manifest& m) {
  SampleChoices effective{{}, {}, choices.sampling};
  if (choices.filter && *choices.filter != m.film.filter) {
    effective.filter = choices.filter;
    m.film.filter = *choices.filter;
  }
  if (choices.textures && put_textures(*choices.textures, m)) effective.textures = choices.textures;
  const std::string words = words_of(effective);
  if (words.empty()) return;
  Hasher hasher;
  hasher.add(std::as_bytes(std::span(&m.scene_hash, 1)));
  hasher.add(std::as_bytes(std::span(words)));
  m.scene_hash = hasher.digest();
}

}  // namespace vitrail
