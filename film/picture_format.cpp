// SPDX-License-Identifier: Apache-2.0
#include "film/picture_format.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>

namespace vitrail {

PictureFormat picture_format(const std::filesystem::path& file) {
  using enum PictureFormat;
  struct Row {
    std::string_view extension;
    PictureFormat format;
  };
  constexpr Row rows[] = {{".exr", exr},   {".hdr", hdr},  {".png", png},   {".jpg", jpeg},
                          {".jpeg", jpeg}, {".tif", tiff}, {".tiff", tiff}, {".webp", webp}};
  const std::string extension = file.extension().string();
  const auto* found = std::ranges::find(rows, extension, &Row::extension);
  return found == std::end(rows) ? none : found->format;
}

}  // namespace vitrail
