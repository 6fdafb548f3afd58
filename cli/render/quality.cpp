// SPDX-License-Identifier: Apache-2.0
#include "cli/render/quality.h"

#include <algorithm>
#include <iterator>

namespace vitrail {

namespace {

struct Quality {
  const char* name;
  double just_noticeable;  // differences, root mean square
  double denoised;         // the same, before the denoiser takes what is left
  int most_samples;        // a pixel
  bool adaptive;           // not worth while in a few samples
};

// A denoiser divided the squared error by 2.7 to 74 on five scenes (docs/why/denoising.md): the least of
// these is counted on. What it blurs is more than a final picture's noise.
constexpr Quality table[] = {
    {"draft", 3.8, 6.1, 64, false}, {"good", 1, 1.6, 4096, true}, {"final", 0.25, 0.25, 32768, true}};

}  // namespace

std::vector<std::string> qualities() {
  std::vector<std::string> names;
  for (const Quality& q : table) names.emplace_back(q.name);
  return names;
}

void apply_quality(const std::string& quality, bool adaptive_is_given, bool denoised, RenderOptions& o) {
  const Quality& q = *std::ranges::find(table, quality, &Quality::name);
  if (!o.picture.target_error)
    o.picture.target_error = TargetError{denoised ? q.denoised : q.just_noticeable, true};
  if (!o.picture.samples_per_pixel) o.picture.samples_per_pixel = q.most_samples;
  if (!adaptive_is_given) o.picture.adaptive = q.adaptive;
}

}  // namespace vitrail
