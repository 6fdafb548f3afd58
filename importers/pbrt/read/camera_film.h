// SPDX-License-Identifier: Apache-2.0
// These functions read the directives before WorldBegin that say how the picture is taken.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "importers/pbrt/read/context.h"
#include "importers/pbrt/read/lens_file.h"
#include "importers/pbrt/read/parameters.h"
#include "importers/reading/integrator.h"
#include "scene/records/scene.h"

namespace vitrail::pbrt {

// It is the lens system of the realistic camera. Its film is at the camera's place.
struct LensSystem {
  std::vector<LensSurface> surfaces;
  double focus_distance = 10;  // from the film, in the scene's units, which are metres
  bool by_area = true;         // see FocussedLens
  Place place;
};

// They hold what Camera, Film, PixelFilter, Sampler and Integrator said. The camera's screen depends on the
// film's resolution and the film's exposure on the camera's shutter, so both are completed at the end.
struct ViewSettings {
  enum class Projection { perspective, orthographic, spherical };
  bool has_camera = false;
  Projection projection = Projection::perspective;
  SphericalCamera::Projection sphere = SphericalCamera::Projection::equal_area;
  Transform camera_to_world;
  Motion motion;  // of it
  Lens lens;
  double fov_deg = 90, frame_aspect = 0;  // 0: the film's
  std::optional<ScreenWindow> window;
  double exposure_s = 1;
  Shutter shutter;
  std::optional<LensSystem> lens_system;

  FilmSettings film;
  double film_diagonal_mm = 35;
  double exposure = 1;  // iso / 100, or v3's film scale
  RenderSettings render;
  AskedIntegrator integrator{};
  std::optional<int> iterations{};  // of photons, each a sample of every pixel; empty: the sampler's samples
};

// Returns the defaults of a version.
ViewSettings default_view(Version version);

void read_camera(const std::string& kind, ParameterSet& parameters, const Transform& ctm, Context& context,
                 ViewSettings& view);
void read_film(const std::string& kind, ParameterSet& parameters, Context& context, ViewSettings& view);
void read_filter(const std::string& kind, ParameterSet& parameters, Context& context, ViewSettings& view);
void read_sampler(const std::string& kind, ParameterSet& parameters, Context& context, ViewSettings& view);
void read_integrator(const std::string& kind, ParameterSet& parameters, Context& context, ViewSettings& view);
// Returns whether pbrt's integrator of this name ignores media: it takes the space between surfaces for
// vacuum.
bool passes_media_by(const std::string& integrator);
bool has_subsurface(const Scene& scene);

// Puts camera, film and settings into the scene. Throws Error for a lens that cannot be focussed.
void apply(const ViewSettings& view, Scene& scene);

}  // namespace vitrail::pbrt
