// SPDX-License-Identifier: Apache-2.0
#include "measure/words.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "measure/biases.h"
#include "measure/recommend.h"

namespace vitrail {

namespace {

std::string with_error(const Estimate& e, double times = 1) {
  return fmt::format("{:.3g} ± {:.2g}", times * e.value, times * e.half_width);
}

std::string megabytes(double bytes) { return fmt::format("{:.0f}", bytes / (1 << 20)); }

// "1.8 times as fast", "1.2 times as slow", "as fast".
std::string speed(double own_s, double s) {
  const double ratio = own_s / s;
  if (ratio > 1.05) return fmt::format("{:.2f} times as fast", ratio);
  if (ratio < 1 / 1.05) return fmt::format("{:.2f} times as slow", 1 / ratio);
  return "as fast";
}

std::string brightness(const Estimate& luminance) {
  const char* word = luminance.value < 0 ? "darker" : "brighter";
  return fmt::format("{} by {:.2g} % ± {:.2g} %", word, 100 * std::abs(luminance.value),
                     100 * luminance.half_width);
}

}  // namespace

std::string what_it_buys(const Measurement& m, const MeasuredSetting& s) {
  if (!s.failure.empty()) return s.name + ": cannot be rendered here: " + s.failure;
  const MeasuredSetting& own = m.settings[0];
  const std::string times = speed(own.sample_s, s.sample_s);
  if (s.identical)
    return fmt::format("{}: the same picture, bit for bit; {}, {} MiB at most instead of {}", s.name, times,
                       megabytes(s.peak_memory_bytes), megabytes(own.peak_memory_bytes));
  std::string text = fmt::format("{}: a sample is {}", s.name, times);
  if (s.spp != own.spp) text = fmt::format("{}, of {} samples: one is {}", s.name, s.spp, times);
  const double own_noise = predicted_error({own.error.noise.value, 0, own.spp, 1}, m.law, s.spp);
  if (own_noise > 0 && s.error.noise.value > 0) {
    const double noise = s.error.noise.value / own_noise;
    text += fmt::format(", its noise is {:.2g} times as much", noise);
    const double efficiency = own.sample_s / (s.sample_s * noise);
    text += fmt::format(": {:.2g} times the efficiency while bias does not matter", efficiency);
  } else {
    text += s.error.noise.value > 0 ? ", and it is noisy" : ", and no noise is seen";
  }
  if (s.effect == Effect::noise) return text + "; its mean is the same";
  const Estimate& light = s.error.luminance;
  if (!s.error.is_biased() && std::abs(light.value) > light.half_width)
    return text + "; it is " + brightness(light);
  if (!s.error.is_biased()) return text + "; no bias is seen";
  text += fmt::format("; bias {} ({})", with_error(s.error.bias), brightness(s.error.luminance));
  return text + fmt::format(", which no samples remove: not for a relMSE below {:.2g}", s.error.bias.value);
}

std::vector<std::string> findings(const Measurement& m) {
  const MeasuredSetting& own = m.settings[0];
  std::vector<std::string> lines;
  lines.push_back(
      fmt::format("The reference has 2 × {} samples and paths of any length. It is itself off by a relMSE of "
                  "{:.2g}, which is taken out of the other errors.",
                  m.reference_spp, m.reference.relmse));
  lines.push_back(fmt::format("Noise falls as samples^−{:.2f} here.", m.law.slope));
  if (own.error.is_biased() || judge(own.error.luminance, m.most_bias) == LightVerdict::beyond)
    lines.push_back(fmt::format("The scene's own setting has a bias of {} against paths of any length ({}).",
                                with_error(own.error.bias), brightness(own.error.luminance)));
  else
    lines.push_back(fmt::format("The scene's own setting shows no bias above {:.2g}.",
                                std::max(0.0, own.error.bias.value) + own.error.bias.half_width));
  lines.push_back(fmt::format(
      "The whole picture has {:.2f} times as many pixels. A sample of each of them takes {:.3g} CPU "
      "seconds, and there were {:.1f} CPU seconds a second.",
      m.full_size, own.sample_s * m.full_size, m.parallelism));
  if (own.farm.is_known())
    lines.push_back(fmt::format(
        "The whole picture at its {} samples would take about {:.2g} s on a cluster of {} × {} cores "
        "(vitrail plan; --ranks, --threads).",
        m.scene_spp, own.farm(m.scene_spp), m.farm.ranks, m.farm.threads));
  return lines;
}

std::string advice(const Recommendation& r) {
  if (!r.found)
    return fmt::format("For {}: none of the settings reaches it{}.", r.goal,
                       r.bound_counts
                           ? fmt::format(" whose mean light is surely within {:.3g} % of that of whole "
                                         "paths; --bias allows more",
                                         100 * r.most_bias)
                           : "");
  std::string options = fmt::format("--spp {}", r.spp);
  for (const auto* words : {&r.render, &r.partition})
    for (const std::string& word : *words) options += ' ' + word;
  std::string text =
      fmt::format("For {}: render {} — a relMSE of {} in {:.3g} CPU seconds, {:.3g} s here ({}).", r.goal,
                  options, with_error({r.error, r.error_within}), r.cpu_s, r.wall_s, r.name);
  const double beyond = static_cast<double>(r.spp) / r.rendered_spp;
  if (beyond > most_unrendered_factor || beyond < 1 / most_unrendered_factor)
    text += fmt::format(
        " Beware: it was rendered with {} samples, and the error is extrapolated from there; a longer "
        "--budget "
        "renders it.",
        r.rendered_spp);
  constexpr double share = 0.3;
  if (r.bias_within > share * r.error)
    text += fmt::format(" Beware: its bias is known to ± {:.2g} only; more --seeds or --spp know better.",
                        r.bias_within);
  if (r.farm_s > 0) text += fmt::format(" On the cluster: about {:.2g} s.", r.farm_s);
  if (r.bias > 0) text += fmt::format(" {:.3g} of it is bias.", r.bias);
  if (r.luminance.value != 0 || r.luminance.half_width > 0)
    text += fmt::format(" It is {}.", brightness(r.luminance));
  return text;
}

std::vector<bool> front(const Measurement& m) {
  std::vector<double> cost, error;
  constexpr double never = std::numeric_limits<double>::infinity();
  for (const MeasuredSetting& s : m.settings) {
    const bool comparable = s.failure.empty() && s.spp == m.settings[0].spp;
    cost.push_back(comparable ? s.sample_s * s.spp : never);
    error.push_back(comparable ? s.error.relmse.value : never);
  }
  std::vector<bool> on_it = pareto_front(cost, error);
  for (std::size_t i = 0; i < on_it.size(); ++i)
    if (cost[i] == never) on_it[i] = false;
  return on_it;
}

std::string table(const Measurement& m) {
  const auto line = [](auto&&... cells) {
    return fmt::format("{:2}{:<28}{:>5}{:>9}{:>9}{:>19}{:>19}{:>19}{:>20}{:>9}{:>8}{:>8}{:>9}\n", cells...);
  };
  std::string text = line("", "setting", "spp", "cpu s", "Mrays", "relMSE", "noise", "bias", "light %",
                          "FLIP", "ΔE00", "MiB", "farm s");
  const std::vector<bool> on_it = front(m);
  const auto put = [&](std::size_t i) {
    const MeasuredSetting& s = m.settings[i];
    if (!s.failure.empty()) {
      text += fmt::format("  {:<28}cannot be rendered here: {}\n", s.name, s.failure);
      return;
    }
    text += line(on_it[i] ? "*" : "", s.name, s.spp, fmt::format("{:.3g}", s.sample_s * s.spp),
                 fmt::format("{:.3g}", s.rays / 1e6), with_error(s.error.relmse), with_error(s.error.noise),
                 with_error(s.error.bias), with_error(s.error.luminance, 100),
                 fmt::format("{:.3g}", s.error.flip.value), fmt::format("{:.3g}", s.error.delta_e.value),
                 megabytes(s.peak_memory_bytes),
                 s.farm.is_known() ? fmt::format("{:.2g}", s.farm(m.scene_spp)) : "");
  };
  for (const bool biased : {false, true}) {
    if (biased) text += "  settings that may bias the picture:\n";
    for (std::size_t i = 0; i < m.settings.size(); ++i)
      if ((m.settings[i].effect == Effect::bias) == biased) put(i);
  }
  return text +
         "±: 95 %; *: no other of as many samples is better in both time and error; farm s: the whole "
         "picture on "
         "the cluster\n";
}

}  // namespace vitrail
