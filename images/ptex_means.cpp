// SPDX-License-Identifier: Apache-2.0
#include "images/ptex_means.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "images/ptex_file.h"
#include "scene/geometry/portable_math.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

double ptex_value(double value, const PtexTexture& t) {
  const double scale = static_cast<double>(t.scale);
  if (!std::isfinite(value)) return 0;
  if (t.encoding == Encoding::linear || value <= 0) return scale * value;
  if (t.encoding == Encoding::srgb) return scale * srgb_decode(std::min(value, 1.0));
  return scale * portable_pow(value, t.encoding == Encoding::gamma ? static_cast<double>(t.gamma) : 2.2);
}

PtexMean mean_of_ptex(const PtexTexture& texture) {
  const double scale = static_cast<double>(texture.scale);
  std::optional<PtexFile> file;
  try {
    file.emplace(texture.filename);
  } catch (const Error& error) {
    return {{0.5 * scale, 0.5 * scale, 0.5 * scale}, fmt::format("grey, {}: {}", 0.5 * scale, error.what())};
  }
  const std::size_t channels = file->channels(), faces = file->faces().size();
  std::array<double, 3> sum{}, squares{};
  for (std::size_t f = 0; f < faces; ++f)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t from = channels < 3 ? 0 : c;  // one or two channels are grey, and alpha
      const double value = ptex_value(static_cast<double>(file->means()[f * channels + from]), texture);
      sum[c] += value, squares[c] += value * value;
    }
  const double n = static_cast<double>(faces);
  double deviation = 0;
  for (std::size_t c = 0; c < 3; ++c)
    deviation = std::max(deviation, std::sqrt(std::max(0.0, squares[c] / n - sum[c] / n * (sum[c] / n))));
  const RGB mean{sum[0] / n, sum[1] / n, sum[2] / n};
  return {mean,
          fmt::format("the mean of its {} faces, rgb {:.3g} {:.3g} {:.3g}, from which they are {:.2g} in the "
                      "root mean square",
                      faces, mean.r, mean.g, mean.b, deviation),
          deviation};
}

}  // namespace vitrail
