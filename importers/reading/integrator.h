// SPDX-License-Identifier: Apache-2.0
// These functions map the integrators of other renderers to Vitrail's.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/records/scene.h"

namespace vitrail {

// An AskedIntegrator is the integrator that a scene asks for.
struct AskedIntegrator {
  enum class Kind {
    paths,       // from the camera, with connections to lights: the same picture
    both_ends,   // paths from lamps too, of all or some of the light: bidirectional, Metropolis
    from_lamps,  // these alone: what the camera sees by mirrors is dark
    by_chance,   // paths that find lamps only where they meet them
    photons,     // progressive photon mapping
    photon_map,  // of one pass
    direct,      // light at the first surface that is no mirror
    first_hit,   // the same at the first surface, whatever it is
    other,       // another picture, or not known
  };
  std::string name;  // empty: the scene has none
  Kind kind = Kind::paths;
  std::string suggestion{};  // "; did you mean …?"
};

// It is a name of a format's integrators, with its kind.
using NamedIntegrator = std::pair<std::string_view, AskedIntegrator::Kind>;

// Returns the integrator of that name, of those that are `known`. Any other name gives `other`, with the
// nearest of these names and of `also_named`, if one is near.
AskedIntegrator asked_for(const std::string& name, std::span<const NamedIntegrator> known,
                          const std::vector<std::string>& also_named = {});

// Returns how the picture differs from that of the integrator, once the scene is read. It turns photon
// mapping into path tracing where there are media, which photons do not cross here.
std::vector<std::string> settle_integrator(const AskedIntegrator& asked, Scene& scene);

// Takes the media away from shapes and the camera, for integrators that ignore them. Returns false where none
// had one.
bool leave_out_media(Scene& scene);

}  // namespace vitrail
