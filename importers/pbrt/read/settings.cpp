// SPDX-License-Identifier: Apache-2.0
// The directives that say how the picture is taken, and those of defaults and colour spaces.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "importers/pbrt/read/directives.h"
#include "scene/spectra/color.h"

namespace vitrail::pbrt {

void Interpreter::camera(const Place& place) {
  const std::string kind = read_text("a kind of camera");
  ParameterSet parameters = read_set("Camera", kind, place);
  read_camera(kind, parameters, state_.ctm, context_, view_);
  const Transform at_end = snapped(inverse(state_.ctm_end));
  coordinate_systems_["camera"] = {view_.camera_to_world, at_end};
  view_.motion = is_moving() ? motion_between(view_.camera_to_world, at_end, place) : Motion{};
  scene_.camera_origin = origin(place);
  scene_.camera_medium = state_.exterior;
}

void Interpreter::film(const Place& place) {
  const std::string kind = read_text("a kind of film");
  ParameterSet parameters = read_set("Film", kind, place);
  read_film(kind, parameters, context_, view_);
  scene_.film_origin = origin(place);
  if (state_.color_space != "srgb")
    context_.report.approximated(
        fmt::format("the film's colour space \"{}\" becomes \"srgb\"", state_.color_space), place);
}

void Interpreter::pixel_filter(const Place& place) {
  const std::string kind = read_text("a kind of filter");
  ParameterSet parameters = read_set("PixelFilter", kind, place);
  read_filter(kind, parameters, context_, view_);
}

void Interpreter::sampler(const Place& place) {
  const std::string kind = read_text("a kind of sampler");
  ParameterSet parameters = read_set("Sampler", kind, place);
  read_sampler(kind, parameters, context_, view_);
  scene_.sampler_origin = origin(place);
}

void Interpreter::integrator(const Place& place) {
  const std::string kind = read_text("a kind of integrator");
  ParameterSet parameters = read_set("Integrator", kind, place);
  read_integrator(kind, parameters, context_, view_);
  scene_.integrator_origin = origin(place);
  integrator_place_ = place;
}

void Interpreter::report_integrator() {
  context_.report.begin_item(integrator_place_, RecordKind::integrator);
  // Without the directive v3 takes "path", v4 "volpath".
  const bool is_default = view_.integrator.name.empty();
  const std::string name = is_default && context_.version == Version::v3 ? "path" : view_.integrator.name;
  if (!context_.all_media && passes_media_by(name) && leave_out_media(scene_))
    context_.report.dropped(fmt::format("media: {}integrator \"{}\" ignores them, in pbrt as here; "
                                        "\"volpath\" or --all-media shows them",
                                        is_default ? "pbrt-v3's default " : "", name),
                            integrator_place_);
  if (!context_.all_media && context_.version == Version::v4 && passes_media_by(name) &&
      has_subsurface(scene_))
    context_.report.approximated(fmt::format("light scatters below surfaces here: integrator \"{}\" ignores "
                                             "that in pbrt-v4, and \"volpath\" shows it",
                                             name),
                                 integrator_place_);
  for (const std::string& difference : settle_integrator(view_.integrator, scene_))
    context_.report.approximated(difference, integrator_place_);
}

// No accelerator changes the picture.
void Interpreter::accelerator(const Place& place) {
  const std::string kind = read_text("a kind of accelerator");
  read_set("Accelerator", kind, place);
}

void Interpreter::option(const Place& place) {
  for (const Parameter& parameter : read_options(tokens_, context_.report))
    for (const char* name : {"disablepixeljitter", "disablewavelengthjitter", "disabletexturefiltering",
                             "forcediffuse", "pixelstats", "msereferenceimage"})
      if (parameter.name == name && parameter.numbers != std::vector<double>{0})
        context_.report.dropped(fmt::format("option \"{}\" has no effect", name), place);
}

void Interpreter::color_space(const Place& place) {
  std::string name = read_text("the name of a colour space");
  try {
    to_srgb({}, name.c_str());
  } catch (const Error& error) {
    fail(error.what(), place);
  }
  state_.color_space = std::move(name);
}

void Interpreter::attribute(const Place& place) {
  const std::string target = read_text("what the attribute is for");
  std::vector<Parameter> parameters = read_parameters(tokens_, context_.report);
  constexpr std::array<const char*, 5> targets{"shape", "light", "material", "medium", "texture"};
  if (std::find(targets.begin(), targets.end(), target) == targets.end())
    fail(fmt::format("expected shape, light, material, medium or texture, found \"{}\"", target), place);
  std::map<std::string, std::vector<Parameter>> defaults;
  if (state_.defaults) defaults = *state_.defaults;
  for (Parameter& parameter : parameters) {
    parameter.from_attribute = true;
    defaults[target].push_back(std::move(parameter));
  }
  state_.defaults =
      std::make_shared<const std::map<std::string, std::vector<Parameter>>>(std::move(defaults));
}

}  // namespace vitrail::pbrt
