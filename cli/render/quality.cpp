// SPDX-License-Identifier: Apache-2.0
#include "cli/render/quality.h"

#include <algorithm>
#include <iterator>

namespace vitrail {

namespace {

struct Quality {
  const char* name;
  double just_noticeable;  // differences, root mean square
  int most_samples;        // a pixel
  bool adaptive;           // not worth while in a few samples
};

constexpr Quality table[] = {
    {"draft", 3.8, 64, false}, {"good", 1, 4096, true}, {"final", 0.25, 32768, true}};

}  // namespace

std::vector<std::string> qualities() {
  std::vector<std::string> names;
  for (const Quality& q : table) names.emplace_back(q.name);
  return names;
}

void apply_quality(const std::string& quality, bool adaptive_is_given, RenderOptions& o) {
  const Quality& q = *std::ranges::find(table, quality, &Quality::name);
  if (!o.picture.target_error) o.picture.target_error = TargetError{q.just_noticeable, true};
  if (!o.picture.samples_per_pixel) o.picture.samples_per_pixel = q.most_samples;
  if (!adaptive_is_given) o.picture.adaptive = q.adaptive;
}

}  // namespace vitrail
