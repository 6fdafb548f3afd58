// SPDX-License-Identifier: Apache-2.0
#include "cli/convert/block_luminances.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "images/image_files.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

std::vector<double> block_luminances(const std::filesystem::path& picture, SmallPicture size) {
  constexpr double weights[3] = {0.2126, 0.7152, 0.0722};  // of Rec. 709 in Y
  const Image image = read_linear_image(picture);
  if (image.width != size.width * SmallPicture::block || image.height != size.height * SmallPicture::block)
    throw Error(fmt::format("{} has {} × {} pixels", picture.string(), image.width, image.height));
  std::vector<double> means(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
  const float* value = image.values.data();
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x, value += image.channels) {
      double luminance = value[0];
      if (image.channels >= 3)
        luminance = weights[0] * value[0] + weights[1] * value[1] + weights[2] * value[2];
      means[static_cast<std::size_t>(y / SmallPicture::block * size.width + x / SmallPicture::block)] +=
          luminance / (SmallPicture::block * SmallPicture::block);
    }
  return means;
}

nlohmann::ordered_json compare_luminances(const std::vector<double>& a, const std::vector<double>& b,
                                          double tolerance) {
  const auto mean = [](const std::vector<double>& v) {
    return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
  };
  const double mean_a = mean(a), mean_b = mean(b);
  if (!std::isfinite(mean_a)) return {{"passed", false}, {"said", "some of its pixels are no numbers"}};
  if (!(mean_b > 0)) return {{"passed", !(mean_a > 0)}};
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    worst = std::max(worst, std::abs(a[i] - b[i]) / std::max(b[i], 0.05 * mean_b));
  const double ratio = mean_a / mean_b;
  return {{"luminance_ratio", ratio},
          {"worst_pixel", worst},
          {"tolerance", tolerance},
          {"passed", std::abs(ratio - 1) <= tolerance && worst <= 5 * tolerance}};
}

}  // namespace vitrail
