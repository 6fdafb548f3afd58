// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "cli/common/sizes.h"
#include "cli/inspect/inspect.h"
#include "film/film.h"
#include "scene/system/machine_limits.h"
#include "scene/system/progress_line.h"

namespace vitrail {

namespace {

// Processor time of a sample: the geometric mean of the scenes in docs/why/speed.md, which take 0.2 to 5.5
// µs.
constexpr double a_sample_s = 0.95e-6;
constexpr std::uint64_t of_the_program = 12 << 20;

std::string exactness(const Report& s) {
  if (!s.contains("not_exact")) return {};
  const auto read = s["not_exact"].get<std::uint64_t>(),
             shown = s["not_rendered_exactly"].get<std::uint64_t>();
  if (read + shown == 0) return "exact: all of it is read and rendered as the scene says\n";
  return fmt::format("not exact: {} read and {} rendered otherwise than the scene says (listed at the end)\n",
                     read, shown);
}

}  // namespace

Report summary_of(const Manifest& m, std::uint64_t scene_bytes) {
  const PixelRect& c = m.film.crop;
  const double pixels = static_cast<double>(c.x1 - c.x0) * (c.y1 - c.y0);
  return {{"triangles", m.triangles},
          {"scene_bytes", scene_bytes},
          {"film_bytes", film_bytes(m.film)},
          {"render_memory_bytes", of_the_program + scene_bytes + film_bytes(m.film)},
          {"samples", pixels * m.settings.samples_per_pixel},
          {"render_core_s", pixels * m.settings.samples_per_pixel * a_sample_s}};
}

std::string summary_text(const Report& s) {
  const auto cores = processors_allowed();
  const auto bytes = [&](const char* key) { return format_bytes(s[key].get<std::uint64_t>()); };
  return fmt::format("size: {} triangles and quadrics, {}\n", s["triangles"].get<std::uint64_t>(),
                     bytes("scene_bytes")) +
         fmt::format(
             "a render takes: about {} of memory; {:.3g} million samples, very roughly {} on the {} cores "
             "here "
             "(render --dry-run measures it)\n",
             bytes("render_memory_bytes"), 1e-6 * s["samples"].get<double>(),
             duration_in_words(s["render_core_s"].get<double>() / cores), cores) +
         exactness(s);
}

}  // namespace vitrail
