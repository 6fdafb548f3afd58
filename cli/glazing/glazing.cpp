// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <span>

#include "cli/common/main_guard.h"
#include "cli/common/own_output.h"
#include "cli/glazing/glazing_report.h"
#include "cli/glazing/sheet_report.h"
#include "compare/web_page.h"
#include "glazing/energyplus_text.h"
#include "glazing/scattering.h"
#include "glazing/system_file.h"
#include "glazing/text_file.h"
#include "scene/system/atomic_file.h"
#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"
#include "scene/system/say.h"

namespace vitrail {
namespace {

struct Arguments {
  std::vector<std::string> files;
  std::vector<std::size_t> flips;
  std::vector<double> theta_deg{0};
  std::string standard, sampling = "full";
  std::filesystem::path csv, report, energyplus;
  std::vector<std::string> gaps;
  std::optional<double> state, temperature_c;
  bool unpolarised = false, json = false, force = false;
};

void add_options(CLI::App& app, Arguments& a) {
  app.add_option("files", a.files, "panes from outside: products (FILE or FILE#NAME) or a system file")
      ->required();
  app.add_option("--flip", a.flips, "turn this pane round, counted from 1 outside (may repeat)")
      ->check(CLI::Range(1, 1000))
      ->allow_extra_args(false);
  app.add_option(
         "--gap", a.gaps,
         "a gap, mm, and its gas: 12.7, 16:argon, 16:argon=0.9,air=0.1; once for each gap, from outside")
      ->allow_extra_args(false);
  app.add_option("--theta", a.theta_deg, "angles of incidence, degrees from the normal; default: 0")
      ->check(CLI::Range(0.0, 90.0));
  app.add_option("--state", a.state, "state of switchable glazing: 0 is clear, 1 is dark")
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--temperature", a.temperature_c, "temperature of thermochromic glass, °C");
  app.add_option("--standard", a.standard, "a WINDOW standard (.std); default: NFRC 300-2003, built in");
  app.add_option("--sampling", a.sampling,
                 "which wavelengths: full and condensed as in WinCalc, standard as in Optics and the IGSDB")
      ->check(CLI::IsMember({"full", "condensed", "standard"}));
  app.add_flag("--unpolarised", a.unpolarised,
               "take the mean of both polarisations at each pane, as WINDOW does");
  app.add_flag("--polarised")->group("");  // what is so without it now
  app.add_option("--csv", a.csv, "write the spectra here");
  app.add_option("--report", a.report, "write a data sheet here, a page (.html) or JSON (.json)");
  app.add_option("--energyplus", a.energyplus,
                 "write a construction for EnergyPlus here (.idf), of each state");
  app.add_flag("--json", a.json, "print JSON");
  app.add_flag("--force", a.force, "replace files that vitrail did not make");
}

double cosine_of(double theta_deg) {
  return theta_deg == 90 ? 0 : std::cos(theta_deg * std::numbers::pi / 180);
}

Sampling sampling_of(const std::string& name) {
  return name == "condensed" ? Sampling::condensed : name == "standard" ? Sampling::standard : Sampling::full;
}

// CLI::Range lets what is not a number pass.
void check_finite(const char* option, double value) {
  if (!std::isfinite(value)) throw UsageError(fmt::format("{} {}: has to be a finite number", option, value));
}

// "MM" or "MM:GASES" (glazing/gas.h).
void set_gap(GlazingLayer& layer, const std::string& text) {
  const std::size_t colon = text.find(':');
  if (!parse_number(text.substr(0, colon), layer.gap_behind_mm) || !(layer.gap_behind_mm > 0))
    throw UsageError(fmt::format("--gap {}: a gap has a width in mm above 0", text));
  layer.gas_behind.clear();
  if (colon == text.npos) return;
  const auto gas = gas_mixture(text.substr(colon + 1));
  if (!gas)
    throw UsageError(fmt::format(
        "--gap {}: the gas is air, argon, krypton, xenon, or shares of them that sum to 1", text));
  layer.gas_behind = *gas;
}

void set_gaps(GlazingSystem& system, const std::vector<std::string>& gaps) {
  if (gaps.empty()) return;
  if (gaps.size() + 1 != system.layers.size())
    throw UsageError(fmt::format("--gap is given {} times; {} panes have {} gaps", gaps.size(),
                                 system.layers.size(), system.layers.size() - 1));
  for (std::size_t i = 0; i < gaps.size(); ++i) set_gap(system.layers[i], gaps[i]);
}

// Before any work: a page or JSON by its ending.
bool is_json_report(const std::filesystem::path& file) {
  if (file.extension() == ".json") return true;
  if (file.extension() == ".html" || file.extension() == ".htm") return false;
  throw UsageError(fmt::format("--report {}: ends in .html or .json", file.string()));
}

ReadSystem read(const Arguments& a) {
  for (const double theta : a.theta_deg) check_finite("--theta", theta);
  check_finite("--state", a.state.value_or(0));
  check_finite("--temperature", a.temperature_c.value_or(0));
  ReadSystem read = read_system(a.files);
  for (const std::size_t pane : a.flips) {
    if (pane > read.system.layers.size())
      throw UsageError(fmt::format("--flip {}: there are {} panes", pane, read.system.layers.size()));
    read.system.layers[pane - 1].flipped = !read.system.layers[pane - 1].flipped;
  }
  set_gaps(read.system, a.gaps);
  if (a.state && !set(read.system, Quantity::state, *a.state))
    throw UsageError("--state: no pane has states; a system file says them (docs/why/glazing.md)");
  if (a.temperature_c && !set(read.system, Quantity::temperature, *a.temperature_c))
    throw UsageError("--temperature: no pane is thermochromic or photochromic");
  return read;
}

int run(const Arguments& a) {
  protect_inputs();
  const bool json_report = !a.report.empty() && is_json_report(a.report);
  require_own_texts({a.csv, a.report, a.energyplus}, a.force);
  ReadSystem input = read(a);
  const GlazingSystem& system = input.system;
  const Standard standard = a.standard.empty() ? nfrc_2003() : read_standard(a.standard);
  const Polarisation polarisation = a.unpolarised ? Polarisation::mixed_at_panes : Polarisation::apart;
  const std::vector<double> nm = common_wavelengths(system);
  if (const std::string held = held_note(system, 300, 2500); !held.empty()) input.notes.push_back(held);
  for (std::string& note : scattering_notes(system)) input.notes.push_back(std::move(note));

  GlazingReport report{system, standard.description, a.sampling, input.notes, {}};
  const auto add = [&](std::optional<double> theta, HemisphereRule rule) {
    const auto spectrum = [&](std::vector<double> at) {
      return theta ? spectrum_at(system, std::move(at), cosine_of(*theta), polarisation)
                   : hemispherical_spectrum(system, std::move(at), polarisation, rule);
    };
    report.results.push_back({theta, rule, evaluate(spectrum, nm, standard, sampling_of(a.sampling))});
  };
  for (const double theta : a.theta_deg) add(theta, {});
  add({}, HemisphereRule::gauss);
  if (a.sampling != "standard") add({}, HemisphereRule::each_10_deg);

  if (!a.csv.empty()) {
    std::vector<SystemSpectrum> spectra;
    for (const double theta : a.theta_deg)
      spectra.push_back(spectrum_at(system, nm, cosine_of(theta), polarisation));
    AtomicFile file(a.csv);
    const std::string text = glazing_csv(a.theta_deg, spectra);
    file.write(std::as_bytes(std::span(text)));
    file.commit();
  }
  if (!a.report.empty()) {
    const DataSheet sheet = data_sheet(system, polarisation);
    if (!sheet.why_no_heat.empty()) say("vitrail: no figures of heat: {}\n", sheet.why_no_heat);
    write_whole(a.report, json_report ? sheet_json(sheet, input.notes) : sheet_page(sheet, input.notes));
  }
  if (!a.energyplus.empty()) write_whole(a.energyplus, energyplus_text(system));
  if (!a.json)
    for (const std::string& note : input.notes) say("vitrail: note: {}\n", note);
  show("{}\n", a.json ? glazing_json(report) : glazing_table(report));
  return exit_done;
}

}  // namespace
}  // namespace vitrail

int main(int argc, char** argv) {
  using namespace vitrail;
  CLI::App app("transmittance, reflectance and colour of a glazing, by angle and standard",
               "vitrail glazing");
  Arguments arguments;
  add_options(app, arguments);
  return run_guarded(app, argc, argv, [&] { return run(arguments); });
}
