// SPDX-License-Identifier: Apache-2.0
#include "cli/render/check_frames.h"

#include <fmt/format.h>

#include "cli/common/main_guard.h"
#include "cli/render/frame_job.h"
#include "cli/render/frame_range.h"
#include "farm/files/signals.h"
#include "scene/system/output_place.h"
#include "scene/system/say.h"

namespace vitrail {

namespace fs = std::filesystem;

namespace {

void require_command_of_frames(const RenderArguments& a) {
  if (!a.is_bundle())
    throw UsageError(
        "--frames takes a bundle: vitrail partition makes one of the scene, once for all frames");
  if (!a.film.empty())
    throw UsageError(
        "--frames keeps a film for each picture: leave out --film, or let --output end in %04d.film");
  if (a.output.extension() != ".film" && a.output.parent_path().string().find('%') != std::string::npos)
    throw UsageError("--frames numbers the names of pictures, not their folders: " + a.output.string());
}

std::string in_words(const Error& e) {
  const std::string place = to_string(e.location);
  return place.empty() ? e.what() : fmt::format("{}: {}", place, e.what());
}

class Checker {
 public:
  Checker(const FrameList& list, const RenderArguments& command, std::span<char* const> typed,
          KnownViews& views)
      : list_(list), typed_(typed), views_(views), manifest_(read_manifest(command.input)) {}

  WorkWords words(std::size_t i) {
    require_options_of_frames(list_.frames[i], list_.file);
    return words(i, list_.frames[i].words);
  }

  std::string file() const { return list_.file.string(); }

  // Of a scene that cannot be read, which the program that reads it has said.
  Error of_camera(std::size_t i) const {
    const ListedFrame& frame = list_.frames[i];
    int column = frame.words.front().column;
    for (const ListedFrame::Word& word : frame.words)
      if (word.text.starts_with("--camera")) column = word.column;
    return Error("the scene of this camera cannot be read", {file(), frame.line, column}, frame.text);
  }

  // What the line does wrong. Throws it where the command does so without the line.
  Error of_line(std::size_t i, const std::string& message, const std::exception_ptr& failure) {
    const ListedFrame& frame = list_.frames[i];
    if (message_with(i, {}) == message) std::rethrow_exception(failure);
    int column = frame.words.front().column;
    for (std::size_t k = 0; k < frame.words.size(); ++k) {
      if (is_option(frame.words[k].text)) column = frame.words[k].column;
      const bool ends = k + 1 == frame.words.size() || is_option(frame.words[k + 1].text);
      if (ends && !message_with(i, std::span(frame.words).first(k + 1)).empty()) break;
    }
    return Error(message, {file(), frame.line, column}, frame.text);
  }

 private:
  WorkWords words(std::size_t i, std::span<const ListedFrame::Word> line) {
    return FrameJob(typed_, line, list_.outputs[i]).words(manifest_, views_);
  }

  // Of the failure with a part of the line; "" where there is none.
  std::string message_with(std::size_t i, std::span<const ListedFrame::Word> line) {
    try {
      words(i, line);
    } catch (const Error& e) {
      return in_words(e);
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return {};
  }

  const FrameList& list_;
  std::span<char* const> typed_;
  KnownViews& views_;
  Manifest manifest_;
};

// Nothing where the frame can be rendered.
std::optional<Error> failure_of(Checker& checker, const FrameList& list, std::size_t i,
                                const std::function<void(std::size_t, const WorkWords&)>& visit) {
  require_place(list.outputs[i]);
  std::optional<WorkWords> asked;
  try {
    asked = checker.words(i);
  } catch (const Interrupted&) {
    throw;
  } catch (const MachineError&) {
    throw;
  } catch (const Error& e) {
    if (dynamic_cast<const AlreadySaid*>(&e)) return checker.of_camera(i);
    if (e.location.file == checker.file()) return e;
    return checker.of_line(i, in_words(e), std::current_exception());
  } catch (const UsageError& e) {
    return checker.of_line(i, e.what(), std::current_exception());
  } catch (const CLI::ParseError& e) {
    return checker.of_line(i, e.what(), std::current_exception());
  }
  visit(i, *asked);
  return std::nullopt;
}

void say_failure(const Error& e) {
  say("vitrail: {}: {}\n  | {}\n", to_string(e.location), e.what(), e.excerpt);
}

}  // namespace

FrameList read_frame_list(const RenderArguments& command) {
  require_command_of_frames(command);
  FrameList list{command.frames, 0, read_frames(command.frames), {}};
  list.count = list.frames.size();
  if (command.range) {
    std::vector<ListedFrame> chosen;
    for (const std::size_t number : parse_frame_range(*command.range, list.count))
      chosen.push_back(list.frames[number - 1]);
    list.frames = std::move(chosen);
  }
  for (const ListedFrame& frame : list.frames) list.outputs.push_back(numbered(command.output, frame.number));
  return list;
}

void check_frames(const FrameList& list, const RenderArguments& command, std::span<char* const> typed,
                  KnownViews& views, const std::function<void(std::size_t, const WorkWords&)>& visit) {
  require_renderable(command);
  if (command.output.extension() != ".film") require_place(record_path(command.output));
  Checker checker(list, command, typed, views);
  constexpr std::size_t most_said = 10;
  std::size_t failed = 0;
  for (std::size_t i = 0; i < list.frames.size(); ++i) {
    if (stop_signal()) throw Interrupted(stop_signal(), "interrupted before rendering began");
    const std::optional<Error> failure = failure_of(checker, list, i, visit);
    if (failure && ++failed <= most_said) say_failure(*failure);
  }
  if (failed > 0)
    throw Error(fmt::format("{} of {} frames cannot be rendered, so none was{}", failed, list.frames.size(),
                            failed > most_said ? fmt::format("; the first {} are named", most_said) : ""),
                {list.file.string()});
}

}  // namespace vitrail
