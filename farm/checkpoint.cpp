// SPDX-License-Identifier: Apache-2.0
#include "farm/checkpoint.h"

#include <fmt/format.h>

#include <array>
#include <cstdio>

#include "farm/agreement.h"

namespace vitrail {

std::filesystem::path checkpoint_path(const std::filesystem::path& film) {
  std::filesystem::path path = film;
  path += ".partial";
  return path;
}

void write_job_film(Transport& transport, const std::filesystem::path& file, Film& film,
                    std::vector<std::uint64_t>& done, const WorkPlan& plan, double render_time_s) {
  transport.sum_to_root(film.sums());
  transport.sum_to_root(film.counts());
  Refused& refused = film.refused();
  std::array<std::int64_t, 2> counts{static_cast<std::int64_t>(refused.nonfinite),
                                     static_cast<std::int64_t>(refused.too_large)};
  transport.sum_to_root(std::span<std::int64_t>(counts));
  refused = {static_cast<std::uint64_t>(counts[0]), static_cast<std::uint64_t>(counts[1])};
  // Each item is done by one rank: the sum of their bits is their union.
  transport.sum_to_root(std::span(reinterpret_cast<std::int64_t*>(done.data()), done.size()));
  agree(transport, [&] {
    if (transport.rank() == 0) write_film(file, film, {plan.items(), plan.samples, done, render_time_s});
  });
}

namespace {

std::string mismatch(const Film& read, const FilmProgress& progress, const Film& film, const WorkPlan& plan) {
  const std::string what = difference(read, film);
  if (!what.empty()) return "its picture is not that of this render: " + what;
  if (read.key().seed != film.key().seed) return fmt::format("its seed is {}", read.key().seed);
  if (progress.samples_per_pixel != plan.samples || progress.items != plan.items())
    return fmt::format("it has {} samples a pixel, not {}", progress.samples_per_pixel, plan.samples);
  return {};
}

}  // namespace

Resumed read_checkpoint(Transport& transport, const std::filesystem::path& file, Film& film,
                        const WorkPlan& plan) {
  Resumed resumed;
  resumed.done.resize((plan.items() + 63) / 64);
  agree(transport, [&] {
    if (transport.rank() != 0) return;
    if (!std::filesystem::exists(file)) {
      fmt::print(stderr, "vitrail: there is no checkpoint {}; starting from the beginning\n", file.string());
      return;
    }
    FilmProgress progress;
    const Film read = read_film(file, &progress);
    const std::string reason = mismatch(read, progress, film, plan);
    if (!reason.empty()) throw Error("this checkpoint cannot be resumed: " + reason, {file.string()});
    film.merge(read);
    resumed.done = progress.done;
    resumed.render_time_s = progress.render_time_s;
  });
  transport.broadcast_from_root(resumed.done);
  return resumed;
}

}  // namespace vitrail
