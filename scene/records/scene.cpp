// SPDX-License-Identifier: Apache-2.0
#include "scene/records/scene.h"

namespace vitrail {

SourceLocation location(const Scene& scene, const Origin& origin) {
  if (origin.line == 0 || origin.file >= scene.files.size()) return {};
  return {scene.files[origin.file], static_cast<int>(origin.line), static_cast<int>(origin.column)};
}

}  // namespace vitrail
