// SPDX-License-Identifier: Apache-2.0
#include "measure/axes.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

Choice as_the_scene_says() { return {"as the scene", {}, {}}; }

// `option` with each of the words, given to `render`.
std::vector<Choice> render_choices(const std::string& option, const std::vector<std::string>& words) {
  std::vector<Choice> choices{as_the_scene_says()};
  for (const std::string& word : words) choices.push_back({word, {option, word}, {}});
  return choices;
}

std::vector<Choice> depths() {
  std::vector<Choice> choices = render_choices("--max-depth", {"-1", "12", "6", "3", "2", "1"});
  choices[1].label = "none";  // no limit
  return choices;
}

std::vector<Choice> partition_choices(const std::string& option, const std::vector<std::string>& words) {
  std::vector<Choice> choices{as_the_scene_says()};
  for (const std::string& word : words) choices.push_back({word, {}, {option, word}});
  return choices;
}

// Its first round is a quarter of the samples: where those are few it knows too little.
std::vector<Choice> adaptive() {
  constexpr int least_spp = 64;
  return {as_the_scene_says(), {"on", {"--adaptive"}, {}, least_spp}};
}

std::vector<Choice> clamps(double mean_luminance) {
  std::vector<Choice> choices{as_the_scene_says()};
  for (const int times : {64, 16, 4}) {
    const std::string value = fmt::format("{:.3g}", times * mean_luminance);
    choices.push_back({value, {"--clamp", value}, {}});
  }
  return choices;
}

}  // namespace

std::vector<Axis> known_axes(const PictureFacts& facts) {
  return {
      {"depth", "most scattering events of a path (--max-depth)", depths(), Effect::bias},
      {"clamp", "the most light that one connection adds to a sample (--clamp)", clamps(facts.mean_luminance),
       Effect::bias},
      {"integrator", "whole paths or direct light alone (--integrator)",
       render_choices("--integrator", {facts.is_direct ? "path" : "direct"}), Effect::bias},
      {"decimate", "the part of each mesh's triangles that stays (--decimate)",
       partition_choices("--decimate", {"0.3", "0.1"}), Effect::bias},
      {"rgb", "how RGB colours become spectra (partition --rgb)", partition_choices("--rgb", {"matrix-r"}),
       Effect::bias},
      {"textures", "textures without blur, or without smoothing between texels (--texture-filter)",
       render_choices("--texture-filter", {"none", "nearest"}), Effect::bias},
      {"filter", "the pixel filter (--filter)",
       render_choices("--filter", {"box:0.5", "triangle:1", "gaussian:1.5", "mitchell:2"}), Effect::bias},
      {"adaptivity", "more samples where the picture is noisy (--adaptive)", adaptive(), Effect::noise},
      {"roulette", "when paths may end by chance (--roulette)",
       render_choices("--roulette", {"early", "never"}), Effect::noise},
      {"wavelengths", "of a path (--wavelengths)", render_choices("--wavelengths", {"1"}), Effect::noise},
      {"lights", "how lamps are chosen (--light-sampling)", render_choices("--light-sampling", {"power"}),
       Effect::noise},
      {"candidates", "points on lamps to compare before a connection (--light-candidates)",
       render_choices("--light-candidates", {"1", "2", "8"}), Effect::noise},
      {"domains", "sub-domains of the bundle (partition --domains)",
       partition_choices("--domains", {"1", "8", "32"}), Effect::nothing},
      {"memory", "most memory a rank may use (--memory)", render_choices("--memory", {"256M", "64M"}),
       Effect::nothing, true},
  };
}

const char* name_of(Effect effect) {
  return effect == Effect::nothing ? "nothing" : effect == Effect::noise ? "noise" : "bias";
}

std::vector<std::string> axis_names() {
  std::vector<std::string> names;
  for (const Axis& axis : known_axes({})) names.push_back(axis.name);
  return names;
}

std::vector<Axis> chosen_axes(const std::vector<Axis>& known, const std::vector<std::string>& names) {
  std::vector<Axis> chosen;
  for (const Axis& axis : known)
    if (names.empty() || std::ranges::find(names, axis.name) != names.end()) chosen.push_back(axis);
  for (const std::string& name : names)
    if (std::ranges::find(known, name, &Axis::name) == known.end())
      throw UsageError(
          fmt::format("there is no axis '{}'; there are {}", name, fmt::join(axis_names(), ", ")));
  return chosen;
}

std::string name_of(const std::vector<Axis>& axes, const Setting& setting) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (setting[i] > 0) parts.push_back(axes[i].name + ' ' + axes[i].choices[setting[i]].label);
  return parts.empty() ? "as the scene says" : fmt::format("{}", fmt::join(parts, ", "));
}

Effect effect_of(const std::vector<Axis>& axes, const Setting& setting) {
  Effect greatest = Effect::nothing;
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (setting[i] > 0) greatest = std::max(greatest, axes[i].effect);
  return greatest;
}

bool limits_memory(const std::vector<Axis>& axes, const Setting& setting) {
  bool any = false;
  for (std::size_t i = 0; i < axes.size(); ++i) any = any || (setting[i] > 0 && axes[i].limits_memory);
  return any;
}

int least_spp(const std::vector<Axis>& axes, const Setting& setting) {
  int least = 1;
  for (std::size_t i = 0; i < axes.size(); ++i)
    least = std::max(least, axes[i].choices[setting[i]].least_spp);
  return least;
}

namespace {

std::vector<std::string> joined(const std::vector<Axis>& axes, const Setting& setting,
                                std::vector<std::string> Choice::*of) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < axes.size(); ++i)
    for (const std::string& word : axes[i].choices[setting[i]].*of) words.push_back(word);
  return words;
}

}  // namespace

std::vector<std::string> render_arguments(const std::vector<Axis>& axes, const Setting& setting) {
  return joined(axes, setting, &Choice::render);
}

std::vector<std::string> partition_arguments(const std::vector<Axis>& axes, const Setting& setting) {
  return joined(axes, setting, &Choice::partition);
}

}  // namespace vitrail
