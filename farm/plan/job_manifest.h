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

// Returns the bundle's manifest, with the options' choices for the picture in place of the scene's. Throws
// UsageError for choices that the bundle cannot give, Error for faults of the bundle.
JobManifest read_job_manifest(const RenderOptions& options);
// Returns the same for a manifest that was read already.
JobManifest job_manifest(const RenderOptions& options, Manifest manifest);

// Returns the key of such a job's film; it depends on nothing else of the job.
FilmKey key_of(const Manifest& manifest, const PictureSettings& picture);

}  // namespace vitrail
