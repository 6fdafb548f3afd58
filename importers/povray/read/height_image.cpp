// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/height_image.h"

#include <algorithm>

#include "images/image_files.h"
#include "importers/povray/read/reader.h"

namespace vitrail::pov {

void read_heights(const std::string& file, solids::HeightField& field, Reader& reader, const Place& place) {
  StoredImage stored;
  try {
    stored = read_stored_image(file);
  } catch (const Error& error) {
    reader.fail(error.what(), place);
  }
  const Image& image = stored.image;
  if (image.width < 2 || image.height < 2)
    reader.fail("the image of a height field has fewer than 2 by 2 pixels", place);
  field.columns = image.width, field.rows = image.height;
  field.heights.reserve(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  for (int row = image.height - 1; row >= 0; --row)
    for (int column = 0; column < image.width; ++column) {
      const auto pixel = static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                         static_cast<std::size_t>(column);
      const float value = image.values[pixel * static_cast<std::size_t>(image.channels)];
      field.heights.push_back(std::clamp(static_cast<double>(value), 0.0, 1.0));
    }
}

}  // namespace vitrail::pov
