// SPDX-License-Identifier: Apache-2.0
// This file checks a list of frames before the first of them is rendered.
#pragma once

#include <functional>
#include <span>

#include "cli/render/frames.h"
#include "cli/render/other_camera.h"
#include "cli/render/render_arguments.h"
#include "farm/run/work_words.h"

namespace vitrail {

// A FrameList has the frames that a command renders.
struct FrameList {
  std::filesystem::path file;
  std::size_t count = 0;  // of the whole list
  std::vector<ListedFrame> frames;
  std::vector<std::filesystem::path> outputs;  // of these
};

// Reads the list, and takes of it what --range names. Throws UsageError where --frames does not go
// with the other options, and Error.
FrameList read_frame_list(const RenderArguments& command);

// Checks each frame against the bundle: its options, the names of lights, materials and glass, its camera,
// and the place of its output. Calls `visit` with each that can be rendered, and with what it is to be. Says
// of the first ten others what is wrong, with line and column; then throws Error. It runs on rank 0 alone.
void check_frames(const FrameList& list, const RenderArguments& command, std::span<char* const> typed,
                  KnownViews& views,
                  const std::function<void(std::size_t frame, const WorkWords& asked)>& visit);

}  // namespace vitrail
