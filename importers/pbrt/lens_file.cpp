// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/lens_file.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "importers/pbrt/lexer.h"
#include "importers/ply/input_bytes.h"

namespace vitrail::pbrt {

namespace {

struct Surface {
  double curvature, thickness, index, diameter;
  bool is_stop;
};

std::vector<Surface> read_surfaces(const std::filesystem::path& file) {
  const InputBytes bytes(file);
  const std::string name = file.string();
  Lexer lexer(&name, bytes.begin(), bytes.end());
  std::vector<double> numbers;
  for (double value = 0; lexer.next_number(value);) numbers.push_back(value);
  if (lexer.peek() != '\0' || numbers.empty() || numbers.size() % 4 != 0)
    fail("a lens has four numbers a surface: radius of curvature, thickness, index, diameter", lexer.place());
  std::vector<Surface> surfaces;
  for (std::size_t i = 0; i < numbers.size(); i += 4) {
    const double radius = numbers[i], index = numbers[i + 2];
    surfaces.push_back(
        {radius == 0 ? 0 : 1 / radius, numbers[i + 1], index == 0 ? 1 : index, numbers[i + 3], radius == 0});
  }
  return surfaces;
}

// A ray near the axis: height and slope.
struct Ray {
  double height, slope;
};

// n′u′ = nu − y(n′ − n)/R at a surface, y′ = y + tu′ behind it; the thickness behind the last is the film's.
Ray refracted(Ray ray, const Surface& surface, double index_before) {
  return {ray.height,
          (index_before * ray.slope - ray.height * (surface.index - index_before) * surface.curvature) /
              surface.index};
}

}  // namespace

ThinLens read_lens(const std::filesystem::path& file, double aperture_mm) {
  const std::vector<Surface> surfaces = read_surfaces(file);
  const auto refuse = [&](const char* why) { throw Error(why, {file.string()}); };
  Ray ray{1, 0};
  double before = 1, length = 0;
  ThinLens lens;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const Surface& surface = surfaces[i];
    if (surface.is_stop) {
      const double diameter = aperture_mm > 0 ? std::min(aperture_mm, surface.diameter) : surface.diameter;
      if (!(ray.height > 0)) refuse("a lens whose stop is behind its focus");
      lens.pupil_radius = diameter / 2 / ray.height;
    }
    ray = refracted(ray, surface, before);
    before = surface.index;
    if (i + 1 == surfaces.size()) break;
    ray.height += surface.thickness * ray.slope;
    length += surface.thickness;
  }
  if (lens.pupil_radius == 0) refuse("a lens without a stop: no surface has a radius of curvature of 0");
  if (!(ray.slope < 0)) refuse("a lens that does not gather light");
  lens.focal_length = -1 / ray.slope;
  const double rear_focus = length - ray.height / ray.slope;  // from the first surface
  // The same from the film's side gives the front focus.
  Ray back{1, 0};
  for (std::size_t i = surfaces.size(); i-- > 0;) {
    const double index_behind = surfaces[i].index, index_before = i == 0 ? 1 : surfaces[i - 1].index;
    back.slope =
        (index_behind * back.slope + back.height * (index_before - index_behind) * surfaces[i].curvature) /
        index_before;
    if (i > 0) back.height += surfaces[i - 1].thickness * back.slope;
  }
  const double front_focus = back.height / back.slope;
  lens.principal_gap = rear_focus - lens.focal_length - (front_focus + lens.focal_length);
  return lens;
}

// s + s′ = S and 1/s + 1/s′ = 1/f: the lesser of the two is the image's. Nearer than 4f nothing is sharp.
double image_distance(const ThinLens& lens, double distance_mm) {
  const double sum = std::max(distance_mm - lens.principal_gap, 4 * lens.focal_length);
  return (sum - std::sqrt(sum * (sum - 4 * lens.focal_length))) / 2;
}

}  // namespace vitrail::pbrt
