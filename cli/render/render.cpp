// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <csignal>
#include <new>
#include <optional>

#include "cli/common/main_guard.h"
#include "cli/common/run_program.h"
#include "cli/common/switching_glazing.h"
#include "cli/render/job_limits.h"
#include "cli/render/preview.h"
#include "cli/render/render_arguments.h"
#include "cli/render/supervise.h"
#include "cli/render/temporary_bundle.h"
#include "farm/files/output_lock.h"
#include "farm/files/signals.h"
#include "farm/render.h"
#include "farm/run/checkpoint.h"
#include "farm/transport/agreement.h"
#include "film/develop.h"
#include "film/film_progress.h"
#include "film/png_file.h"
#include "scene/system/atomic_file.h"
#include "scene/system/input_files.h"
#include "scene/system/output_place.h"
#include "scene/system/say.h"

namespace vitrail {
namespace {

namespace fs = std::filesystem;

bool is_film(const fs::path& output) { return output.extension() == ".film"; }
bool is_png(const fs::path& output) { return output.extension() == ".png"; }

// A picture is known by the film beside it. Without one it may be anybody's.
void require_own_picture(const RenderArguments& a, const fs::path& picture) {
  if (a.options.outputs.force || !fs::exists(picture) || fs::exists(a.options.outputs.film) ||
      fs::exists(checkpoint_path(a.options.outputs.film)))
    return;
  throw Error(fmt::format("it is there already, and there is no {} to say that this render made it; --force "
                          "replaces it, and another name keeps it",
                          a.options.outputs.film.filename().string()),
              {picture.string()});
}

void check_outputs(const RenderArguments& a) {
  note_input(a.input);
  for (const fs::path& file : {a.output, a.options.outputs.film, a.options.outputs.stats,
                               a.options.outputs.profile, a.options.outputs.trace, a.preview})
    if (!file.empty()) require_place(file);
  if (!is_film(a.output)) require_own_picture(a, a.output);
  if (!a.preview.empty()) require_own_picture(a, a.preview);
  // Before hours of rendering.
  if (a.denoised) run_program("vitrail-develop", {"--find-denoiser"}, nullptr, "/dev/null");
}

void set_glazing(RenderArguments& a) {
  const fs::path& bundle = a.options.bundle;
  a.options.picture.sheets = sheets_under(parse_settings(a.settings), bundle, read_manifest(bundle));
}

void write_png_of(const fs::path& file, const fs::path& output) {
  const Film film = read_film(file, nullptr);
  require_samples(film, file);
  write_png(output, develop_colors(film));
}

// Formats other than PNG need a library that takes 0.3 s and 130 MB to load: another program writes them.
void develop_film(const RenderArguments& a, const RenderStats& stats) {
  // One that is newer than its finished film was made of it, and perhaps worked on since.
  std::error_code none;
  const auto developed = fs::last_write_time(a.output, none);
  if (stats.finished_before && !a.options.outputs.force && !none &&
      developed >= fs::last_write_time(a.options.outputs.film)) {
    if (a.denoised && !a.quiet)
      say("vitrail: {} is newer than its film and stays; vitrail develop {} -o {} --denoise replaces it\n",
          a.output.string(), a.options.outputs.film.string(), a.output.string());
    return;
  }
  if (is_png(a.output) && !a.denoised) return write_png_of(a.options.outputs.film, a.output);
  std::vector<std::string> arguments{a.options.outputs.film.string(), "-o", a.output.string(), "--quiet"};
  if (stats.spectral_bins > 0 && a.output.extension() == ".exr") arguments.push_back("--spectral");
  if (a.denoised) arguments.push_back("--denoise");
  run_program("vitrail-develop", arguments);
}

// Measured on one core (docs/adaptive.md): the image library is loaded; the film is read, converted, packed.
AfterFilm developing(const fs::path& output, bool denoised) {
  if (is_film(output)) return {};
  if (denoised) return {0.7, 1.2e-7};  // docs/denoising.md
  return {is_png(output) ? 0 : 0.19, 4e-9};
}

int number_of(Ending ending) {
  return ending == Ending::terminated ? SIGTERM : ending == Ending::interrupted ? SIGINT : 0;
}

int render_job(const CLI::App& app, Transport& transport, RenderArguments& a) {
  agree(transport, [&] { interpret(app, a); });
  const bool first = transport.rank() == 0;
  take_limits_of_job(a.options, first);
  std::optional<OutputLock> lock;
  agree(transport, [&] {
    if (!first) return;
    check_outputs(a);
    lock.emplace(a.options.outputs.film);
    for (const fs::path& file : {a.options.outputs.film, checkpoint_path(a.options.outputs.film)})
      remove_temporaries(file);
  });
  const auto beside_the_film = fs::path(a.options.outputs.film).replace_extension(".tmp.vit");
  a.options.bundle = a.is_bundle() ? a.input : beside_the_film;
  std::optional<TemporaryBundle> temporary;
  if (!a.is_bundle()) temporary.emplace(transport, a.input, beside_the_film, partition_arguments(a));
  agree(transport, [&] {
    if (first && !a.settings.empty()) set_glazing(a);
  });
  share_from_root(transport, a.options.picture.sheets);
  agree(transport, [] {
    if (stop_signal()) throw Interrupted(stop_signal(), "interrupted before rendering began");
  });
  std::optional<Preview> preview;
  if (first && !a.preview.empty()) {
    preview.emplace(a.preview);
    a.options.outputs.after_checkpoint = [&](const fs::path& checkpoint) { preview->develop(checkpoint); };
  }
  a.options.resources.after_film = developing(a.output, a.denoised);
  const RenderStats stats = render(transport, a.options);
  preview.reset();  // the picture is the last
  agree(transport, [&] { require_unsaturated(stats.refused, a.options.outputs.film); });
  const int signal = number_of(stats.ending);
  if (!first) return signal ? 128 + signal : exit_done;
  if (signal)
    throw Interrupted(signal,
                      a.options.outputs.dry_run
                          ? "stopped"
                          : fmt::format("stopped; {} holds what was done, and the same command goes on",
                                        checkpoint_path(a.options.outputs.film).string()));
  if (!is_film(a.output) && !a.options.outputs.dry_run) develop_film(a, stats);
  return exit_done;
}

// A job of several ranks says which one speaks.
int guarded_job(const CLI::App& app, Transport& transport, RenderArguments& a) {
  const std::string who =
      transport.size() > 1 ? fmt::format("rank {} of {}: ", transport.rank(), transport.size()) : "";
  try {
    return render_job(app, transport, a);
  } catch (const OtherRankFailed& failed) {
    if (stop_signal()) return 128 + stop_signal();
    return failed.bad_input ? exit_bad_input : exit_machine;
  } catch (const Interrupted&) {
    throw;
  } catch (const Error& error) {
    throw Error(who + error.what(), error.location, error.excerpt);
  } catch (const UsageError& error) {
    throw UsageError(who + error.what());
  } catch (const std::bad_alloc&) {
    throw MachineError(who + "out of memory; a large picture is rendered in parts with --crop");
  } catch (const std::exception& error) {
    throw MachineError(who + error.what());
  }
}

int supervise_job(RenderArguments& a, int argc, char** argv) {
  if (launched_by_mpi())
    throw UsageError(
        "a rank cannot start the job again: vitrail render --restarts N --launcher 'mpirun …' can");
  if (a.options.outputs.force && a.restarts > 0)
    throw UsageError("--force would begin anew at each restart: remove what is to be replaced instead");
  a.name_outputs();
  return supervise(supervised_command(argc, argv, a.launcher), a.options.outputs.film, a.restarts,
                   a.options.resources.patience_s);
}

}  // namespace
}  // namespace vitrail

int main(int argc, char** argv) {
  using namespace vitrail;
  CLI::App app("renders a bundle or a scene, alone or as the ranks of an MPI job", "vitrail render");
  RenderArguments arguments;
  declare(app, arguments);
  const int status = run_guarded(app, argc, argv, [&] {
    if (arguments.restarts > 0 || !arguments.launcher.empty()) return supervise_job(arguments, argc, argv);
    const auto transport = make_transport(&argc, &argv);
    return run_guarded([&] { return guarded_job(app, *transport, arguments); });
  });
  // mpirun takes a rank that dies of a signal for a failure of the job.
  return launched_by_mpi() ? status : end_with(status);
}
