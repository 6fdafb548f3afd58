// SPDX-License-Identifier: Apache-2.0
#include "cli/render/sample_arguments.h"

#include <charconv>

#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

constexpr double greatest_radius = 64;  // pixels

// Of the same shape, but as wide; sinc's window ends there.
template <class F>
F widened(F filter, std::optional<double> radius) {
  if (!radius) return filter;
  if constexpr (std::is_same_v<F, GaussianFilter>) filter.sigma *= *radius / filter.radius_x;
  if constexpr (std::is_same_v<F, SincFilter>) filter.tau = *radius;
  filter.radius_x = filter.radius_y = *radius;
  return filter;
}

Filter parse_filter(const std::string& text) {
  const auto refuse = [&](const std::string& why) { return UsageError("--filter " + text + ": " + why); };
  const std::size_t colon = text.find(':');
  const std::string name = text.substr(0, colon);
  std::optional<double> radius;
  if (colon != std::string::npos) {
    double value = 0;
    const char *first = text.data() + colon + 1, *last = text.data() + text.size();
    const auto [end, failed] = std::from_chars(first, last, value);
    if (failed != std::errc() || end != last || !(value > 0 && value <= greatest_radius))
      throw refuse("the radius is a number of pixels above 0 and up to 64, as in box:0.5");
    radius = value;
  }
  if (name == "box") return widened(BoxFilter{}, radius);
  if (name == "triangle" || name == "tent") return widened(TriangleFilter{}, radius);
  if (name == "gaussian") return widened(GaussianFilter{}, radius);
  if (name == "mitchell") return widened(MitchellFilter{}, radius);
  if (name == "sinc" || name == "lanczos") return widened(SincFilter{}, radius);
  throw refuse("there are box, triangle, gaussian, mitchell and sinc, each with :RADIUS if wanted");
}

}  // namespace

void declare_sample_options(CLI::App& app, SampleArguments& a) {
  app.add_option("--filter", a.filter,
                 "pixel filter, NAME or NAME:RADIUS in pixels: box, triangle, gaussian, mitchell or sinc; "
                 "default: the scene's");
  app.add_flag("--splat", a.splat,
               "each sample adds to all pixels that the filter reaches, not only to one: less noise, but the "
               "noise of neighbours is alike. At the border of a crop, samples from outside are missing");
  app.add_flag("--one-sequence", a.one_sequence,
               "the samples of a pixel are spread out together instead of in two groups: less noise, but the "
               "film does not know its error");
  app.add_option("--texture-filter", a.texture_filter,
                 "none: distant textures are not blurred; nearest: not blurred, and texels are squares; "
                 "default: the scene's for each texture")
      ->check(CLI::IsMember({"none", "nearest"}));
  app.add_option(
         "--roulette", a.roulette,
         "when Russian roulette may end a path, after the first surface that is no mirror or clear glass: "
         "once it carries less than a camera ray (early), less than a quarter of that (default), or after "
         "254 events (never). Early is quicker and noisier, never is slower; the mean is the same")
      ->transform([](const std::string& word) { return word == "usual" ? "default" : word; })  // its old name
      ->check(CLI::IsMember({"early", "default", "never"}))
      ->capture_default_str();
  app.add_option("--wavelengths", a.wavelengths,
                 "wavelengths of a path: 4, or 1, which has more colour noise")
      ->check(CLI::IsMember({1, 4}))
      ->capture_default_str();
  app.add_option("--light-sampling", a.light_sampling,
                 "choose lamps by the light that each can send to a point (tree), or by their power (power), "
                 "which is quicker for few lamps")
      ->check(CLI::IsMember({"tree", "power"}))
      ->capture_default_str();
  app.add_option(
         "--light-candidates", a.light_candidates,
         "RIS candidates: points on lamps that are compared before a shadow ray is traced, where the "
         "camera sees a surface that is near a large lamp, or glossy. Scenes with a sky, an environment "
         "map or a distant light always take one")
      ->check(CLI::Range(1u, most_light_candidates))
      ->capture_default_str();
}

SampleChoices sample_choices(const SampleArguments& a) {
  SampleChoices choices;
  if (!a.filter.empty()) choices.filter = parse_filter(a.filter);
  if (!a.texture_filter.empty())
    choices.textures = a.texture_filter == "nearest" ? TextureChoice::nearest : TextureChoice::unfiltered;
  choices.sampling.splat = a.splat;
  choices.sampling.one_sequence = a.one_sequence;
  SamplingChoices& s = choices.sampling;
  s.roulette = a.roulette == "early"   ? Roulette::early
               : a.roulette == "never" ? Roulette::never
                                       : Roulette::usual;
  s.one_wavelength = a.wavelengths == 1;
  s.lights = a.light_sampling == "power" ? LightChoice::power : LightChoice::tree;
  s.light_candidates = a.light_candidates;
  return choices;
}

}  // namespace vitrail
