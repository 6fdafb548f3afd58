// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/read/camera_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "importers/pbrt/read/gbuffer.h"
#include "importers/reading/suggestion.h"

namespace vitrail::pbrt {

namespace {

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::optional<std::array<double, 4>> four(ParameterSet& parameters, std::string_view name) {
  const Parameter* parameter = parameters.find_numbers(name);
  if (!parameter) return std::nullopt;
  const std::vector<double>& v = parameter->numbers;
  if (v.size() != 4)
    fail(fmt::format("parameter \"{}\" needs 4 values, has {}", name, v.size()), parameter->place);
  return std::array<double, 4>{v[0], v[1], v[2], v[3]};
}

double positive(ParameterSet& parameters, std::string_view name, double otherwise) {
  const double value = parameters.number(name, otherwise);
  if (!(value > 0)) fail(fmt::format("\"{}\" is {}, but has to be above 0", name, value), parameters.place());
  return value;
}

int resolution(ParameterSet& parameters, std::string_view name, int otherwise) {
  constexpr int most = 1 << 20;
  const int pixels = parameters.integer(name, otherwise);
  if (pixels < 1 || pixels > most)
    fail(fmt::format("\"{}\" is {}, which is not between 1 and {}", name, pixels, most), parameters.place());
  return pixels;
}

// pbrt's rounding: a pixel is inside if its upper edge is past the lower bound.
int cropped(double fraction, int pixels) {
  return static_cast<int>(std::ceil(std::clamp(fraction, 0.0, 1.0) * pixels));
}

void read_crop(ParameterSet& parameters, FilmSettings& film) {
  film.crop = {0, film.width, 0, film.height};
  const auto bounds = four(parameters, "pixelbounds"), window = four(parameters, "cropwindow");
  if (bounds) {
    const auto clamped = [](double value, int most) {
      return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(most)));
    };
    film.crop = {clamped((*bounds)[0], film.width), clamped((*bounds)[1], film.width),
                 clamped((*bounds)[2], film.height), clamped((*bounds)[3], film.height)};
  }
  if (window) {
    const auto [x0, x1] = std::minmax((*window)[0], (*window)[1]);
    const auto [y0, y1] = std::minmax((*window)[2], (*window)[3]);
    film.crop = {cropped(x0, film.width), cropped(x1, film.width), cropped(y0, film.height),
                 cropped(y1, film.height)};
  }
  if (film.crop.x0 >= film.crop.x1 || film.crop.y0 >= film.crop.y1)
    fail("the crop of the film leaves no pixels", parameters.place());
}

void read_bins(ParameterSet& parameters, FilmSettings& film) {
  const SpectralBins visible{16};
  film.spectrum = {parameters.integer("nbuckets", visible.count),
                   parameters.number("lambdamin", visible.min_nm),
                   parameters.number("lambdamax", visible.max_nm)};
  if (film.spectrum.count < 1 || film.spectrum.count > max_spectral_bins)
    fail(fmt::format("\"nbuckets\" is {}, which is not between 1 and {}", film.spectrum.count,
                     max_spectral_bins),
         parameters.place());
  if (!(film.spectrum.min_nm < film.spectrum.max_nm))
    fail("\"lambdamin\" is not below \"lambdamax\"", parameters.place());
}

void read_layers(ParameterSet& parameters, Context& context, FilmLayers& layers) {
  layers = gbuffer_layers();
  const std::string space = parameters.text("coordinatesystem", "camera");
  if (!is_one_of(space, {"camera", "world"}))
    fail(fmt::format("expected the coordinate system camera or world, found \"{}\"", space),
         parameters.place());
  layers.in_camera_space = space == "camera";
  context.report.approximated(
      "film \"gbuffer\": all its channels are means over all samples, of which those that see nothing are 0; "
      "dzdx, dzdy and the variances are not kept",
      parameters.place());
}

// A film holds what was seen. The matrix of a named sensor takes its curves to what the CIE observer sees
// under the light that it is balanced for, as that would look under D65.
void read_sensor(ParameterSet& parameters, Context& context) {
  const std::string sensor = parameters.text("sensor", "cie1931");
  double kelvin = parameters.number("whitebalance", 0);
  if (!(kelvin >= 0)) fail("\"whitebalance\" is negative", parameters.place());
  if (sensor != "cie1931") {
    context.report.approximated(
        fmt::format("sensor \"{}\" becomes the CIE 1931 observer: its measured curves are not here", sensor),
        parameters.place());
    if (kelvin == 0) kelvin = 6500;
  }
  if (kelvin > 0 && kelvin != 6500)  // D65's name: no change
    context.report.dropped(
        fmt::format("the film's white balance: it is done by develop --white-balance {}", kelvin),
        parameters.place());
}

// v4's is of the greatest of the sensor's three values, v3's of the luminance before the film's scale.
void read_limits(ParameterSet& parameters, Context& context, double scale) {
  for (const auto& [name, factor] : {std::pair{"maxcomponentvalue", 1.0}, {"maxsampleluminance", scale}}) {
    const double most = parameters.number(name, 0) * factor;
    if (most > 0 && std::isfinite(most))
      context.report.dropped(
          fmt::format(
              "\"{}\": bright samples are not clamped; render --clamp {} cuts what each connection of a "
              "path adds",
              name, most),
          parameters.place());
  }
}

// v3's shutter only blurs; v4's exposes, and one that never opens is refused there.
double exposure_time(const Shutter& shutter, ParameterSet& parameters, Context& context) {
  const double seconds = shutter.close_s - shutter.open_s;
  if (context.version == Version::v3) return 1;
  if (seconds > 0) return seconds;
  const char* const what =
      seconds < 0 ? "the shutter closes before it has opened" : "the shutter closes as it opens";
  if (context.version_is_certain) fail(what, parameters.place());
  context.report.approximated(fmt::format("{}, which pbrt-v4 refuses: it does not expose, as in v3", what),
                              parameters.place());
  return 1;
}

LensSystem read_lens_system(ParameterSet& parameters, Context& context) {
  const std::string name = parameters.text("lensfile", "");
  const double aperture_mm = parameters.number("aperturediameter", 1);
  if (name.empty())
    fail("camera \"realistic\" has no \"lensfile\": name one, or use camera \"perspective\"",
         parameters.place());
  const std::filesystem::path file = context.resolve(name);
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    fail(fmt::format("camera \"realistic\": there is no lens file \"{}\"", name), parameters.place());
  LensSystem system{read_lens(file, aperture_mm), positive(parameters, "focusdistance", 10)};
  system.by_area = context.version == Version::v4 || !parameters.boolean("simpleweighting", true);
  system.place = parameters.place();
  if (parameters.find("aperture", {ParameterType::text}))
    context.report.approximated("camera \"realistic\": its aperture is round", parameters.place());
  return system;
}

}  // namespace

ViewSettings default_view(Version version) {
  ViewSettings view;
  if (version == Version::v3) {
    view.film.width = 640;
    view.film.height = 480;
    view.film.filter = BoxFilter{};
  }
  view.film.crop = {0, view.film.width, 0, view.film.height};
  return view;
}

void read_camera(const std::string& kind, ParameterSet& parameters, const Transform& ctm, Context& context,
                 ViewSettings& view) {
  view.has_camera = true;
  view.lens_system.reset();
  view.camera_to_world = snapped(inverse(ctm));
  using Projection = ViewSettings::Projection;
  view.projection = Projection::perspective;
  if (kind == "orthographic") view.projection = Projection::orthographic;
  if (is_one_of(kind, {"spherical", "environment"})) {
    view.projection = Projection::spherical;
    const bool v3 = context.version == Version::v3;
    const std::string mapping = parameters.text("mapping", v3 ? "equirectangular" : "equalarea");
    if (!is_one_of(mapping, {"equalarea", "equirectangular"}))
      fail(fmt::format("expected the mapping equalarea or equirectangular, found \"{}\"", mapping),
           parameters.place());
    view.sphere = mapping == "equalarea" ? SphericalCamera::Projection::equal_area
                                         : SphericalCamera::Projection::latitude_longitude;
  } else if (kind == "realistic") {
    view.lens_system = read_lens_system(parameters, context);
  } else if (!is_one_of(kind, {"perspective", "orthographic"})) {
    context.report.dropped(
        fmt::format("camera \"{}\" is not supported: a perspective camera at its place stands for it", kind),
        parameters.place());
  }
  view.fov_deg = parameters.number("fov", 90);
  const double half = parameters.number("halffov", -1);
  if (half > 0) view.fov_deg = 2 * half;
  if (!(view.fov_deg > 0 && view.fov_deg < 180))
    fail(fmt::format("the field of view is {} degrees, which is not between 0 and 180", view.fov_deg),
         parameters.place());
  if (parameters.find_numbers("frameaspectratio"))
    view.frame_aspect = positive(parameters, "frameaspectratio", 1);
  if (const auto w = four(parameters, "screenwindow")) {
    view.window = ScreenWindow{(*w)[0], (*w)[1], (*w)[2], (*w)[3]};
    if ((*w)[0] == (*w)[1] || (*w)[2] == (*w)[3]) fail("the screen window is empty", parameters.place());
  }
  view.lens.radius = parameters.number("lensradius", 0);
  view.lens.focal_distance = parameters.number("focaldistance", 1e6);
  if (!(view.lens.radius >= 0 && view.lens.focal_distance > 0))
    fail("\"lensradius\" is negative or \"focaldistance\" not above 0", parameters.place());
  view.shutter = {parameters.number("shutteropen", 0), parameters.number("shutterclose", 1)};
  view.exposure_s = exposure_time(view.shutter, parameters, context);
  if (view.shutter.close_s < view.shutter.open_s) std::swap(view.shutter.open_s, view.shutter.close_s);
  parameters.report_unused(context.report);
}

void read_film(const std::string& kind, ParameterSet& parameters, Context& context, ViewSettings& view) {
  const FilmSettings defaults = default_view(context.version).film;
  if (!is_one_of(kind, {"rgb", "image", "gbuffer", "spectral"}))
    context.report.approximated(fmt::format("film \"{}\" is not known and read as \"rgb\"", kind),
                                parameters.place());
  view.film.spectrum = {};
  view.film.layers = {};
  if (kind == "spectral") read_bins(parameters, view.film);
  if (kind == "gbuffer") read_layers(parameters, context, view.film.layers);
  view.film.width = resolution(parameters, "xresolution", defaults.width);
  view.film.height = resolution(parameters, "yresolution", defaults.height);
  read_crop(parameters, view.film);
  view.exposure = parameters.number("iso", 100) / 100 * parameters.number("scale", 1);
  view.exposure *= parameters.number("exposuretime", 1);
  read_sensor(parameters, context);
  read_limits(parameters, context, view.exposure);
  view.film_diagonal_mm = positive(parameters, "diagonal", 35);
  parameters.ignore({"filename", "savefp16", "coordinatesystem"});
  parameters.report_unused(context.report);
}

void read_filter(const std::string& kind, ParameterSet& parameters, Context& context, ViewSettings& view) {
  const auto radius = [&](char axis, double otherwise) {
    const std::string name{axis};
    return positive(parameters, name + "radius", positive(parameters, name + "width", otherwise));
  };
  const bool v3 = context.version == Version::v3;
  if (kind == "box") {
    view.film.filter = BoxFilter{radius('x', 0.5), radius('y', 0.5)};
  } else if (kind == "triangle") {
    view.film.filter = TriangleFilter{radius('x', 2), radius('y', 2)};
  } else if (kind == "gaussian") {
    const double size = v3 ? 2 : 1.5;
    GaussianFilter filter{radius('x', size), radius('y', size), parameters.number("sigma", 0.5)};
    if (v3 || parameters.find("alpha", {ParameterType::number}))  // exp(−α r²) = exp(−r²/(2σ²))
      filter.sigma = 1 / std::sqrt(2 * positive(parameters, "alpha", 2));
    if (!(filter.sigma > 0)) fail("the filter's sigma has to be above 0", parameters.place());
    view.film.filter = filter;
  } else if (kind == "mitchell") {
    view.film.filter = MitchellFilter{radius('x', 2), radius('y', 2), parameters.number("B", 1.0 / 3),
                                      parameters.number("C", 1.0 / 3)};
  } else if (kind == "sinc") {
    view.film.filter = SincFilter{radius('x', 4), radius('y', 4), positive(parameters, "tau", 3)};
  } else {
    context.report.approximated(
        fmt::format("filter \"{}\" is not known and becomes a Gaussian of sigma 0.5{}", kind,
                    suggestion(kind, {"box", "triangle", "gaussian", "mitchell", "sinc"})),
        parameters.place());
    view.film.filter = GaussianFilter{};
  }
  parameters.report_unused(context.report);
}

void read_sampler(const std::string&, ParameterSet& parameters, Context& context, ViewSettings& view) {
  const int x = parameters.integer("xsamples", 0), y = parameters.integer("ysamples", 0);
  const int samples = parameters.integer("pixelsamples", 16);
  const double count = x > 0 || y > 0 ? static_cast<double>(x > 0 ? x : 4) * (y > 0 ? y : 4) : samples;
  if (count < 1 || count > 1 << 30)
    fail(fmt::format("{} samples a pixel cannot be taken", count), parameters.place());
  view.render.samples_per_pixel = static_cast<int>(count);
  parameters.ignore({"seed", "randomization", "jitter", "dimensions"});
  parameters.report_unused(context.report);
}

namespace {

// tan 45° is 1, so that a screen window can be given as it is.
double tan_half(double fov_deg) { return fov_deg == 90 ? 1 : std::tan(fov_deg / 2 * std::numbers::pi / 180); }

ScreenWindow screen_of(const ViewSettings& view) {
  ScreenWindow screen;
  const double aspect =
      view.frame_aspect > 0 ? view.frame_aspect : static_cast<double>(view.film.width) / view.film.height;
  if (view.window)
    screen = *view.window;
  else if (aspect > 1)
    screen = {-aspect, aspect, -1, 1};
  else
    screen = {-1, 1, -1 / aspect, 1 / aspect};
  const double scale = view.projection == ViewSettings::Projection::orthographic ? 1 : tan_half(view.fov_deg);
  return {screen.x0 * scale, screen.x1 * scale, screen.y0 * scale, screen.y1 * scale};
}

}  // namespace

static Camera realistic_camera(const ViewSettings& view, const Transform& camera_to_world, double& exposure) {
  constexpr double mm = 1e-3;
  const LensSystem& system = *view.lens_system;
  try {
    FocussedLens lens =
        focussed(system.surfaces, system.focus_distance, view.film_diagonal_mm * mm, system.by_area);
    exposure *= lens.middle;
    return RealisticCamera{camera_to_world, view.film_diagonal_mm * mm, std::move(lens.surfaces),
                           std::move(lens.pupils)};
  } catch (const Error& e) {
    fail(e.what(), system.place);
  }
}

void apply(const ViewSettings& view, Scene& scene) {
  double exposure = view.exposure * view.exposure_s;
  const ScreenWindow screen = screen_of(view);
  scene.shutter = view.shutter;
  if (!stands_still(view.motion, scene.shutter)) scene.camera_motion = view.motion;
  const Transform camera_to_world =
      view.motion.moves() ? view.motion.at(view.shutter.open_s) : view.camera_to_world;
  if (view.lens_system)
    scene.camera = realistic_camera(view, camera_to_world, exposure);
  else if (view.projection == ViewSettings::Projection::spherical)
    scene.camera = SphericalCamera{camera_to_world, view.sphere};
  else if (view.projection == ViewSettings::Projection::orthographic)
    scene.camera = OrthographicCamera{camera_to_world, screen, view.lens};
  else
    scene.camera = PerspectiveCamera{camera_to_world, screen, view.lens};
  scene.film = view.film;
  scene.film.imaging_ratio = exposure;
  scene.settings = view.render;
  if (view.iterations) scene.settings.samples_per_pixel = *view.iterations;
}

}  // namespace vitrail::pbrt
