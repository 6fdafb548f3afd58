// SPDX-License-Identifier: Apache-2.0
#include "cli/render/frame_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "cli/common/command_line.h"
#include "cli/help/describe.h"
#include "farm/transport/agreement.h"

namespace vitrail {

FrameJob::FrameJob(std::span<char* const> typed, std::span<const ListedFrame::Word> line,
                   const std::filesystem::path& output) {
  declare(app_, arguments_);
  let_the_last_count(app_);
  std::vector<std::string> words(typed.begin() + 1, typed.end());
  for (const ListedFrame::Word& word : line) words.push_back(word.text);
  words.insert(words.end(), {"-o", output.string()});
  arguments_.options.outputs.command = fmt::format("vitrail render {}", fmt::join(words, " "));
  words = as_parsed(app_, words);
  std::ranges::reverse(words);
  app_.parse(words);
}

WorkWords FrameJob::words(const Manifest& manifest, KnownViews& views) {
  RenderArguments& a = arguments_;
  interpret(app_, a);
  a.options.bundle = a.input;
  complete_picture(a, manifest, views);
  WorkWords work = words_of_work(a.options, manifest);
  work.fields.emplace_back("--denoise", a.denoised ? "yes" : "no");
  return work;
}

std::optional<int> FrameJob::render(Transport& transport,
                                    const std::function<bool(const RenderArguments&)>& may_begin,
                                    const JobSteps& steps) {
  agree(transport, [&] { interpret(app_, arguments_); });
  std::array<std::uint64_t, 1> begins{};
  agree(transport, [&] {
    if (transport.rank() == 0) begins[0] = may_begin(arguments_);
  });
  transport.broadcast_from_root(std::span<std::uint64_t>(begins));
  if (begins[0] == 0) return std::nullopt;
  return render_locked(transport, arguments_, steps);
}

}  // namespace vitrail
