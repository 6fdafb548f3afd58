// SPDX-License-Identifier: Apache-2.0
#include "film/renderer_version.h"

#include <fmt/format.h>

namespace vitrail {

namespace {

// tests/laws/one_picture/picture_revision_test.cpp says when it is to be raised.
constexpr std::uint32_t picture_revision = 21;

}  // namespace

RendererVersion this_renderer() { return {VITRAIL_VERSION, picture_revision}; }

std::string to_string(const RendererVersion& renderer) {
  return fmt::format("vitrail {}, pictures of revision {}", renderer.number, renderer.revision);
}

}  // namespace vitrail
