// SPDX-License-Identifier: Apache-2.0
#include "farm/run/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "farm/plan/ending_time.h"
#include "scene/system/say.h"

namespace vitrail {

namespace {

using Json = nlohmann::ordered_json;

ProgressManner manner_of(ProgressMode mode) {
  return mode == ProgressMode::bar     ? ProgressManner::line
         : mode == ProgressMode::lines ? ProgressManner::lines
                                       : ProgressManner::silent;
}

// Where there are several ranks: whether some drown in rays while others wait for them.
std::string waiting_text(const std::vector<RankReport>& ranks) {
  if (ranks.size() < 2) return {};
  const auto [least, most] = std::ranges::minmax_element(ranks, {}, &RankReport::waiting);
  return fmt::format("{} to {} krays wait on a rank", least->waiting / 1000, most->waiting / 1000);
}

std::vector<std::int64_t> by_rank(const Round& round, std::int64_t RankReport::*number) {
  std::vector<std::int64_t> numbers;
  for (const RankReport& rank : round.ranks) numbers.push_back(rank.*number);
  return numbers;
}

const char* word(Ending ending) {
  return ending == Ending::finished     ? "finished"
         : ending == Ending::time_is_up ? "time is up"
                                        : "interrupted";
}

}  // namespace

// Standard output, which nothing else of a render writes to. Lost where that is full or nobody reads it.
void print_event(const Json& event) {
  const std::string line = event.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  [[maybe_unused]] const ssize_t lost = ::write(STDOUT_FILENO, line.data(), line.size());
}

Progress::Progress(const RenderOptions& options, int rank, const Film& film, double samples)
    : mode_(rank == 0 ? options.outputs.progress : ProgressMode::none),
      time_limit_s_(options.resources.time_limit_s),
      pixels_(static_cast<double>(film.pixels())),
      samples_(samples),
      samples_before_(static_cast<double>(film.samples()) / pixels_),
      start_(std::chrono::steady_clock::now()),
      limit_start_(limit_start(options, start_)),
      last_(start_),
      line_(manner_of(mode_)) {}

void Progress::show(const Round& round) {
  constexpr std::chrono::seconds between_events(1);
  const auto now = std::chrono::steady_clock::now();
  if (mode_ == ProgressMode::json ? now - last_ < between_events : !line_.is_due()) return;
  last_ = now;
  print(round, std::chrono::duration<double>(now - start_).count());
}

double Progress::samples_left(const RoundSums& sums) const {
  return std::max(0.0, (samples_ - samples_before_) * pixels_ - static_cast<double>(sums.samples));
}

double Progress::until_limit_s() const {
  if (time_limit_s_ <= 0) return std::numeric_limits<double>::infinity();
  const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - limit_start_;
  return std::max(0.0, time_limit_s_ - gone.count());
}

double Progress::remaining_s(double done, double elapsed_s) const {
  const double here = done - samples_before_ / samples_;
  const double left_s = here > 0 ? elapsed_s * (1 - done) / here : 0;
  if (time_limit_s_ <= 0) return left_s;
  return here > 0 ? std::min(left_s, until_limit_s()) : until_limit_s();
}

void Progress::print(const Round& round, double elapsed_s) {
  const RoundSums& sums = round.sums;
  const double done =
      std::min(1.0, (samples_before_ + static_cast<double>(sums.samples) / pixels_) / samples_);
  const double left_s = remaining_s(done, elapsed_s);
  const double rate = elapsed_s > 0 ? static_cast<double>(sums.rays_traced) / elapsed_s : 0;
  if (mode_ == ProgressMode::json)
    return print_event({{"event", "progress"},
                        {"progress", done},
                        {"samples_per_pixel", samples_ * done},
                        {"elapsed_s", elapsed_s},
                        {"remaining_s", left_s},
                        {"rays", sums.rays_traced},
                        {"rays_waiting", sums.born - sums.died},
                        {"rays_waiting_by_rank", by_rank(round, &RankReport::waiting)},
                        {"resident_domains_by_rank", by_rank(round, &RankReport::resident)},
                        {"domain_loads", sums.domain_loads}});
  ProgressNews news{done, "render", left_s, {}};
  news.details = {fmt::format("{:.0f} of {:.0f} samples a pixel", samples_ * done, samples_),
                  fmt::format("{:.2f} Mray/s", rate * 1e-6)};
  if (const std::string waiting = waiting_text(round.ranks); !waiting.empty())
    news.details.push_back(waiting);
  line_.show(news);
}

void Progress::finish() { line_.clear(); }

namespace {

std::string text_of(const TargetError& target) {
  return fmt::format("{:g}{}", target.value, target.just_noticeable ? "jnd" : "");
}

// What the render is after.
std::string text_of(const Goal& goal) {
  std::string samples = fmt::format("{} sample{} {}", goal.samples, goal.samples == 1 ? "" : "s",
                                    goal.adaptive       ? "a pixel on the average"
                                    : goal.samples == 1 ? "a pixel"
                                                        : "each");
  if (!goal.target) return samples;
  return fmt::format("to an error of {}, at most {}", text_of(*goal.target), samples);
}

// Light that came through a window has been scattered often before it is measured. The manifest's depth has
// the sensor's own event in it.
void warn_of_depth(const RenderOptions& options, const Manifest& m) {
  constexpr int enough = 16;
  const int depth = m.settings.max_depth - 1;
  if (options.picture.sensors.empty() || options.picture.max_depth || options.outputs.quiet ||
      m.settings.direct_only || depth >= enough)
    return;
  say("vitrail: --sensors leaves out light after {} scattering events, the depth of the scene: indoors give "
      "--max-depth -1\n",
      depth);
}

}  // namespace

void print_start(const RenderOptions& options, const Manifest& m, const Goal& goal, int ranks, int threads) {
  const auto now = std::chrono::steady_clock::now();
  if (options.resources.time_limit_s > 0 && !options.outputs.quiet && !options.outputs.dry_run &&
      limit_start(options, now) > options.resources.start)
    say("vitrail: {} of --time {} went by before tracing began; tracing still gets half of it. Partition "
        "once and render the bundle to save that time\n",
        duration_in_words(std::chrono::duration<double>(now - options.resources.start).count()),
        options.resources.time_limit_s);
  warn_of_depth(options, m);
  if (options.outputs.progress != ProgressMode::lines) return;
  const PixelRect& c = m.film.crop;
  const std::string domains = m.domains.size() == 1 ? "" : fmt::format(", {} domains", m.domains.size());
  const std::string workers = fmt::format(
      "{}{} thread{}", ranks == 1 ? "" : fmt::format("{} ranks × ", ranks), threads, threads == 1 ? "" : "s");
  // A sensor is a column of pixels.
  const std::string what = options.picture.sensors.empty()
                               ? fmt::format("rendering {} × {} pixels", c.x1 - c.x0, c.y1 - c.y0)
                               : fmt::format("measuring at {} sensor{} of {} pixels", c.x1 - c.x0,
                                             c.x1 - c.x0 == 1 ? "" : "s", c.y1 - c.y0);
  say("vitrail: {}, {}{}, {}\n", what, text_of(goal), domains, workers);
}

void print_end(const RenderOptions& options, const RenderStats& s) {
  const JobOutputs& o = options.outputs;
  if (o.progress == ProgressMode::none || o.dry_run) return;
  const double samples = static_cast<double>(s.samples) / static_cast<double>(s.pixels);
  const double progress = s.ending == Ending::finished ? 1 : samples / static_cast<double>(s.spp);
  const std::uint64_t rays = s.traced.rays_camera + s.traced.rays_indirect + s.traced.rays_shadow;
  if (o.progress == ProgressMode::json) {
    Json end{{"event", "end"},        {"ending", word(s.ending)},
             {"progress", progress},  {"samples_per_pixel", samples},
             {"elapsed_s", s.wall_s}, {"remaining_s", 0},
             {"rays", rays}};
    if (!o.picture.empty()) end["picture"] = o.picture.string();
    if (o.keeps_film) end["film"] = o.film.string();
    end["film_hash"] = fmt::format("{:016x}", s.film_hash);
    return print_event(end);
  }
  if (!writes_film(s.ending)) return;
  const std::string name = (o.picture.empty() ? o.film : o.picture).string();
  if (options.picture.target_error && !s.finished_before)
    say("vitrail: error {:.3g}, in all likelihood below {:.3g}; --target-error is {}\n", s.reached.estimate,
        s.reached.upper, text_of(*options.picture.target_error));
  if (s.finished_before && o.picture.empty()) return;  // read_earlier_work has said so
  if (s.finished_before)
    say("vitrail: {}: {:.4g} samples a pixel, rendered before\n", name, samples);
  else
    say("vitrail: {}: {:.4g} of {} samples a pixel after {}, {:.2f} Mray/s, {:.0f} MiB a rank{}\n", name,
        samples, s.spp, duration_in_words(s.wall_s), static_cast<double>(rays) / s.wall_s * 1e-6,
        static_cast<double>(s.peak_rss_bytes) / 0x1p20,
        s.ending == Ending::time_is_up ? "; the same command continues" : "");
}

void print_wedges(const RenderOptions& options, const TraceCounters& traced) {
  const double share =
      static_cast<double>(traced.connections_in_wedges) / static_cast<double>(traced.connections_in_glass);
  if (options.outputs.quiet || !(share > 0.01)) return;
  say("vitrail: {:.3g} % of the sunlight through solid glass is missing: its faces are up to {:.2g} rad off "
      "parallel; --integrator photon finds it\n",
      100 * share, 1e-9 * static_cast<double>(traced.widest_wedge_nrad));
}

}  // namespace vitrail
