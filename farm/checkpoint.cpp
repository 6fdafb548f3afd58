// SPDX-License-Identifier: Apache-2.0
#include "farm/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "farm/agreement.h"

namespace vitrail {

std::filesystem::path checkpoint_path(const std::filesystem::path& film) {
  std::filesystem::path path = film;
  path += ".partial";
  return path;
}

namespace {

// A film that is whole does not say in which steps it became so.
FilmProgress progress_of(const WorkPlan& plan, const std::vector<std::uint64_t>& done, double render_time_s,
                         const std::string& about) {
  FilmProgress progress{plan.items(), plan.samples(), done, render_time_s, {}, about};
  for (std::size_t i = 0; i + 1 < plan.parts.size(); ++i) progress.earlier_ends.push_back(plan.parts[i].end);
  if (!progress.complete() || progress.earlier_ends.empty()) return progress;
  const std::uint64_t items = make_work_plan(plan.crop, plan.samples()).items();
  progress.items = items;
  progress.done.assign((items + 63) / 64, ~std::uint64_t{0});
  if (items % 64 != 0) progress.done.back() = (std::uint64_t{1} << items % 64) - 1;
  progress.earlier_ends.clear();
  return progress;
}

}  // namespace

void write_job_film(Transport& transport, const std::filesystem::path& file, Film& film,
                    std::vector<std::uint64_t>& done, const WorkPlan& plan, double render_time_s,
                    const std::string& about) {
  transport.sum_to_root(film.sums());
  transport.sum_to_root(film.counts());
  transport.max_to_root(film.ids());
  Refused& refused = film.refused();
  std::array<std::int64_t, 2> counts{static_cast<std::int64_t>(refused.nonfinite),
                                     static_cast<std::int64_t>(refused.too_large)};
  transport.sum_to_root(std::span<std::int64_t>(counts));
  refused = {static_cast<std::uint64_t>(counts[0]), static_cast<std::uint64_t>(counts[1])};
  // Each item is done by one rank: the sum of their bits is their union.
  transport.sum_to_root(std::span(reinterpret_cast<std::int64_t*>(done.data()), done.size()));
  agree(transport, [&] {
    if (transport.rank() == 0) write_film(file, film, progress_of(plan, done, render_time_s, about));
  });
}

namespace {

struct Held {
  std::filesystem::path file;
  Film film;
  FilmProgress progress;
};

// Why this is not work of the job whose film is `film`; "" where it is.
std::string mismatch(const Held& held, const Film& film, std::uint32_t samples) {
  const FilmProgress& p = held.progress;
  const std::string what = difference(held.film, film);
  if (!what.empty()) return "its picture is not that of this render: " + what;
  if (held.film.key().seed != film.key().seed)
    return fmt::format("its seed is {}, not {}", held.film.key().seed, film.key().seed);
  if (p.samples_per_pixel > samples)
    return fmt::format("it holds more work: it is a render of {} samples a pixel, not {}, and {}",
                       p.samples_per_pixel, samples, p.complete() ? "finished" : "begun");
  if (p.samples_per_pixel == 0 ||
      p.items != make_work_plan(film.crop(), static_cast<std::uint32_t>(p.samples_per_pixel), p.earlier_ends)
                     .items())
    return "it does not say which samples it holds";
  return {};
}

std::optional<Held> held_by(const std::filesystem::path& file, const char* kind, const Film& film,
                            std::uint32_t samples) {
  if (!std::filesystem::exists(file)) return std::nullopt;
  constexpr const char* ways_out = "; --force replaces it, and another name for the output keeps it";
  Held held{file, {}, {}};
  try {
    held.film = read_film(file, &held.progress);
  } catch (const Error& e) {
    throw Error(std::string(e.what()) + ways_out, e.location);
  }
  const std::string reason = mismatch(held, film, samples);
  if (!reason.empty())
    throw Error(fmt::format("this {} cannot be resumed: {}{}", kind, reason, ways_out), {file.string()});
  return held;
}

double samples_of_a_pixel(const Film& film) {
  return static_cast<double>(film.samples()) / static_cast<double>(film.pixels());
}

}  // namespace

EarlierWork read_earlier_work(Transport& transport, const RenderOptions& options, Film& film,
                              std::uint32_t samples) {
  EarlierWork work;
  if (options.force) return work;
  agree(transport, [&] {
    if (transport.rank() != 0) return;
    const std::filesystem::path checkpoint = checkpoint_path(options.film);
    std::optional<Held> held = held_by(options.film, "film", film, samples);
    std::optional<Held> partial = held_by(checkpoint, "checkpoint", film, samples);
    if (partial && (!held || partial->film.samples() > held->film.samples())) held = std::move(partial);
    if (!held) {
      if (options.resume && !options.quiet)
        fmt::print(stderr, "vitrail: there is no checkpoint {}; starting from the beginning\n",
                   checkpoint.string());
      return;
    }
    const FilmProgress& p = held->progress;
    work.ends = p.earlier_ends;
    if (p.samples_per_pixel < samples) work.ends.push_back(static_cast<std::uint32_t>(p.samples_per_pixel));
    work.done = p.done;
    work.done.resize((make_work_plan(film.crop(), samples, work.ends).items() + 63) / 64);
    work.render_time_s = p.render_time_s;
    work.finished = p.complete() && p.samples_per_pixel == samples && held->file == options.film;
    film.merge(held->film);
    if (options.quiet) return;
    if (work.finished)
      fmt::print(stderr,
                 "vitrail: {} is finished already, with {} samples a pixel; --force renders it again\n",
                 options.film.string(), samples);
    else
      fmt::print(stderr, "vitrail: going on from {}, with {:.4g} of {} samples a pixel\n",
                 held->file.string(), samples_of_a_pixel(film), samples);
  });
  std::array<std::uint64_t, 3> sizes{work.ends.size(), work.done.size(), work.finished};
  transport.broadcast_from_root(sizes);
  std::vector<std::uint64_t> ends(work.ends.begin(), work.ends.end());
  ends.resize(sizes[0]);
  transport.broadcast_from_root(ends);
  work.ends.assign(ends.begin(), ends.end());
  work.done.resize(sizes[1]);
  transport.broadcast_from_root(work.done);
  work.finished = sizes[2] != 0;
  return work;
}

}  // namespace vitrail
