// SPDX-License-Identifier: Apache-2.0
// This file makes a render's picture of its film, and checks what that may replace.
#pragma once

#include <functional>

#include "cli/render/render_arguments.h"
#include "farm/run/stats.h"

namespace vitrail {

// Call it first, on rank 0. Throws UsageError and MachineError where an output cannot be written. Throws
// Error where a picture lies there that this suite did not make (is_own_picture), unless --force is given.
void check_outputs(const RenderArguments& arguments);

// Call it before hours of rendering. Throws MachineError where the picture is to be
// denoised and there is no denoiser.
void require_denoiser(const RenderArguments& arguments);

// Returns what the picture takes once the film is written, as measured on one core (docs/why/adaptive.md).
AfterFilm developing(const RenderArguments& arguments);

// Writes the picture of a written film, unless a kept film was finished before and its picture is newer. A
// work file of a finished render is removed last of all. Where a job is killed between, the same command
// makes the picture of that file again. `once_written` is called before that; empty means nothing is.
void write_picture_of_film(const RenderArguments& arguments, const RenderStats& stats,
                           const std::function<void()>& once_written = {});

// Writes --preview of a render that was stopped, or the picture if there is none yet. Returns which;
// empty means that none was written.
std::filesystem::path write_picture_so_far(const RenderArguments& arguments, const RenderStats& stats);

}  // namespace vitrail
