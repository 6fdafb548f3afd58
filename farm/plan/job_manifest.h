// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "bundle/manifest.h"
#include "farm/plan/options.h"
#include "film/film.h"

namespace vitrail {

struct JobManifest {
  Manifest manifest;
  std::optional<Point3d> replaced_camera;  // RenderScene's
};

// The bundle's manifest, with what the options ask of the picture in place of what the scene says. Throws
// UsageError for what the bundle cannot give, Error for what is wrong with it.
JobManifest read_job_manifest(const RenderOptions& options);
// The same of a manifest that was read already.
JobManifest job_manifest(const RenderOptions& options, Manifest manifest);

// Of the film of such a job: nothing else of it counts.
FilmKey key_of(const Manifest& manifest, const PictureSettings& picture);

}  // namespace vitrail
