// SPDX-License-Identifier: Apache-2.0
#include "farm/files/film_keeper.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <optional>
#include <thread>
#include <vector>

#include "farm/files/signals.h"
#include "film/film_progress.h"
#include "scene/system/diagnostics.h"
#include "scene/system/say.h"

namespace vitrail {

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

// Returns why it failed; "" where it did not.
std::string try_to_write(const fs::path& file, const Film& film, const FilmProgress& progress) {
  try {
    write_film(file, film, progress);
  } catch (const MachineError& failure) {
    return failure.what();
  }
  return {};
}

void pause(std::chrono::milliseconds time) {
  for (; time > 0ms && !stop_signal(); time -= 50ms) std::this_thread::sleep_for(50ms);
}

std::vector<fs::path> spare_folders() {
  std::error_code ignored;
  std::vector<fs::path> folders{fs::current_path(ignored)};
  if (const char* named = std::getenv("TMPDIR")) folders.emplace_back(named);
  folders.emplace_back("/tmp");
  return folders;
}

fs::path free_name(const fs::path& folder, const fs::path& name) {
  std::error_code unknown;
  fs::path file = folder / name;
  for (int n = 2; fs::exists(file, unknown); ++n) file = folder / fmt::format("{}.{}", name.string(), n);
  return file;
}

std::optional<fs::path> write_elsewhere(const fs::path& name, const Film& film,
                                        const FilmProgress& progress) {
  for (const fs::path& folder : spare_folders())
    if (const fs::path file = free_name(folder, name); try_to_write(file, film, progress).empty())
      return fs::absolute(file);
  return std::nullopt;
}

}  // namespace

FilmKeeper::FilmKeeper(const fs::path& film, std::uint64_t bytes) : reserved_(film, bytes) {}

bool FilmKeeper::write_checkpoint(const fs::path& file, const Film& film, const FilmProgress& progress) {
  reserved_.release();
  const std::string failure = try_to_write(file, film, progress);
  if (!failure.empty()) say("vitrail: no checkpoint: {}; the render continues, and tries again\n", failure);
  if (!reserved_.renew() && failure.empty())
    say("vitrail: {} is written; the disk has no room for another film beside it\n", file.string());
  return failure.empty();
}

void FilmKeeper::write_last(const fs::path& file, const Film& film, const FilmProgress& progress) {
  reserved_.release();
  std::string failure = try_to_write(file, film, progress);
  for (const auto wait : {1000ms, 4000ms}) {
    if (failure.empty()) return;
    if (stop_signal()) break;
    say("vitrail: {}; trying again in {} s\n", failure, wait / 1000ms);
    pause(wait);
    failure = try_to_write(file, film, progress);
  }
  if (failure.empty()) return;
  if (const auto place = write_elsewhere(file.filename(), film, progress))
    throw MachineError(fmt::format(
        "{}; the rendered samples are in {}: move that file to {}, and the same command continues", failure,
        place->string(), file.string()));
  throw MachineError(failure +
                     "; no other folder has room for it, and the samples after the last checkpoint are lost");
}

}  // namespace vitrail
