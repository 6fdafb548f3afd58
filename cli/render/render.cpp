// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/common/main_guard.h"
#include "cli/common/rank_guard.h"
#include "cli/render/frames.h"
#include "cli/render/render_arguments.h"
#include "cli/render/render_frames.h"
#include "cli/render/render_job.h"
#include "cli/render/supervise.h"
#include "farm/files/output_lock.h"
#include "farm/files/signals.h"
#include "farm/run/checkpoint.h"
#include "farm/run/patience.h"
#include "farm/run/watchdog.h"
#include "farm/transport/doing.h"

namespace vitrail {
namespace {

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

// A name of this supervisor's, which the render has locked while it goes over the list.
std::filesystem::path lock_of_list(const std::filesystem::path& output) {
  std::array<char, 128> host{};
  ::gethostname(host.data(), host.size() - 1);
  return record_path(output) += fmt::format(".{}-{}", host.data(), ::getpid());
}

int supervise_frames(const RenderArguments& a, int argc, char** argv) {
  const std::filesystem::path held = lock_of_list(a.output);
  std::vector<std::string> command = supervised_command(argc, argv, a.launcher);
  command.insert(command.end(), {"--held-lock", held.string()});
  const int status =
      supervise(command, held, {record_path(a.output), "frame"}, a.restarts, a.options.resources.patience_s);
  try {
    const OutputLock last(held);  // one that was killed leaves its file
  } catch (const MachineError&) {
  }
  return status;
}

int supervise_job(RenderArguments& a, int argc, char** argv) {
  if (launched_by_mpi())
    throw UsageError(
        "a rank cannot start the job again: use vitrail render --restarts N --launcher 'mpirun …'");
  if (a.options.outputs.force && a.restarts > 0)
    throw UsageError("--force would begin anew at each restart: remove the old files instead");
  if (!a.frames.empty()) return supervise_frames(a, argc, argv);
  a.name_outputs();
  const std::filesystem::path& film = a.options.outputs.film;
  return supervise(supervised_command(argc, argv, a.launcher), film, {checkpoint_path(film), "checkpoint"},
                   a.restarts, a.options.resources.patience_s);
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
