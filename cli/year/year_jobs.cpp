// SPDX-License-Identifier: Apache-2.0
#include "cli/year/year_jobs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <csignal>

#include "bundle/manifest.h"
#include "cli/common/main_guard.h"
#include "cli/common/switching_glazing.h"
#include "cli/render/job_limits.h"
#include "farm/files/signals.h"
#include "farm/render.h"
#include "farm/run/checkpoint.h"
#include "farm/transport/agreement.h"
#include "film/develop.h"
#include "scene/daylight/given_sky.h"
#include "scene/records/render_settings.h"
#include "scene/system/say.h"
#include "scene/system/terminal.h"

namespace vitrail {

namespace {

constexpr CoefficientKind kinds[] = {CoefficientKind::sky, CoefficientKind::reflected, CoefficientKind::beams,
                                     CoefficientKind::sunlight};

constexpr const char* name_of(CoefficientKind kind) {
  switch (kind) {
    case CoefficientKind::sky:
      return "sky";
    case CoefficientKind::reflected:
      return "reflected";
    case CoefficientKind::beams:
      return "beam";
    case CoefficientKind::sunlight:
      return "sunlight";
  }
  return "";
}

ProgressMode progress_mode(const YearArguments& a) {
  if (a.quiet || a.progress == "none") return ProgressMode::none;
  if (a.progress == "auto") return on_terminal() ? ProgressMode::bar : ProgressMode::lines;
  return a.progress == "bar" ? ProgressMode::bar : ProgressMode::lines;
}

// What all films of a state have in common.
RenderOptions options_of(Transport& transport, const YearArguments& a, const YearState& state) {
  RenderOptions o;
  o.bundle = state.bundle;
  o.resources = a.resources;
  o.outputs.command = a.command, o.outputs.force = a.force, o.outputs.quiet = true;
  o.outputs.progress = progress_mode(a);
  PictureSettings& picture = o.picture;
  picture.sensors = a.sensors, picture.seed = a.seed;
  picture.integrator = Integrator::path;
  picture.max_depth = a.max_depth < 0 ? unlimited_depth : a.max_depth;
  picture.glazing = fmt::format("{}", fmt::join(state.settings, " "));
  std::vector<std::string> glazing;
  for (const std::string& text : state.settings) {
    if (is_scene_edit(text))
      picture.edits.push_back(parse_scene_edit(text));
    else
      glazing.push_back(text);
  }
  picture.edits.push_back(lamps_off());
  agree_on_root(transport, [&] {
    if (!glazing.empty())
      picture.sheets = sheets_under(parse_settings(glazing), o.bundle, read_manifest(o.bundle));
  });
  share_from_root(transport, picture.sheets);
  take_limits_of_job(transport, o);
  return o;
}

// An even number, so that the error is known.
int even(double samples) { return std::max(2, 2 * static_cast<int>(std::ceil(samples / 2))); }

void trace(Transport& transport, const YearArguments& a, RenderOptions o, const YearState& state,
           CoefficientKind kind, double share) {
  o.outputs.film = film_of(a, state.name, kind);
  // The sun alone differs between the samples of an hour by their wavelengths, and at the edges of shadows.
  constexpr int beam_samples = 16;
  const std::size_t rows = o.picture.daylight->count();
  o.picture.samples_per_pixel =
      even(share * (kind == CoefficientKind::sky         ? a.sky_paths / static_cast<double>(rows)
                    : kind == CoefficientKind::reflected ? a.sun_paths
                    : kind == CoefficientKind::beams     ? beam_samples
                                                         : 2));
  if (kind == CoefficientKind::beams || kind == CoefficientKind::sunlight) o.picture.max_depth = 0;
  if (transport.rank() == 0 && !a.quiet)
    say("vitrail: {}, state {}: {} {}\n", name_of(kind), state.name, rows,
        kind == CoefficientKind::sky        ? "patches"
        : kind == CoefficientKind::sunlight ? "minutes of a day"
                                            : "hours of sun");
  const RenderStats stats = render(transport, o);
  agree(transport, [&] { require_unsaturated(stats.refused, o.outputs.film); });
  if (stats.ending == Ending::interrupted || stats.ending == Ending::terminated)
    throw Interrupted(
        stats.ending == Ending::terminated ? SIGTERM : SIGINT,
        fmt::format("stopped; {} holds what was traced, and the same command continues", a.output.string()));
}

}  // namespace

std::filesystem::path film_of(const YearArguments& a, const std::string& state, CoefficientKind kind) {
  if (kind == CoefficientKind::sunlight)
    return a.output / fmt::format("{}.sunlight-{}-{:g}.film", state, a.sun_day, a.sun_above_deg);
  return a.output / fmt::format("{}.{}.film", state, name_of(kind));
}

bool has_films(const YearArguments& a) {
  return std::ranges::any_of(states_of(a), [&](const YearState& state) {
    return std::ranges::any_of(kinds, [&](CoefficientKind kind) {
      const std::filesystem::path film = film_of(a, state.name, kind);
      return std::filesystem::exists(film) || std::filesystem::exists(checkpoint_path(film));
    });
  });
}

SkyFrame sky_frame(const YearArguments& a, const Manifest& manifest) {
  const SkyLight* given = nullptr;
  for (const Light& light : manifest.lights)
    if (const auto* sky = std::get_if<SkyLight>(&light.model)) given = sky;
  if (given && a.up.empty() && a.north.empty())
    return {DirectionFrame(given->light_to_world), "up and north are those of the bundle's sky"};
  const std::string up_name = a.up.empty() ? "z" : a.up, north_name = a.north.empty() ? "y" : a.north;
  const Vector3d up = axis_of(up_name), north = axis_of(north_name), east = cross(north, up);
  if (!(length(east) > 0))
    throw UsageError(fmt::format("--up {} and --north {} are along one axis", up_name, north_name));
  SkyFrame sky;
  sky.frame.x = east, sky.frame.y = north, sky.frame.z = up;
  sky.words = fmt::format("up is {}{}, north is {}{}", up_name, a.up.empty() ? " (assumed; --up)" : "",
                          north_name, a.north.empty() ? " (assumed; --north)" : "");
  return sky;
}

void trace_coefficients(Transport& transport, const YearArguments& a, const SkyFrame& sky,
                        const TracedSuns& suns, double share) {
  const std::vector<YearState> states = states_of(a);
  for (const YearState& state : states) {
    RenderOptions o;
    agree(transport, [] {
      if (stop_signal()) throw Interrupted(stop_signal(), "interrupted before tracing began");
    });
    o = options_of(transport, a, state);
    for (const CoefficientKind kind : kinds) {
      DaylightRows rows;
      rows.sky = sky.frame;
      if (kind == CoefficientKind::sky)
        rows.patches.emplace(a.division);
      else if (kind != CoefficientKind::sunlight)
        for (const Vector3d to_sun : suns.hours) rows.suns.push_back(sky.frame.to_world(to_sun));
      else if (&state == &states[suns.state_of_minutes])
        for (const Vector3d to_sun : suns.minutes) rows.suns.push_back(sky.frame.to_world(to_sun));
      rows.reflected_alone = kind == CoefficientKind::reflected;
      if (!rows.any()) continue;
      o.picture.daylight = std::move(rows);
      trace(transport, a, o, state, kind, share);
    }
  }
}

}  // namespace vitrail
