// SPDX-License-Identifier: Apache-2.0
#include "cli/render/other_camera.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>

#include "bundle/checked_json.h"
#include "bundle/manifest_json.h"
#include "cli/common/run_program.h"
#include "farm/files/signals.h"

namespace vitrail {

namespace {

// Of this process: others may read the camera for the same output.
std::filesystem::path place_beside(const std::filesystem::path& output) {
  std::array<char, 128> host{};
  ::gethostname(host.data(), host.size() - 1);
  return std::filesystem::path(output).replace_extension(
      fmt::format(".tmp.{}-{}.camera", host.data(), ::getpid()));
}

std::string read_view(const std::filesystem::path& scene, const std::filesystem::path& between) {
  run_program("vitrail-partition", {scene.string(), "-o", between.string(), "--view-only", "--quiet"},
              [] { return stop_signal() != 0; });
  std::string text = read_checked_json(between, "the view").dump();
  std::filesystem::remove(between);
  return text;
}

}  // namespace

std::string text_of_view(const std::filesystem::path& scene, const std::filesystem::path& output,
                         KnownViews& known) {
  catch_signals();
  std::string& text = known[scene];
  if (text.empty()) text = read_view(scene, place_beside(output));
  return text;
}

View view_from_text(const std::string& text) { return view_from_json(Json::parse(text)); }

}  // namespace vitrail
