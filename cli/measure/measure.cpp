// SPDX-License-Identifier: Apache-2.0
// vitrail measure: what each setting buys on this scene, and which to take.
#include "measure/measure.h"

#include <fmt/format.h>

#include <csignal>

#include "cli/common/main_guard.h"
#include "cli/common/number_checks.h"
#include "cli/common/run_program.h"
#include "measure/report.h"
#include "measure/words.h"
#include "scene/system/diagnostics.h"
#include "scene/system/output_place.h"
#include "scene/system/progress_line.h"
#include "scene/system/say.h"

using namespace vitrail;

namespace {

volatile std::sig_atomic_t stop_number = 0;

void catch_signals() {
  for (const int number : {SIGINT, SIGTERM}) std::signal(number, [](int n) { stop_number = n; });
}

int run(const MeasureOptions& options, bool quiet) {
  if (!std::filesystem::exists(options.scene)) throw Error("there is no such file", {options.scene.string()});
  chosen_axes(known_axes({}), options.axes);  // refuses unknown names before any work
  require_folder_of(options.folder);
  require_own_page(options.folder);
  std::filesystem::create_directories(options.folder);
  catch_signals();
  ProgressLine line(progress_manner(quiet));
  MeasureNews news;
  news.say = [&](const std::string& text) {
    line.clear();
    if (!quiet) show("{}\n", text);
    std::fflush(stdout);
  };
  news.progress = [&](double fraction, const char* what) { line.show(fraction, what); };
  const Execute execute = [](const std::string& program, const std::vector<std::string>& arguments,
                             const std::filesystem::path& standard_output) {
    try {
      run_program(
          program, arguments, [] { return stop_number != 0; }, standard_output);
    } catch (const Interrupted& e) {
      throw Interrupted(e.signal, "stopped; the same command continues where it stopped");
    }
    if (stop_number) throw Interrupted(stop_number, "stopped; the same command continues where it stopped");
  };
  const Measurement m = measure(options, execute, news);
  line.clear();
  write_report(options, m);
  if (quiet) return exit_done;
  show("\n{}\n", table(m));
  for (const std::string& finding : findings(m)) show("{}\n", finding);
  show("\n");
  for (std::size_t i = 1; i < m.settings.size(); ++i)
    if (m.settings[i].changes() < 2 && !m.settings[i].again) show("{}\n", what_it_buys(m, m.settings[i]));
  show("\n");
  for (const Recommendation& r : m.recommendations) show("{}\n", advice(r));
  show("{} shows it\n", (options.folder / "index.html").string());
  return exit_done;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Measures what speed costs on a scene: renders it small with one setting changed at a time, against a "
      "long reference, and recommends. After an interruption the same command continues.",
      "vitrail measure");
  MeasureOptions options;
  bool quiet = false;
  app.add_option("input", options.scene, "a scene, or a bundle")->required();
  app.add_option("-o,--output", options.folder, "folder to write: index.html, measure.json, and all renders")
      ->required();
  app.add_option("--axes", options.axes,
                 fmt::format("which settings to change, separated by commas: {}; default: all",
                             fmt::join(axis_names(), ", ")))
      ->delimiter(',');
  app.add_option("--error", options.error, "recommend the cheapest setting of at most this relMSE")
      ->check(more_than_0);
  app.add_option("--seconds", options.seconds,
                 "recommend the most accurate setting that renders the whole picture within this time here")
      ->transform(plain_seconds)
      ->check(more_than_0);
  app.add_option("--bias", options.most_bias,
                 "recommend nothing that may change the picture's mean light by more than this share, "
                 "against paths of any length")
      ->check(more_than_0)
      ->capture_default_str();
  app.add_option("--budget", options.budget_s,
                 "seconds for all renders, roughly; too small a budget is exceeded. Rendering the "
                 "recommendation with its own samples may take as long again")
      ->transform(plain_seconds)
      ->check(more_than_0)
      ->capture_default_str();
  app.add_option(
         "--ranks", options.farm.ranks,
         "plan each setting's seconds for the whole picture on a cluster of this many ranks; 0: no plan")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  app.add_option("--threads", options.farm.threads, "threads a rank")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  app.add_option("--width", options.width, "width of the measured pictures, in pixels")
      ->check(CLI::Range(16, 1 << 14))
      ->capture_default_str();
  app.add_option("--seeds", options.seeds, "pictures of each setting")
      ->check(CLI::Range(3, 100))
      ->capture_default_str();
  app.add_option("--first-seed", options.first_seed, "of the pictures; of the reference: a million more")
      ->group("");
  app.add_option("--spp", options.spp, "samples of a measured picture; default: as --budget allows")
      ->transform(plain_count)
      ->check(more_than_0);
  app.add_option("--reference-spp", options.reference_spp,
                 "samples of each half of the reference; default: 16 times the samples of a picture")
      ->transform(plain_count)
      ->check(more_than_0);
  app.add_flag("--every-combination", options.every_combination,
               "measure all combinations of the axes, not only the promising ones; takes long");
  app.add_flag("--quiet", quiet, "print problems only");
  return end_with(run_guarded(app, argc, argv, [&] { return run(options, quiet); }));
}
