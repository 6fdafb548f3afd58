// SPDX-License-Identifier: Apache-2.0
#include "cli/common/mesh_options.h"

#include <fmt/format.h>

namespace vitrail {

void declare_mesh_options(CLI::App& app, MeshOptions& o) {
  app.add_option("--tessellate", o.tessellate,
                 "make meshes of spheres, cylinders, disks, cones and paraboloids, with this many segments "
                 "for a full turn")
      ->check(CLI::Range(3, 4096));
  app.add_flag("--repair", o.repair,
               "merge equal vertices; remove unused ones and triangles that are degenerate or duplicates");
  app.add_flag("--orient", o.orient,
               "turn the triangles of each surface to one side, those of closed surfaces outwards");
  app.add_option("--subdivide", o.subdivide, "refine meshes by this many levels of Loop's subdivision")
      ->check(CLI::Range(0, 8));
  app.add_option("--decimate", o.decimate, "keep about this fraction of each mesh's triangles, for previews")
      ->check([](const std::string& text) {
        double fraction = 0;
        const bool fine = CLI::detail::lexical_cast(text, fraction) && fraction > 0 && fraction <= 1;
        return fine ? "" : "has to be more than 0 and at most 1: " + text;
      });
}

std::vector<std::string> arguments_of(const MeshOptions& o) {
  std::vector<std::string> arguments;
  if (o.tessellate > 0) arguments.insert(arguments.end(), {"--tessellate", std::to_string(o.tessellate)});
  if (o.repair) arguments.push_back("--repair");
  if (o.orient) arguments.push_back("--orient");
  if (o.subdivide > 0) arguments.insert(arguments.end(), {"--subdivide", std::to_string(o.subdivide)});
  if (o.decimate < 1) arguments.insert(arguments.end(), {"--decimate", fmt::format("{}", o.decimate)});
  return arguments;
}

}  // namespace vitrail
