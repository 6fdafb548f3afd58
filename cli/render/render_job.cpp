// SPDX-License-Identifier: Apache-2.0
#include "cli/render/render_job.h"

#include <fmt/format.h>

#include <csignal>
#include <string>

#include "cli/common/main_guard.h"
#include "cli/common/switching_glazing.h"
#include "cli/render/display_server.h"
#include "cli/render/job_limits.h"
#include "cli/render/picture_output.h"
#include "cli/render/preview.h"
#include "cli/render/temporary_bundle.h"
#include "farm/conclude/job_report.h"
#include "farm/files/signals.h"
#include "farm/render.h"
#include "farm/run/checkpoint.h"
#include "farm/run/progress.h"
#include "farm/transport/agreement.h"
#include "farm/transport/doing.h"
#include "farm/transport/share_text.h"
#include "film/develop.h"
#include "scene/system/atomic_file.h"
#include "scene/system/say.h"

namespace vitrail {

namespace {

namespace fs = std::filesystem;

void set_glazing(RenderArguments& a, const Manifest& manifest) {
  a.options.picture.sheets = sheets_under(parse_settings(a.glazing), a.options.bundle, manifest);
}

// The same on all ranks.
void complete_picture(Transport& transport, RenderArguments& a, KnownViews* known) {
  const bool first = transport.rank() == 0;
  std::string view;
  KnownViews read_here;
  agree(transport, [&] {
    if (first && !a.glazing.empty()) set_glazing(a, read_manifest(a.options.bundle));
    if (first && !a.camera_file.empty())
      view = text_of_view(a.camera_file, a.options.outputs.film, known ? *known : read_here);
  });
  share_from_root(transport, a.options.picture.sheets);
  if (a.camera_file.empty()) return;
  share_from_root(transport, view);
  a.options.picture.view.view = view_from_text(view);
}

void say_lamps(const RenderArguments& a) {
  if (a.is_bundle() && a.imports.lamps_are_off() && !a.quiet && a.frames.empty())
    say("vitrail: --lamps off: {}\n", words_of_lamps(read_manifest(a.options.bundle)));
}

int number_of(Ending ending) {
  return ending == Ending::terminated ? SIGTERM : ending == Ending::interrupted ? SIGINT : 0;
}

fs::path written_film(const RenderArguments& a, const RenderStats& stats) {
  const fs::path& film = a.options.outputs.film;
  return writes_film(stats.ending) ? film : checkpoint_path(film);
}

// Says where the work is, once the picture so far is written. The work is in order without that picture, too.
std::string words_at_stop(const RenderArguments& a, const RenderStats& stats) {
  if (a.options.outputs.dry_run) return "stopped";
  fs::path shown;
  try {
    shown = write_picture_so_far(a, stats);
  } catch (const std::exception& e) {
    say("vitrail: there is no picture so far: {}\n", e.what());
  }
  return fmt::format("stopped; {} holds the samples so far, and the same command continues{}",
                     checkpoint_path(a.options.outputs.film).string(),
                     shown.empty() ? "" : fmt::format("; {} shows it", shown.string()));
}

// On rank 0, once the film is written. Returns the words of a job that was stopped.
std::string write_pictures(const RenderArguments& a, const RenderStats& stats, int signal,
                           const std::function<void()>& once_written, std::optional<Preview>& preview,
                           std::optional<DisplayServer>& display) {
  if (preview) preview->finish();  // the picture is the last
  if (display) display->finish(), display->show(written_film(a, stats)), display->finish();
  if (signal) return words_at_stop(a, stats);
  write_picture_of_film(a, stats, once_written);
  return {};
}

}  // namespace

void complete_picture(RenderArguments& a, const Manifest& manifest, KnownViews& views) {
  if (!a.glazing.empty()) set_glazing(a, manifest);
  if (!a.camera_file.empty())
    a.options.picture.view.view = view_from_text(text_of_view(a.camera_file, a.options.outputs.film, views));
}

void lock_film(const RenderArguments& a, std::unique_ptr<OutputLock>& lock,
               std::chrono::milliseconds longest) {
  const fs::path& film = a.options.outputs.film;
  lock = wait_for_lock(film, longest, [&](const BeingWritten& refused) {
    if (longest.count() > 0 && !a.quiet)
      say("vitrail: {} is being written by another render ({}): waiting up to {} s for its end\n",
          film.string(), refused.holder, std::chrono::ceil<std::chrono::seconds>(longest).count());
  });
  for (const fs::path& file : {film, checkpoint_path(film)}) remove_temporaries(file);
}

int render_job(const CLI::App& app, Transport& transport, RenderArguments& a) {
  agree(transport, [&] { interpret(app, a); });
  std::unique_ptr<OutputLock> lock;
  agree(transport, [&] {
    if (transport.rank() != 0) return;
    check_outputs(a);
    // A rank outlives its mpirun, and one that is killed gives its memory back before its locks.
    lock_film(a, lock, std::chrono::seconds(5));
  });
  return render_locked(transport, a);
}

int render_locked(Transport& transport, RenderArguments& a, const JobSteps& steps) {
  const bool first = transport.rank() == 0;
  take_limits_of_job(transport, a.options);
  const auto beside_the_film = fs::path(a.options.outputs.film).replace_extension(".tmp.vit");
  a.options.bundle = a.is_bundle() ? a.input : beside_the_film;
  std::optional<TemporaryBundle> temporary;
  if (!a.is_bundle()) temporary.emplace(transport, a.input, beside_the_film, partition_arguments(a));
  complete_picture(transport, a, steps.views);
  agree_on_root(transport, [&] { say_lamps(a); });
  agree(transport, [] {
    if (stop_signal()) throw Interrupted(stop_signal(), "interrupted before rendering began");
  });
  std::optional<Preview> preview;
  std::optional<DisplayServer> display;
  const bool is_shown = first && !a.options.outputs.dry_run;
  if (is_shown && !a.preview.empty()) preview.emplace(a.preview);
  if (is_shown && !a.display_server.empty())
    display.emplace(parse_display_address(a.display_server), a.output.filename().string());
  const auto show = [&](const fs::path& film) {
    if (preview) preview->develop(film);
    if (display) display->show(film);
  };
  if (preview || display) a.options.outputs.after_checkpoint = show;
  a.options.resources.after_film = developing(a);
  a.options.outputs.denoises = a.denoised;
  a.options.outputs.preview = a.preview;
  a.options.outputs.displays = !a.display_server.empty();
  RenderStats stats = render(transport, a.options);
  agree(transport, [&] { require_unsaturated(stats.refused, a.options.outputs.film); });
  const int signal = number_of(stats.ending);
  std::string stopped;
  now_doing("writing the picture");
  // All ranks know how it went: another frame may follow.
  agree_on_root(transport, [&] {
    stopped = write_pictures(a, stats, signal, steps.once_written, preview, display);
    print_end(a.options, stats);
    if (!a.options.outputs.dry_run) add_peak_of_picture(a.options, stats);
    if (steps.expected_s && stats.expected_s > 0) steps.expected_s(stats.expected_s);
    // Of a Slurm job's share nobody has promised anything.
    if (!signal && !a.memory.empty()) require_kept_memory(stats);
  });
  if (!first) return signal ? 128 + signal : exit_done;
  if (signal) throw Interrupted(signal, stopped);
  return exit_done;
}

}  // namespace vitrail
