// SPDX-License-Identifier: Apache-2.0
// These options change meshes on their way: --tessellate,
// --repair, --orient, --subdivide, --decimate.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "scene/records/scene.h"

namespace vitrail {

struct MeshResources;  // partitioner/meshes/edit_meshes.h

struct MeshOptions {
  int tessellate = 0;  // segments of a full turn; 0: quadrics stay quadrics
  bool repair = false, orient = false;
  int subdivide = 0;    // levels
  double decimate = 1;  // fraction of the triangles to keep
  bool any() const { return tessellate > 0 || edits_meshes(); }
  bool edits_meshes() const { return repair || orient || subdivide > 0 || decimate < 1; }
};

void declare_mesh_options(CLI::App& app, MeshOptions& options);

// Returns the same options, for another program of the suite.
std::vector<std::string> arguments_of(const MeshOptions& options);

// Changes the scene as the options ask and says so on standard error; does nothing without options. Returns
// notes on what it did, which --strict does not refuse.
Diagnostics apply_mesh_options(const MeshOptions& options, Scene& scene, const MeshResources& resources,
                               bool to_render);

}  // namespace vitrail
