// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <csignal>
#include <functional>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/common/main_guard.h"
#include "cli/common/run_program.h"
#include "cli/common/switching_glazing.h"
#include "cli/help/describe.h"
#include "cli/render/display_server.h"
#include "cli/render/frame_record.h"
#include "cli/render/frames.h"
#include "cli/render/job_limits.h"
#include "cli/render/other_camera.h"
#include "cli/render/picture_output.h"
#include "cli/render/preview.h"
#include "cli/render/render_arguments.h"
#include "cli/render/supervise.h"
#include "cli/render/temporary_bundle.h"
#include "farm/conclude/job_report.h"
#include "farm/files/output_lock.h"
#include "farm/files/signals.h"
#include "farm/render.h"
#include "farm/run/checkpoint.h"
#include "farm/run/patience.h"
#include "farm/run/progress.h"
#include "farm/run/watchdog.h"
#include "farm/run/work_words.h"
#include "farm/transport/agreement.h"
#include "farm/transport/doing.h"
#include "film/develop.h"
#include "scene/system/atomic_file.h"
#include "scene/system/say.h"

namespace vitrail {
namespace {

namespace fs = std::filesystem;

void set_glazing(RenderArguments& a) {
  const fs::path& bundle = a.options.bundle;
  a.options.picture.sheets = sheets_under(parse_settings(a.glazing), bundle, read_manifest(bundle));
}

// What of the picture is known from the bundle alone, or from another scene's camera.
void complete_picture(Transport& transport, RenderArguments& a) {
  agree(transport, [&] {
    if (transport.rank() == 0 && !a.glazing.empty()) set_glazing(a);
  });
  share_from_root(transport, a.options.picture.sheets);
  if (!a.camera_file.empty())
    a.options.picture.view.view = view_of_scene(
        transport, a.camera_file, fs::path(a.options.outputs.film).replace_extension(".tmp.camera"));
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
  complete_picture(transport, a);
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
  RenderStats stats = render(transport, a.options);
  agree(transport, [&] { require_unsaturated(stats.refused, a.options.outputs.film); });
  const int signal = number_of(stats.ending);
  if (!first) return signal ? 128 + signal : exit_done;
  std::string stopped;
  now_doing("writing the picture");
  beside(transport, [&] {
    if (preview) preview->finish();  // the picture is the last
    if (display) display->finish(), display->show(written_film(a, stats)), display->finish();
    if (signal)
      stopped = words_at_stop(a, stats);
    else
      write_picture_of_film(a, stats);
  });
  print_end(a.options, stats);
  if (!a.options.outputs.dry_run) add_peak_of_picture(a.options, stats);
  if (signal) throw Interrupted(signal, stopped);
  if (!a.memory.empty()) require_kept_memory(stats);  // of a Slurm job's share nobody has promised anything
  return exit_done;
}

// A job of several ranks says which one speaks.
int guarded(const Transport& transport, const std::function<int()>& job) {
  const std::string who =
      transport.size() > 1 ? fmt::format("rank {} of {}: ", transport.rank(), transport.size()) : "";
  try {
    return job();
  } catch (const OtherRankFailed& failed) {
    if (stop_signal()) return 128 + stop_signal();
    return failed.bad_input ? exit_bad_input : exit_machine;
  } catch (const Interrupted&) {
    throw;
  } catch (const AlreadySaid&) {
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

// As a shell takes it: words with other characters than these are quoted.
std::string typed_command(int argc, char** argv) {
  std::string line = "vitrail render";
  for (const std::string word : std::span(argv, static_cast<std::size_t>(argc)).subspan(1)) {
    const bool plain = !word.empty() && std::ranges::all_of(word, [](unsigned char c) {
      return std::isalnum(c) != 0 ||
             std::string_view("_-+=./:,@%").find(static_cast<char>(c)) != std::string_view::npos;
    });
    std::string quoted;
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += plain ? " " + word : fmt::format(" '{}'", quoted);
  }
  return line;
}

// The job of one frame, by the words of the command and those of its line.
class FrameJob {
 public:
  FrameJob(std::span<char* const> typed, const Frame& frame, const fs::path& frames, const fs::path& output) {
    declare(app_, arguments_);
    let_the_last_count(app_);
    std::vector<std::string> words(typed.begin() + 1, typed.end());
    words.insert(words.end(), frame.words.begin(), frame.words.end());
    words.insert(words.end(), {"-o", output.string()});
    arguments_.options.outputs.command = fmt::format("vitrail render {}", fmt::join(words, " "));
    std::ranges::reverse(words);
    try {
      app_.parse(words);
    } catch (const CLI::ParseError& e) {
      throw Error(e.what(), {frames.string(), static_cast<int>(frame.line), 1});
    }
  }

  int render(Transport& transport) { return render_job(app_, transport, arguments_); }

  // On rank 0; elsewhere nothing. The job renders nothing afterwards.
  WorkWords words(Transport& transport) {
    RenderArguments& a = arguments_;
    agree(transport, [&] { interpret(app_, a); });
    a.options.bundle = a.input;
    complete_picture(transport, a);
    WorkWords work;
    agree(transport, [&] {
      if (transport.rank() != 0) return;
      work = words_of_work(a.options);
      work.fields.emplace_back("--denoise", a.denoised ? "yes" : "no");
    });
    return work;
  }

 private:
  CLI::App app_{"a frame", "vitrail render"};
  RenderArguments arguments_;
};

// Where pictures are there that no checkpoint says to be unfinished: on all ranks as on rank 0.
std::vector<std::uint64_t> which_are_whole(Transport& transport, const std::vector<fs::path>& pictures) {
  std::vector<std::uint64_t> whole(pictures.size());
  for (std::size_t i = 0; i < pictures.size(); ++i)
    whole[i] = transport.rank() == 0 && fs::exists(pictures[i]) &&
               !fs::exists(checkpoint_path(fs::path(pictures[i]) += ".work"));
  transport.broadcast_from_root(std::span(whole));
  return whole;
}

// Says of the first, and how many more there are.
[[noreturn]] void refuse_other_pictures(const std::vector<std::pair<fs::path, std::string>>& others) {
  const auto& [picture, difference] = others.front();
  throw Error(
      fmt::format("this picture is not what its line asks for: {}{}; --force renders all frames anew, and "
                  "another --output keeps it",
                  difference, others.size() > 1 ? fmt::format(" ({} more differ)", others.size() - 1) : ""),
      {picture.string()});
}

// A job for each frame that is missing. Before the first, pictures that are there are held to their lines;
// films tell by themselves what they are of.
int render_frames(Transport& transport, const RenderArguments& all, std::span<char* const> typed) {
  if (!all.is_bundle())
    throw UsageError(
        "--frames takes a bundle: vitrail partition makes one of the scene, once for all frames");
  if (!all.film.empty())
    throw UsageError(
        "--frames keeps a film for each picture: leave out --film, or let --output end in %04d.film");
  const std::vector<Frame> frames = read_frames(all.frames);
  std::vector<fs::path> outputs;
  for (std::size_t i = 0; i < frames.size(); ++i) outputs.push_back(numbered(all.output, i + 1));
  const auto job = [&](std::size_t i) { return FrameJob(typed, frames[i], all.frames, outputs[i]); };
  const JobOutputs& o = all.options.outputs;
  const bool first = transport.rank() == 0, of_films = all.output.extension() == ".film";
  std::vector<std::uint64_t> stays(frames.size());
  if (!of_films && !o.force) stays = which_are_whole(transport, outputs);
  std::optional<FrameRecord> record;
  agree(transport, [&] {
    if (first && !of_films) record.emplace(record_path(all.output));
  });
  std::vector<std::pair<fs::path, std::string>> others;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (stays[i] == 0) continue;
    const WorkWords asked = job(i).words(transport);
    if (!first) continue;
    if (const std::string d = record->differences(outputs[i], asked); !d.empty())
      others.emplace_back(outputs[i], d);
  }
  agree(transport, [&] {
    if (!others.empty()) refuse_other_pictures(others);
  });
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (first && !all.quiet)
      say("vitrail: frame {} of {}: {}{}\n", i + 1, frames.size(), outputs[i].string(),
          stays[i] != 0 ? " is there and stays" : "");
    if (stays[i] != 0) continue;
    const bool recorded = !of_films && !o.dry_run;
    const WorkWords work = recorded ? job(i).words(transport) : WorkWords();
    const auto note = [&](bool of_old_picture) {
      agree(transport, [&] {
        if (!first || !recorded) return;
        // Killed between, a job leaves the old picture: nobody takes that for the new one.
        of_old_picture ? record->remove(outputs[i]) : record->put(outputs[i], work);
      });
    };
    note(o.force && fs::exists(outputs[i]));
    if (const int status = job(i).render(transport); status != exit_done) return status;
    note(false);
  }
  return exit_done;
}

int supervise_job(RenderArguments& a, int argc, char** argv) {
  if (launched_by_mpi())
    throw UsageError(
        "a rank cannot start the job again: use vitrail render --restarts N --launcher 'mpirun …'");
  if (a.options.outputs.force && a.restarts > 0)
    throw UsageError("--force would begin anew at each restart: remove the old files instead");
  if (!a.frames.empty())
    throw UsageError("--frames continues at the first missing picture: leave out --restarts");
  a.name_outputs();
  return supervise(supervised_command(argc, argv, a.launcher), a.options.outputs.film, a.restarts,
                   a.options.resources.patience_s);
}

}  // namespace
}  // namespace vitrail

int main(int argc, char** argv) {
  using namespace vitrail;
  catch_checkpoint_signal();
  CLI::App app("renders a bundle or a scene, alone or as the ranks of an MPI job", "vitrail render");
  RenderArguments arguments;
  arguments.options.outputs.command = typed_command(argc, argv);
  declare(app, arguments);
  const int status = run_guarded(app, argc, argv, [&] {
    if (arguments.restarts > 0 || !arguments.launcher.empty()) return supervise_job(arguments, argc, argv);
    const double patience_s = arguments.options.resources.patience_s;
    Watchdog watchdog(patience_s);
    now_doing("starting MPI");
    if (launched_by_mpi()) watchdog.expect_reports();
    const auto transport = make_transport(&argc, &argv);
    Patience patience(*transport, watchdog, patience_s);
    const int end = run_guarded([&] {
      return guarded(*transport, [&] {
        if (arguments.frames.empty()) return render_job(app, *transport, arguments);
        return render_frames(*transport, arguments, std::span(argv, static_cast<std::size_t>(argc)));
      });
    });
    patience.leave(/*failed=*/end == exit_usage || end == exit_bad_input || end == exit_machine);
    return end;
  });
  // mpirun takes a rank that dies of a signal for a failure of the job.
  return launched_by_mpi() ? status : end_with(status);
}
