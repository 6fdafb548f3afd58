// SPDX-License-Identifier: Apache-2.0
#include "measure/session.h"

#include <algorithm>

#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

// Seeds of the reference are far from those of the settings: 1, 2, …
constexpr std::uint64_t reference_seed = 1'000'001;

// Of the reference, and of the choice of all depths, whose pictures are then rendered once.
std::vector<std::string> whole_paths(bool scene_is_direct) {
  if (scene_is_direct) return {"--max-depth", "-1", "--integrator", "path"};
  return {"--max-depth", "-1"};
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t n = values.size();
  return n == 0 ? 0 : (values[(n - 1) / 2] + values[n / 2]) / 2;
}

}  // namespace

Session::Session(Runs& runs, const MeasureOptions& options, int spp, int renders, const MeasureNews& news)
    : runs_(runs),
      options_(options),
      spp_(spp),
      renders_(renders),
      whole_(whole_paths(runs.scene_is_direct())),
      news_(news) {}

RunResult Session::run(const RunRequest& request, const std::string& what) {
  news_.progress(std::min(0.99, static_cast<double>(done_++) / renders_), what.c_str());
  RunResult result = runs_(request);
  cpu_s_ += result.cpu_s;
  wall_s_ += result.wall_s;
  return result;
}

Reference Session::reference(int spp) {
  const std::uint64_t seed = reference_seed + options_.first_seed - 1;
  Image first = run({whole_, {}, spp, seed}, "reference").picture;
  return make_reference(std::move(first), run({whole_, {}, spp, seed + 1}, "reference").picture);
}

const std::vector<Image>& Session::unbiased_pictures(int spp) {
  std::vector<Image>& pictures = unbiased_[spp];
  for (int seed = static_cast<int>(pictures.size()); seed < options_.seeds; ++seed)
    // With a profile where the setting of the same arguments has one, so that they are one render.
    pictures.push_back(run({whole_,
                            {},
                            spp,
                            options_.first_seed + static_cast<std::uint64_t>(seed),
                            seed == 0 && options_.farm.ranks > 0},
                           "all depths")
                           .picture);
  return pictures;
}

RunRequest Session::request(const Measurement& m, const Setting& setting, int spp, int seed) const {
  return {render_arguments(m.axes, setting), partition_arguments(m.axes, setting), spp,
          options_.first_seed + static_cast<std::uint64_t>(seed) - 1, seed == 1 && options_.farm.ranks > 0};
}

MeasuredSetting Session::measure_setting(const Measurement& m, const Setting& setting, int spp) {
  return measure_setting(m, setting, spp, Beside::unbiased);
}

MeasuredSetting Session::check(const Measurement& m, const MeasuredSetting& known, int spp) {
  const Estimate bias = known.error.bias, luminance = known.error.luminance;
  const double before_s = wall_s_;
  MeasuredSetting s = measure_setting(m, known.setting, spp, Beside::reference);
  checks_s_ += wall_s_ - before_s;
  s.error.luminance = luminance;
  if (bias.half_width < s.error.bias.half_width) s.error.bias = bias;
  return s;
}

int Session::checkable(const MeasuredSetting& s, int wanted_spp) const {
  const double a_sample_s = options_.seeds * s.sample_s / parallelism();
  const double affordable = (options_.budget_s - checks_s_) / a_sample_s;
  return static_cast<int>(std::clamp(affordable, 0.0, static_cast<double>(wanted_spp)));
}

MeasuredSetting Session::measure_setting(const Measurement& m, const Setting& setting, int asked_spp,
                                         Beside beside) {
  MeasuredSetting s;
  s.setting = setting;
  s.name = name_of(m.axes, setting);
  s.effect = effect_of(m.axes, setting);
  s.least_spp = least_spp(m.axes, setting);
  s.spp = std::max(asked_spp, s.least_spp);
  s.again = std::ranges::find(m.settings, setting, &MeasuredSetting::setting) != m.settings.end();
  const bool own = s.changes() == 0;
  const int seeds = s.effect == Effect::nothing && !own ? 1 : options_.seeds;
  s.identical = !own && s.spp == spp_;  // until a seed shows that it is not
  std::vector<Image> pictures;
  std::vector<double> sample_s;
  for (int seed = 1; seed <= seeds; ++seed) {
    std::optional<RunResult> r = try_run(m, s, seed);
    if (!r) return s;
    sample_s.push_back(sample_time_s(r->cpu_s - m.law.start_s, s.spp, r->picture.pixels()));
    add_run(s, *r, seed);
    pictures.push_back(std::move(r->picture));
  }
  s.sample_s = median(sample_s);
  s.first = pictures[0];
  s.mean = mean_picture(pictures);
  find_error(m, s, pictures, beside);
  return s;
}

// What a machine cannot do ends the measurement, but for memory that was made scarce on purpose: then empty,
// and the setting has a `failure`.
std::optional<RunResult> Session::try_run(const Measurement& m, MeasuredSetting& s, int seed) {
  try {
    return run(request(m, s.setting, s.spp, seed), s.name);
  } catch (const Error& e) {
    s.failure = e.what();
  } catch (const MachineError& e) {
    if (!limits_memory(m.axes, s.setting)) throw;
    s.failure = e.what();
  }
  return std::nullopt;
}

// What a seed's render took, and whether its picture is that of the scene's own setting.
void Session::add_run(MeasuredSetting& s, const RunResult& r, int seed) {
  const double count = seed;
  s.cpu_s += (r.cpu_s - s.cpu_s) / count;
  s.wall_s += (r.wall_s - s.wall_s) / count;
  s.rays = r.rays;
  s.peak_memory_bytes = std::max(s.peak_memory_bytes, r.peak_memory_bytes);
  s.bundle_bytes = r.bundle_bytes;
  const bool own = s.changes() == 0;
  if (own && s.spp == spp_) {
    own_pictures_.push_back(r.picture);
    if (seed == 1) own_hash_ = r.film_hash;
  }
  s.identical = s.identical && r.picture == own_pictures_[static_cast<std::size_t>(seed - 1)];
  if (s.effect == Effect::nothing && !own && r.film_hash != own_hash_)
    throw Error("the film of '" + s.name +
                "' is another than that of the scene's own setting: it must not be");
}

// By the setting's pictures, of a seed each. Where they are those of the scene's own setting, so is all else.
void Session::find_error(const Measurement& m, MeasuredSetting& s, const std::vector<Image>& pictures,
                         Beside beside) {
  if (s.identical && !m.settings.empty()) {
    s.error = m.settings[0].error;
    s.mean = m.settings[0].mean;
    if (s.effect != Effect::nothing) s.sample_s = m.settings[0].sample_s;  // the same work
    return;
  }
  const bool noise_alone = s.effect == Effect::noise && !m.settings.empty();
  std::span<const Image> unbiased;
  if (!noise_alone && pictures.size() >= 2 && beside == Beside::unbiased) unbiased = unbiased_pictures(s.spp);
  s.error = error_statistics(pictures, m.reference, unbiased);
  // Its mean is that of the scene's own setting.
  if (noise_alone) s.error.bias = m.settings[0].error.bias, s.error.luminance = m.settings[0].error.luminance;
}

// By a plan of a job that the simulator is done with soon: its efficiency, with the CPU seconds that all
// seeds took. What is lost at the ends of a job does not grow with it; what is lost to the network or to
// loading does.
FarmTime Session::plan_farm(const Measurement& m, const MeasuredSetting& s) {
  constexpr double most_samples = 3e6;  // of pixels
  news_.progress(0.99, "the cluster");
  const double pixels = static_cast<double>(s.first.width) * s.first.height;
  const double spp = std::min(std::max<double>(most_samples / pixels, s.spp), m.full_size * m.scene_spp);
  const PlannedJob job = runs_.plan_job(request(m, s.setting, s.spp, 1), options_.farm, spp / s.spp);
  if (!(job.efficiency > 0)) return {};
  const double work_s = s.sample_s / (options_.farm.ranks * options_.farm.threads),
               lost = 1 / job.efficiency - 1;
  const bool grows = job.limit == "network" || job.limit == "loading";
  return {grows ? 0 : work_s * spp * lost, m.full_size * work_s * (grows ? 1 + lost : 1)};
}

void Session::measure_axes(Measurement& m) {
  const Setting own(m.axes.size(), 0);
  m.settings.push_back(measure_setting(m, own, spp_));
  if (!m.settings[0].failure.empty()) throw Error("the scene cannot be rendered: " + m.settings[0].failure);
  for (std::size_t axis = 0; axis < m.axes.size(); ++axis)
    for (std::size_t choice = 1; choice < m.axes[axis].choices.size(); ++choice) {
      Setting changed = own;
      changed[axis] = choice;
      m.settings.push_back(measure_setting(m, changed, spp_));
    }
}

void Session::measure_samples(Measurement& m) {
  const Setting own(m.axes.size(), 0);
  std::vector<double> counts, noise;
  for (const int spp : {std::max(1, spp_ / 4), spp_, 4 * spp_}) {
    if (!counts.empty() && spp == static_cast<int>(counts.back())) continue;
    m.samples.push_back(spp == spp_ ? m.settings[0] : measure_setting(m, own, spp));
    counts.push_back(spp);
    noise.push_back(m.samples.back().error.noise.value);
  }
  m.law.slope = fitted_slope(counts, noise);
}

}  // namespace vitrail
