// SPDX-License-Identifier: Apache-2.0
#include "cli/render/frame_progress.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "farm/run/progress.h"
#include "scene/system/progress_line.h"
#include "scene/system/say.h"

namespace vitrail {

FrameProgress::FrameProgress(const FrameList& list, const RenderArguments& command)
    : list_(list), quiet_(command.quiet), json_(command.progress == "json") {}

void FrameProgress::done(std::size_t frames) {
  if (!before_) before_ = frames;
  done_ = frames;
}

double FrameProgress::left_s() const {
  const std::size_t here = done_ - before_.value_or(done_);
  if (here == 0) return -1;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  return elapsed.count() / static_cast<double>(here) * static_cast<double>(list_.frames.size() - done_);
}

std::string FrameProgress::place(std::size_t i) const {
  const std::size_t all = list_.frames.size();
  const std::string number = all == list_.count
                                 ? fmt::format("{} of {}", list_.frames[i].number, all)
                                 : fmt::format("{} ({} of {})", list_.frames[i].number, i + 1, all);
  return fmt::format("frame {}: {}", number, list_.outputs[i].string());
}

void FrameProgress::begins(std::size_t i) {
  const double left = left_s();
  if (json_) {
    nlohmann::ordered_json event{{"event", "frame"},
                                 {"frame", list_.frames[i].number},
                                 {"output", list_.outputs[i].string()},
                                 {"frames", list_.frames.size()},
                                 {"frames_done", done_}};
    if (left >= 0) event["remaining_s"] = left;
    print_event(event);
  }
  if (!quiet_)
    say("vitrail: {}{}\n", place(i), left < 0 ? "" : fmt::format("; about {} left", duration_in_words(left)));
}

void FrameProgress::says(std::size_t i, const std::string& what) const {
  if (!quiet_) say("vitrail: {} {}\n", place(i), what);
}

}  // namespace vitrail
