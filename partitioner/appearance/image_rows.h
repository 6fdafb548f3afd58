// SPDX-License-Identifier: Apache-2.0
// An ImageRows is an image that is read as often as it is asked for, some rows at a time.
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "scene/records/image.h"

namespace vitrail {

struct ImageRows {
  int width = 0, height = 0;
  // It calls the function with all rows from the top, some at a time: images of that width. An exception
  // of the function stops the reading.
  std::function<void(const std::function<void(Image)>&)> read;
};

inline ImageRows rows_of(Image image) {
  const auto whole = std::make_shared<const Image>(std::move(image));
  return {whole->width, whole->height, [whole](const auto& visit) { visit(*whole); }};
}

}  // namespace vitrail
