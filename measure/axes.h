// SPDX-License-Identifier: Apache-2.0
// Axes are what can be traded: each is a setting of the programs with a few values of it.
#pragma once

#include <string>
#include <vector>

namespace vitrail {

// A Choice is one value of an axis, as arguments of `render` and of what makes the bundle from the scene.
struct Choice {
  std::string label;
  std::vector<std::string> render, partition;
  int least_spp = 1;  // of fewer samples a pixel it is nothing else than the first
};

// An Effect is what a change may do to the pictures. It does nothing (law 1: it changes time and memory
// alone), changes their noise and keeps their mean, or changes the mean, which no samples bring back.
enum class Effect { nothing, noise, bias };
const char* name_of(Effect effect);

struct Axis {
  std::string name, about;
  std::vector<Choice> choices;  // the first: as the scene says
  Effect effect = Effect::bias;
  bool limits_memory = false;  // too little of it is a finding, no failure of the machine
};

// PictureFacts are what the values of the axes depend on.
struct PictureFacts {
  double mean_luminance = 1;
  bool is_direct = false;  // of direct light alone, as the scene says
};

// Returns all axes. One more axis is one more line of this function.
std::vector<Axis> known_axes(const PictureFacts& facts);
std::vector<std::string> axis_names();

// Returns the axes of these names, or all where `names` is empty. Throws UsageError for unknown ones.
std::vector<Axis> chosen_axes(const std::vector<Axis>& known, const std::vector<std::string>& names);

// A Setting holds the index of a choice for each axis.
using Setting = std::vector<std::size_t>;

// Returns "depth 4, clamp 16", or "as the scene says" where every choice is the first.
std::string name_of(const std::vector<Axis>& axes, const Setting& setting);
// They return the greatest effect of the choices that are not the first, and the least samples.
Effect effect_of(const std::vector<Axis>& axes, const Setting& setting);
int least_spp(const std::vector<Axis>& axes, const Setting& setting);
bool limits_memory(const std::vector<Axis>& axes, const Setting& setting);
std::vector<std::string> render_arguments(const std::vector<Axis>& axes, const Setting& setting);
std::vector<std::string> partition_arguments(const std::vector<Axis>& axes, const Setting& setting);

}  // namespace vitrail
