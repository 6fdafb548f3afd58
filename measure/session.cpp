// SPDX-License-Identifier: Apache-2.0
#include "measure/session.h"

#include <algorithm>

#include "scene/diagnostics.h"

namespace vitrail {

namespace {

// Seeds of the reference are far from those of the settings: 1, 2, …
constexpr std::uint64_t reference_seed = 1'000'001;

double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t n = values.size();
  return n == 0 ? 0 : (values[(n - 1) / 2] + values[n / 2]) / 2;
}

}  // namespace

Session::Session(Runs& runs, const MeasureOptions& options, int spp, int renders, const MeasureNews& news)
    : runs_(runs), options_(options), spp_(spp), renders_(renders), news_(news) {}

RunResult Session::run(const RunRequest& request, const std::string& what) {
  news_.progress(std::min(0.99, static_cast<double>(done_++) / renders_), what.c_str());
  RunResult result = runs_(request);
  cpu_s_ += result.cpu_s;
  wall_s_ += result.wall_s;
  return result;
}

Reference Session::reference(int spp) {
  const std::uint64_t seed = reference_seed + options_.first_seed - 1;
  const std::vector<std::string> whole{"--max-depth", "-1"};
  Image first = run({whole, {}, spp, seed}, "reference").picture;
  return make_reference(std::move(first), run({whole, {}, spp, seed + 1}, "reference").picture);
}

MeasuredSetting Session::measure_setting(const Measurement& m, const Setting& setting, int spp) {
  MeasuredSetting s;
  s.setting = setting;
  s.name = name_of(m.axes, setting);
  s.spp = spp;
  bool same_picture = true, own = true, is_short_of_memory = false;
  for (std::size_t i = 0; i < setting.size(); ++i) {
    own &= setting[i] == 0;
    same_picture &= setting[i] == 0 || m.axes[i].same_picture;
    is_short_of_memory |= setting[i] > 0 && m.axes[i].limits_memory;
  }
  std::vector<Image> pictures;
  std::vector<double> sample_s;
  const int seeds = same_picture && !own ? 1 : options_.seeds;
  s.identical = !own && spp == spp_;  // until a seed shows that it is not
  for (int seed = 1; seed <= seeds; ++seed) {
    RunResult r;
    try {  // what a machine cannot do ends the measurement, but for memory that was made scarce on purpose
      r = run({render_arguments(m.axes, setting), partition_arguments(m.axes, setting), spp,
               options_.first_seed + static_cast<std::uint64_t>(seed) - 1},
              s.name);
    } catch (const Error& e) {
      s.failure = e.what();
      return s;
    } catch (const MachineError& e) {
      if (!is_short_of_memory) throw;
      s.failure = e.what();
      return s;
    }
    sample_s.push_back(std::max(1e-9, (r.cpu_s - m.law.start_s) / spp));
    const double count = seed;
    s.cpu_s += (r.cpu_s - s.cpu_s) / count;
    s.wall_s += (r.wall_s - s.wall_s) / count;
    s.rays = r.rays;
    s.peak_memory_bytes = std::max(s.peak_memory_bytes, r.peak_memory_bytes);
    s.bundle_bytes = r.bundle_bytes;
    const auto at = static_cast<std::size_t>(seed - 1);
    if (own && spp == spp_) {
      own_pictures_.push_back(r.picture);
      if (seed == 1) own_hash_ = r.film_hash;
    }
    s.identical = s.identical && r.picture == own_pictures_[at];
    if (same_picture && !own && r.film_hash != own_hash_)
      throw Error("the film of '" + s.name +
                  "' is another than that of the scene's own setting: it must not be");
    pictures.push_back(std::move(r.picture));
  }
  s.sample_s = median(sample_s);
  s.first = pictures[0];
  s.mean = mean_picture(pictures);
  if (s.identical && !m.settings.empty()) {
    s.error = m.settings[0].error;
    s.mean = m.settings[0].mean;
    if (!same_picture) s.sample_s = m.settings[0].sample_s;  // the same work
  } else {
    s.error = error_statistics(pictures, m.reference);
  }
  return s;
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
