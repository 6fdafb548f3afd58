// SPDX-License-Identifier: Apache-2.0
// vitrail sky: where the sun stands at a place and time, and what sun and sky give there.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/common/main_guard.h"
#include "images/image_files.h"
#include "importers/images/sky_image.h"
#include "importers/reading/given_sky.h"
#include "scene/daylight/photometry.h"
#include "scene/daylight/sky_model.h"
#include "scene/system/output_place.h"
#include "scene/system/say.h"

namespace vitrail {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  std::string sky;
  std::filesystem::path output;
  int height = sky_image_height;
  bool json = false;
};

using Bands = std::array<double, sky_bands>;

Bands sum(Bands a, const Bands& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
  return a;
}

// What a plane gets.
Json measured(const Bands& bands) {
  const TabulatedSpectrum spectrum = spectrum_of_bands(bands);
  const XYZ color = to_xyz(spectrum);
  double watts = 0;  // trapezoids of 1 nm
  for (std::size_t i = 0; i + 1 < spectrum.values.size(); ++i)
    watts += (static_cast<double>(spectrum.values[i]) + static_cast<double>(spectrum.values[i + 1])) / 2;
  Json j{{"illuminance_lx", photometric(color.y)},
         {"melanopic_edi_lx", melanopic_edi(spectrum)},
         {"irradiance_w_m2", watts}};
  const double all = color.x + color.y + color.z;
  if (!(all > 0)) return j;
  j["x"] = color.x / all, j["y"] = color.y / all;
  j["color_temperature_k"] = correlated_color_temperature(color);
  return j;
}

Bands on_wall(const SkyModel& model, Vector3d normal) {
  return sum(model.sun_irradiance(normal), model.sky_irradiance(normal));
}

void print(const char* name, const Json& j) {
  show("{:26} {:10.0f} lx {:10.0f} lx melanopic EDI {:8.1f} W/m² (360 to 830 nm)", name,
       j["illuminance_lx"].get<double>(), j["melanopic_edi_lx"].get<double>(),
       j["irradiance_w_m2"].get<double>());
  if (j.contains("x"))
    show("  x {:.4f} y {:.4f} {:6.0f} K", j["x"].get<double>(), j["y"].get<double>(),
         j["color_temperature_k"].get<double>());
  show("\n");
}

int run(const Arguments& a) {
  const GivenSky sky = parse_sky(a.sky);
  if (!a.output.empty()) {
    if (a.output.extension() != ".exr") throw UsageError("the sky is written as .exr: " + a.output.string());
    require_place(a.output);
  }
  const SkyModel model(sky.light);
  const Bands beam = model.sun_irradiance(model.to_sun()), direct = model.sun_irradiance({0, 0, 1}),
              diffuse = model.sky_irradiance();
  const Json report{{"elevation_deg", sky.sun.elevation_deg},
                    {"azimuth_deg", sky.sun.azimuth_deg},
                    {"direct_normal", measured(beam)},
                    {"direct_horizontal", measured(direct)},
                    {"diffuse_horizontal", measured(diffuse)},
                    {"global_horizontal", measured(sum(direct, diffuse))},
                    {"global_north", measured(on_wall(model, {0, 1, 0}))},
                    {"global_east", measured(on_wall(model, {1, 0, 0}))},
                    {"global_south", measured(on_wall(model, {0, -1, 0}))},
                    {"global_west", measured(on_wall(model, {-1, 0, 0}))}};
  if (a.json) {
    show("{}\n", report.dump(2));
  } else {
    show("sun: {:.2f} degrees above the horizon, {:.2f} degrees from north to east\n", sky.sun.elevation_deg,
         sky.sun.azimuth_deg);
    if (!model.is_day()) show("night: the model has no twilight, nothing shines\n");
    print("sun, across its direction", report["direct_normal"]);
    print("sun, on the ground", report["direct_horizontal"]);
    print("sky, on the ground", report["diffuse_horizontal"]);
    print("both", report["global_horizontal"]);
    for (const char* wall : {"north", "east", "south", "west"})
      print(fmt::format("both, on a wall to the {}", wall).c_str(), report[fmt::format("global_{}", wall)]);
  }
  if (!a.output.empty())
    write_exr_image(a.output,
                    sky_image(sky.light, EnvironmentLight::Projection::latitude_longitude, a.height));
  return exit_done;
}

}  // namespace
}  // namespace vitrail

int main(int argc, char** argv) {
  using namespace vitrail;
  CLI::App app("The sun's position, and the light of the sun and the sky, by place and time.", "vitrail sky");
  Arguments a;
  app.add_option("SKY", a.sky,
                 "LATITUDE,LONGITUDE,TIME[,turbidity=3,ground=0,albedo=0.2,cie=1,direct=640W,diffuse=210W,"
                 "sun=1,sky=1], "
                 "degrees as 33.9S, TIME as 2026-06-21T12:00+02:00; or an hour of a weather file: "
                 "paris.epw@06-21T12:00")
      ->required();
  app.add_option("-o,--output", a.output,
                 "write the sky without the sun as .exr in linear sRGB, by latitude and longitude: the "
                 "zenith at the top, east at the left edge, then north");
  app.add_option("--height", a.height, "height of the picture, in pixels")
      ->check(CLI::Range(2, 1 << 14))
      ->capture_default_str();
  app.add_flag("--json", a.json, "print JSON");
  return run_guarded(app, argc, argv, [&] { return run(a); });
}
