// SPDX-License-Identifier: Apache-2.0
#include "film/picture_fields.h"

#include <fmt/format.h>

namespace vitrail {

namespace {

std::string words(const PixelRect& r) { return fmt::format("{},{},{},{}", r.x0, r.x1, r.y0, r.y1); }
std::string words(const SpectralBins& bins) {
  return fmt::format("{} over {}..{} nm", bins.count, bins.min_nm, bins.max_nm);
}
std::string words(const PhotonKey& p) {
  if (p.photons == 0) return "none";
  return fmt::format("{} from radius {} on with α {}", p.photons, p.first_radius, p.alpha);
}
std::string words(const RendererVersion& renderer) { return to_string(renderer); }
std::string words(const FilmLayers& layers) { return layers.any() ? names_of(layers) : "none"; }
std::string words(const LightGroups& groups) {
  if (!groups.any()) return "none";
  return fmt::format("{} (lights {:016x})", fmt::join(groups.names, ","), groups.lights);
}
std::string words(bool with) { return with ? "yes" : "no"; }
std::string words(const auto& number) { return fmt::format("{}", number); }

}  // namespace

std::string words_of_depth(int depth) {
  return depth >= no_limit_of_depth ? "no limit" : fmt::format("{}", depth);
}

std::vector<PictureField> picture_fields(const FilmKey& key, const FilmSettings& film) {
  constexpr bool hidden = false;
  return {
      {"bundle, state of its glass (--set) or way to sample",
       "they differ in the scene, the state of its glass or the way to sample",
       fmt::format("{:016x}", key.scene_hash), hidden},
      {"build", "they were made by different programs", words(key.renderer)},
      {"width", "their widths differ", words(film.width)},
      {"height", "their heights differ", words(film.height)},
      {"crop", "their crops differ", words(film.crop)},
      {"depth", "their depths differ", words_of_depth(key.max_depth)},
      {"integrator", "one has direct light only", key.direct_only ? "direct" : "path", hidden},
      {"threshold", "their thresholds differ", words(key.threshold)},
      {"way to count surfaces that light passes straight through",
       "one counts going straight through a sheet as scattering, the other does not",
       key.straight_counts ? "as scattering" : "not at all", hidden},
      {"--splat", "samples of one add to several pixels, those of the other to their own", words(key.splats),
       hidden},
      {"--one-sequence", "samples of one are one sequence a pixel, those of the other two",
       words(key.one_sequence), hidden},
      {"--hide-emitters", "one shows lamps to the camera, the other hides them", words(key.hides_emitters),
       hidden},
      {"light groups", "their light groups differ", words(key.groups)},
      {"number, radius or alpha of photons", "their photons differ", words(key.photons)},
      {"clamp", "their clamps differ", words(key.clamp)},
      {"spectral bins", "their spectral bins differ", words(film.spectrum)},
      {"imaging ratio", "their imaging ratios differ", words(film.imaging_ratio)},
      {"working gamma", "colours of one are added up in another space of a screen than those of the other",
       words(film.working_gamma), hidden},
      {"layers", "they keep different layers of the first surfaces", words(film.layers)},
      {"space of positions and normals",
       "one has positions and normals in camera space, the other in the world's",
       film.layers.in_camera_space ? "camera" : "world", hidden}};
}

std::string difference(const SumsOf& a, const SumsOf& b) {
  const auto differ = [](const char* what, const auto& x, const auto& y) {
    return fmt::format("{}: {} and {}", what, x, y);
  };
  const std::vector<PictureField> mine = picture_fields(a.key, a.settings),
                                  theirs = picture_fields(b.key, b.settings);
  for (std::size_t i = 0; i < mine.size(); ++i)
    if (mine[i].value != theirs[i].value)
      return mine[i].is_shown ? differ(mine[i].difference, mine[i].value, theirs[i].value)
                              : mine[i].difference;
  if (a.exponent != b.exponent)
    return differ("their sums count in different powers of two", a.exponent, b.exponent);
  if (a.length_exponent != b.length_exponent)
    return differ("their lengths count in different powers of two", a.length_exponent, b.length_exponent);
  return {};
}

}  // namespace vitrail
