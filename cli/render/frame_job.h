// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "bundle/manifest.h"
#include "cli/render/frames.h"
#include "cli/render/render_job.h"
#include "farm/run/work_words.h"

namespace vitrail {

// A FrameJob is the job of one frame, by the words of the command and those of its line. An object
// serves one of its functions, once.
class FrameJob {
 public:
  // `typed` has the command's words, its name first. Throws CLI::ParseError.
  FrameJob(std::span<char* const> typed, std::span<const ListedFrame::Word> line,
           const std::filesystem::path& output);

  // Returns, on one rank alone, what the picture is to be, and checks that the bundle can give it. Throws
  // UsageError and Error. `manifest` is the bundle's.
  WorkWords words(const Manifest& manifest, KnownViews& views);

  // Interprets the words, then asks `may_begin` on rank 0, where all ranks wait for the answer. Renders if
  // that is yes; else returns nothing. The exit status is render_job's.
  std::optional<int> render(Transport& transport,
                            const std::function<bool(const RenderArguments&)>& may_begin,
                            const JobSteps& steps);

 private:
  CLI::App app_{"a frame", "vitrail render"};
  RenderArguments arguments_;
};

}  // namespace vitrail
