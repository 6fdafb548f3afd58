// SPDX-License-Identifier: Apache-2.0
// The picture of a render: what may be replaced by it, and how it is made of the film.
#pragma once

#include <functional>

#include "cli/render/render_arguments.h"
#include "farm/run/stats.h"

namespace vitrail {

// Before any work, on rank 0. Throws UsageError and MachineError where an output cannot be written, and Error
// where a picture that this suite did not make lies there (is_own_picture); not so with --force.
void check_outputs(const RenderArguments& arguments);

// Before hours of rendering. Throws MachineError where the picture is to be denoised and there is no
// denoiser.
void require_denoiser(const RenderArguments& arguments);

// What the picture takes once the film is written, measured on one core (docs/why/adaptive.md).
AfterFilm developing(const RenderArguments& arguments);

// Once the film is written: the picture, unless a kept film was finished before and its picture is newer. A
// work file of a finished render is removed then, last of all: where a job is killed between, the same
// command makes the picture of that file again. `once_written` is called before; empty: nothing is.
void write_picture_of_film(const RenderArguments& arguments, const RenderStats& stats,
                           const std::function<void()>& once_written = {});

// Of a render that was stopped: --preview, or the picture if there is none yet. Returns which; empty: none
// was written.
std::filesystem::path write_picture_so_far(const RenderArguments& arguments, const RenderStats& stats);

}  // namespace vitrail
