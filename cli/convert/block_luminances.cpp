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

nlohmann::ordered_json compare_luminances(const Luminances& a, const Luminances& b, double tolerance) {
  const auto mean = [](const std::vector<double>& v) {
    return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
  };
  const double mean_a = mean(a.means), mean_b = mean(b.means);
  if (!std::isfinite(mean_a)) return {{"passed", false}, {"said", "some of its pixels are no numbers"}};
  if (!(mean_b > 0)) return {{"passed", !(mean_a > 0)}};
  const std::size_t count = a.means.size();
  double worst = 0, worst_noise = 0, squares = 0;
  bool passed = true;
  for (std::size_t i = 0; i < count; ++i) {
    const double pixel = std::max(b.means[i], 0.05 * mean_b), off = std::abs(a.means[i] - b.means[i]);
    const double noise = std::hypot(a.noise.empty() ? 0 : a.noise[i], b.noise.empty() ? 0 : b.noise[i]);
    worst = std::max(worst, off / pixel), worst_noise = std::max(worst_noise, noise / pixel);
    squares += noise * noise;
    passed = passed && off - 5 * noise <= 5 * tolerance * pixel;
  }
  const double ratio = mean_a / mean_b, mean_noise = std::sqrt(squares) / static_cast<double>(count) / mean_b;
  passed = passed && std::abs(ratio - 1) <= tolerance + 4 * mean_noise;
  nlohmann::ordered_json found{
      {"luminance_ratio", ratio}, {"worst_pixel", worst}, {"tolerance", tolerance}, {"passed", passed}};
  if (squares > 0) found["mean_noise"] = mean_noise, found["pixel_noise"] = worst_noise;
  return found;
}

}  // namespace vitrail
