// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>

#include "cli/render/check_frames.h"
#include "farm/plan/options.h"

namespace vitrail {

// Tells the user of rank 0 how far a list is: by a line before each frame, or by an event of JSON.
class FrameProgress {
 public:
  FrameProgress(const FrameList& list, const RenderArguments& command);

  // Sets how many frames are done by now, here or elsewhere. Frames that were done at the first
  // call took no time of this command.
  void done(std::size_t frames);

  // Call it before the frame is rendered.
  void begins(std::size_t i);
  // Says what becomes of a frame that is not rendered: "is there and stays".
  void says(std::size_t i, const std::string& what) const;

 private:
  std::string place(std::size_t i) const;  // "frame 7 of 50: f0007.png"
  double left_s() const;                   // negative: not known yet

  const FrameList& list_;
  bool quiet_, json_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::optional<std::size_t> before_;
  std::size_t done_ = 0;
};

}  // namespace vitrail
