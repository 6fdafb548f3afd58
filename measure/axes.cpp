// SPDX-License-Identifier: Apache-2.0
#include "measure/axes.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/diagnostics.h"

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
      {"depth", "most scattering events of a path (--max-depth)", depths()},
      {"clamp", "the most that one connection adds to a sample (--clamp)", clamps(facts.mean_luminance)},
      {"integrator", "whole paths or direct light alone (--integrator)",
       render_choices("--integrator", {"direct"})},
      {"decimate", "the part of each mesh's triangles that stays (--decimate)",
       partition_choices("--decimate", {"0.3", "0.1"})},
      {"domains", "sub-domains of the bundle (partition --domains)",
       partition_choices("--domains", {"1", "8", "32"}), true},
      {"memory", "most memory a rank may use (--memory)", render_choices("--memory", {"256M", "64M"}), true,
       true},
  };
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
