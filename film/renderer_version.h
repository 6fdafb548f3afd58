// SPDX-License-Identifier: Apache-2.0
// It tells which program made a film. Films of different programs are not samples of one picture.
#pragma once

#include <cstdint>
#include <string>

namespace vitrail {

struct RendererVersion {
  std::string number;          // of the project: "0.1.0"; at most 15 characters
  std::uint32_t revision = 0;  // of the pictures: greater by one whenever a change of the code changes one
  bool operator==(const RendererVersion&) const = default;
};

RendererVersion this_renderer();

// Returns "vitrail 0.1.0, pictures of revision 2".
std::string to_string(const RendererVersion& renderer);

}  // namespace vitrail
