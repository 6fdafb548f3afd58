// SPDX-License-Identifier: Apache-2.0
#include "farm/run/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "farm/run/work_words.h"
#include "farm/transport/agreement.h"
#include "film/film_progress.h"
#include "scene/records/pixel_place.h"
#include "scene/system/say.h"

namespace vitrail {

std::filesystem::path checkpoint_path(const std::filesystem::path& film) {
  std::filesystem::path path = film;
  return film.extension() == ".work" ? path.replace_extension(".partial") : path += ".partial";
}

FilmProgress progress_of(const WorkPlan& plan, const std::vector<std::uint64_t>& done, double render_time_s,
                         const std::string& about) {
  FilmProgress progress{plan.items(), plan.samples(), done, render_time_s, {}, about, false, {}};
  if (plan.adaptive()) {
    const auto pixels = plan.held.size();
    progress.samples_per_pixel = (plan.all_samples() + pixels - 1) / pixels;
    progress.adaptive = true;
    progress.more = plan.more;
    if (!progress.complete()) return progress;
    progress.items = 0;
    progress.done.clear(), progress.more.clear();
    return progress;
  }
  for (std::size_t i = 0; i + 1 < plan.parts.size(); ++i) progress.earlier_ends.push_back(plan.parts[i].end);
  if (!progress.complete() || progress.earlier_ends.empty()) return progress;
  progress.items = make_work_plan(plan.crop, plan.samples(), {}, plan.one_by_one).items();
  progress.done = all_done(progress.items);
  progress.earlier_ends.clear();
  return progress;
}

void gather_film(Transport& transport, Film& film, std::vector<std::uint64_t>& done) {
  // By parts of the size that the transport's own have, so that ranks whose films lie elsewhere go along.
  FilmScratch* const scratch = film.scratch().get();
  const auto sum = [&](auto part) { transport.sum_to_root(part); };
  in_parts(film.sums(), scratch, sum);
  in_parts(film.counts(), scratch, sum);
  in_parts(film.ids(), scratch, [&](auto part) { transport.max_to_root(part); });
  in_parts(film.mattes(), scratch, sum);
  Refused& refused = film.refused();
  std::array<std::int64_t, 2> counts{static_cast<std::int64_t>(refused.nonfinite),
                                     static_cast<std::int64_t>(refused.too_large)};
  transport.sum_to_root(std::span<std::int64_t>(counts));
  refused = {static_cast<std::uint64_t>(counts[0]), static_cast<std::uint64_t>(counts[1])};
  // Each item is done by one rank: the sum of their bits is their union.
  transport.sum_to_root(std::span(reinterpret_cast<std::int64_t*>(done.data()), done.size()));
}

namespace {

struct Held {
  std::filesystem::path file;
  Film film;
  FilmProgress progress;
};

// The samples that each pixel had before the adaptive round that the film is in: its own, less what the items
// give that are done. Empty: it holds less than these.
std::vector<std::uint32_t> held_before(const Film& film, const FilmProgress& p) {
  const WorkPlan round = make_adaptive_round(film.crop(), std::vector<std::uint32_t>(film.pixels()), p.more);
  std::vector<std::uint32_t> held(film.pixels());
  for (std::uint32_t i = 0; i < film.pixels(); ++i) held[i] = static_cast<std::uint32_t>(film.samples(i));
  const PixelRect& crop = film.crop();
  for (std::uint64_t i = 0; i < round.items(); ++i) {
    if (!(p.done[i / 64] >> (i % 64) & 1)) continue;
    const WorkItem item = round.item(i);
    for (int y = item.pixels.y0; y < item.pixels.y1; ++y)
      for (int x = item.pixels.x0; x < item.pixels.x1; ++x) {
        const WorkPlan::Range given = round.samples(item, x, y);
        std::uint32_t& left = held[pixel_place(x - crop.x0, y - crop.y0, film.width())];
        if (left < given.end - given.first) return {};
        left -= given.end - given.first;
      }
  }
  return held;
}

// Whether the items that a film says it has are those of its plan.
bool makes_sense(const Held& held) {
  const FilmProgress& p = held.progress;
  if (p.adaptive) {
    if (p.more.empty()) return p.items == 0;
    return p.items == make_adaptive_round(held.film.crop(), {}, p.more).items() &&
           !held_before(held.film, p).empty();
  }
  return p.samples_per_pixel > 0 &&
         p.items == make_work_plan(held.film.crop(), static_cast<std::uint32_t>(p.samples_per_pixel),
                                   p.earlier_ends, held.film.key().photons.photons > 0)
                        .items();
}

double samples_of_a_pixel(const Film& film) {
  return static_cast<double>(film.samples()) / static_cast<double>(film.pixels());
}

// The job that is begun; its film is empty.
struct Asked {
  const RenderOptions& options;
  const Film& film;
  const Goal& goal;
  const std::string& about;
};

// In what this is other work than what is asked for: "depth: 3, this command has 4; …"; "" where it is the
// same.
std::string differences(const Held& held, const Asked& asked) {
  const FilmProgress& p = held.progress;
  std::string text = differences(words_of_work(held.film.key(), held.film.settings(), p.about),
                                 words_of_work(asked.film.key(), asked.film.settings(), asked.about));
  const auto add = [&](const std::string& what) { text += (text.empty() ? "" : "; ") + what; };
  if (text.empty()) text = difference(held.film, asked.film);
  if (p.samples_per_pixel > asked.goal.samples)
    add(fmt::format("samples a pixel: {}, this command has {}", p.samples_per_pixel, asked.goal.samples));
  if (p.adaptive && !asked.goal.adaptive)
    add("samples: adaptive, this command has the same number everywhere (--adaptive continues it)");
  if (text.empty() && !makes_sense(held)) text = "it does not say which samples it holds";
  return text;
}

// Whether the film is a work file that is worth nothing any more.
bool picture_was_written(const std::filesystem::path& file, const JobOutputs& o) {
  std::error_code none, no_film;
  const auto written = std::filesystem::last_write_time(o.picture, none);
  return !o.keeps_film && file == o.film && !none &&
         written >= std::filesystem::last_write_time(file, no_film);
}

std::optional<Held> held_by(const std::filesystem::path& file, const char* kind, const Asked& asked) {
  if (!std::filesystem::exists(file)) return std::nullopt;
  constexpr const char* ways_out = "; --force replaces it, and another name for the output keeps it";
  Held held{file, {}, {}};
  try {
    held.film = read_film(file, &held.progress, asked.film.scratch());
  } catch (const Error& e) {
    throw Error(std::string(e.what()) + ways_out, e.location);
  }
  const std::string reason = differences(held, asked);
  if (reason.empty()) return held;
  const JobOutputs& o = asked.options.outputs;
  if (held.film.samples() == 0 || o.dry_run || picture_was_written(file, o)) return std::nullopt;
  throw Error(fmt::format("this {} cannot be resumed. Its {:.4g} samples a pixel would be lost: {}{}", kind,
                          samples_of_a_pixel(held.film), reason, ways_out),
              {file.string()});
}

// The plan that a film's items are of, with what is to be added at once.
WorkPlan plan_of(const Held& held, const Goal& goal) {
  const FilmProgress& p = held.progress;
  const PixelRect& crop = held.film.crop();
  if (p.adaptive) {
    // Between two rounds: nothing is left of the last one.
    const bool between = p.more.empty();
    std::vector<std::uint32_t> more = between ? std::vector<std::uint32_t>(held.film.pixels()) : p.more;
    FilmProgress last = p;
    last.more = more;
    return make_adaptive_round(crop, held_before(held.film, last), std::move(more));
  }
  const auto samples = static_cast<std::uint32_t>(p.samples_per_pixel);
  std::vector<std::uint32_t> ends = p.earlier_ends;
  if (goal.in_rounds || samples == goal.samples) return make_work_plan(crop, samples, ends, goal.one_by_one);
  ends.push_back(samples);
  return make_work_plan(crop, goal.samples, ends, goal.one_by_one);
}

bool finished(const Held& held, const RenderOptions& options, const Goal& goal) {
  if (!held.progress.complete() || held.file != options.outputs.film) return false;
  return goal.in_rounds ? !next_round(held.film, goal) : held.progress.samples_per_pixel == goal.samples;
}

void say_what_is_held(const EarlierWork& work, const Held& held, const RenderOptions& options,
                      const Goal& goal) {
  const double samples = samples_of_a_pixel(held.film);
  if (work.finished && options.outputs.keeps_film)
    say("vitrail: {} is finished already, with {:.4g} samples a pixel; --force renders it again\n",
        options.outputs.film.string(), samples);
  else if (!work.finished)
    say("vitrail: going on from {}, with {:.4g} of {} samples a pixel\n", held.file.string(), samples,
        goal.samples);
}

// Rank 0's plan and bits, on every rank.
void broadcast(Transport& transport, EarlierWork& work, const Goal& goal) {
  WorkPlan& plan = work.plan;
  std::array<std::uint64_t, 4> sizes{plan.parts.size(), plan.more.size(), work.done.size(), work.finished};
  transport.broadcast_from_root(sizes);
  std::vector<std::uint32_t> ends;
  for (const WorkPlan::Part& part : plan.parts) ends.push_back(part.end);
  ends.resize(sizes[0]);
  plan.held.resize(sizes[1]), plan.more.resize(sizes[1]), work.done.resize(sizes[2]);
  transport.broadcast_from_root(std::span(ends));
  transport.broadcast_from_root(std::span(plan.held));
  transport.broadcast_from_root(std::span(plan.more));
  transport.broadcast_from_root(std::span(work.done));
  work.finished = sizes[3] != 0;
  if (sizes[1] > 0) {
    plan = make_adaptive_round(plan.crop, std::move(plan.held), std::move(plan.more));
  } else {
    const std::uint32_t samples = ends.back();
    ends.pop_back();
    plan = make_work_plan(plan.crop, samples, ends, goal.one_by_one);
  }
}

}  // namespace

EarlierWork read_earlier_work(Transport& transport, const RenderOptions& options, Film& film,
                              const Goal& goal, const std::string& about) {
  EarlierWork work;
  work.plan = make_work_plan(film.crop(), goal.first_samples(film.pixels()), {}, goal.one_by_one);
  if (options.outputs.force) return work;
  agree(transport, [&] {
    if (transport.rank() != 0) return;
    const std::filesystem::path checkpoint = checkpoint_path(options.outputs.film);
    // One of them in memory at a time.
    const Asked asked{options, film, goal, about};
    std::optional<Held> held = held_by(checkpoint, "checkpoint", asked);
    if (std::filesystem::exists(options.outputs.film)) {
      const std::uint64_t samples = held ? held->film.samples() : 0;
      held.reset();
      held = held_by(options.outputs.film, "film", asked);
      if (!held || held->film.samples() < samples) {
        held.reset();
        held = held_by(checkpoint, "checkpoint", asked);
      }
    }
    if (!held) {
      if (options.outputs.resume && !options.outputs.quiet)
        say("vitrail: there is no checkpoint {}; starting from the beginning\n", checkpoint.string());
      return;
    }
    work.plan = plan_of(*held, goal);
    work.done = held->progress.done;
    work.done.resize((work.plan.items() + 63) / 64);
    work.render_time_s = held->progress.render_time_s;
    work.finished = finished(*held, options, goal);
    if (!options.outputs.quiet) say_what_is_held(work, *held, options, goal);
    film = std::move(held->film);
  });
  broadcast(transport, work, goal);
  return work;
}

}  // namespace vitrail
