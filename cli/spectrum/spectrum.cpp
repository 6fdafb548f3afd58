// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <span>

#include "cli/common/main_guard.h"
#include "cli/common/own_output.h"
#include "cli/spectrum/spectrum_methods.h"
#include "scene/system/atomic_file.h"
#include "scene/system/say.h"

namespace vitrail {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  std::vector<double> rgb;
  int cube = 33;
  std::filesystem::path csv, plot, picture;
  bool json = false, force = false;
};

struct Row {
  UpsamplingMethod method;
  RoundTrip cube;
  std::vector<PatchError> patches;
};

void write_text(const std::filesystem::path& name, const std::string& text) {
  AtomicFile file(name);
  file.write(std::as_bytes(std::span(text)));
  file.commit();
}

// One colour's reflectance by each method.
std::string spectra_csv(RGB c) {
  const MadeReflectance a = make_reflectance(UpsamplingMethod::jakob_hanika, c),
                        b = make_reflectance(UpsamplingMethod::matrix_r, c);
  std::string text = "wavelength_nm,jakob_hanika,matrix_r\n";
  for (std::size_t i = 0; i < a.values.size(); ++i)
    text += fmt::format("{},{:.9g},{:.9g}\n", 360 + 5 * i, a.values[i], b.values[i]);
  return text;
}

Json to_json(const Row& row) {
  Json of_patches = Json::array();
  for (const PatchError& p : row.patches)
    of_patches.push_back({{"name", p.name},
                          {"rms", p.rms},
                          {"max", p.max},
                          {"color_error", p.color},
                          {"in_gamut", p.in_gamut}});
  return {{"method", name_of(row.method)},         {"colors", row.cube.colors},
          {"max_error", row.cube.max_error},       {"mean_error", row.cube.mean_error},
          {"min_reflectance", row.cube.min_value}, {"max_reflectance", row.cube.max_value},
          {"roughness", row.cube.roughness},       {"color_checker", of_patches}};
}

void print_table(const std::vector<Row>& rows, const std::string& of) {
  show("{} colours of {} and back, under D65\n{:<14}{:>12}{:>12}{:>10}{:>10}{:>14}\n", rows[0].cube.colors,
       of, "", "max error", "mean error", "least", "greatest", "step of 5 nm");
  for (const Row& r : rows)
    show("{:<14}{:12.2e}{:12.2e}{:10.6f}{:10.6f}{:14.5f}\n", name_of(r.method), r.cube.max_error,
         r.cube.mean_error, r.cube.min_value, r.cube.max_value, r.cube.roughness);
  show(
      "\nColorChecker, difference from the measured reflectance (root mean square, largest), 380–780 "
      "nm\n{:<22}",
      "");
  for (const Row& r : rows) show("{:>20}", name_of(r.method));
  for (std::size_t i = 0; i < rows[0].patches.size(); ++i) {
    show("\n{:<22}", rows[0].patches[i].name);
    for (const Row& r : rows) show("{:12.4f}{:8.4f}", r.patches[i].rms, r.patches[i].max);
    if (!rows[0].patches[i].in_gamut) show("  outside of sRGB: clamped");
  }
  show("\n{:<22}", "mean");
  for (const Row& r : rows) {
    double rms = 0, max = 0;
    for (const PatchError& p : r.patches) rms += p.rms, max += p.max;
    const auto count = static_cast<double>(r.patches.size());
    show("{:12.4f}{:8.4f}", rms / count, max / count);
  }
  show("\n");
}

int run(const Arguments& a) {
  require_own_texts({a.csv, a.plot}, a.force);
  if (!a.plot.empty()) write_text(a.plot, patches_svg());
  if (!a.rgb.empty()) {
    const std::string csv = spectra_csv({a.rgb[0], a.rgb[1], a.rgb[2]});
    a.csv.empty() ? show("{}", csv) : write_text(a.csv, csv);
    return exit_done;
  }
  const std::vector<CountedColor> colors =
      a.picture.empty() ? cube_colors(a.cube) : picture_colors(a.picture);
  std::vector<Row> rows;
  for (const UpsamplingMethod method : upsampling_methods)
    rows.push_back({method, round_trip(method, colors), patch_errors(method)});
  if (!a.json) return print_table(rows, a.picture.empty() ? "the sRGB cube" : a.picture.string()), exit_done;
  Json json = Json::array();
  for (const Row& row : rows) json.push_back(to_json(row));
  show("{}\n", json.dump(1));
  return exit_done;
}

}  // namespace
}  // namespace vitrail

int main(int argc, char** argv) {
  using namespace vitrail;
  CLI::App app("reflectances made from RGB, by Jakob and Hanika and by Matrix-R, and their errors",
               "vitrail spectrum");
  Arguments a;
  CLI::Option* rgb =
      app.add_option("--rgb", a.rgb, "print the reflectances of this linear sRGB colour as CSV")
          ->expected(3)
          ->delimiter(',')
          ->check(CLI::Range(0.0, 1.0));
  app.add_option("--csv", a.csv, "write the reflectances of --rgb to this file")->needs(rgb);
  app.add_option("--cube", a.cube, "colours a side of the cube; default: 33 (100 are a million)")
      ->check(CLI::Range(2, 400));
  app.add_option("--picture", a.picture,
                 "use the colours of this picture in place of the cube's; linear, or sRGB of 8 or 16 bits");
  app.add_option("--plot", a.plot, "write the ColorChecker's spectra as SVG");
  app.add_flag("--json", a.json, "print JSON");
  app.add_flag("--force", a.force, "replace files that vitrail did not make");
  return run_guarded(app, argc, argv, [&] { return run(a); });
}
