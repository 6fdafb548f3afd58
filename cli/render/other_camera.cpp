// SPDX-License-Identifier: Apache-2.0
#include "cli/render/other_camera.h"

#include <string>

#include "bundle/checked_json.h"
#include "bundle/manifest_json.h"
#include "cli/common/run_program.h"
#include "farm/files/signals.h"
#include "farm/transport/agreement.h"
#include "farm/transport/share_text.h"

namespace vitrail {

namespace {

std::string text_of_view(const std::filesystem::path& scene, const std::filesystem::path& between) {
  run_program("vitrail-partition", {scene.string(), "-o", between.string(), "--view-only", "--quiet"},
              [] { return stop_signal() != 0; });
  const std::string text = read_checked_json(between, "the view").dump();
  std::filesystem::remove(between);
  return text;
}

}  // namespace

View view_of_scene(Transport& transport, const std::filesystem::path& scene,
                   const std::filesystem::path& between) {
  catch_signals();
  std::string text;
  agree(transport, [&] {
    if (transport.rank() == 0) text = text_of_view(scene, between);
  });
  share_from_root(transport, text);
  return view_from_json(Json::parse(text));
}

}  // namespace vitrail
