// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bundle/manifest.h"
#include "farm/plan/rounds.h"

namespace vitrail {

// Makes sure that all ranks of a job render one picture of one bundle by one build. Called by all together,
// with what each has read; where one differs from rank 0 all throw UsageError, saying in what.
void expect_same_job(Transport& transport, const Manifest& manifest, const FilmKey& key, const Goal& goal,
                     const Homes& homes, const RenderOptions& options);

}  // namespace vitrail
