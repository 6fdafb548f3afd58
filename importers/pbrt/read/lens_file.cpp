// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/read/lens_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "importers/bytes/input_bytes.h"
#include "importers/pbrt/read/lexer.h"
#include "scene/models/lens_tracing.h"
#include "scene/models/paraxial_lens.h"

namespace vitrail::pbrt {

namespace {

constexpr double mm = 1e-3;

double area(const ScreenWindow& w) { return (w.x1 - w.x0) * (w.y1 - w.y0); }

}  // namespace

std::vector<LensSurface> read_lens(const std::filesystem::path& file, double aperture_mm) {
  const InputBytes bytes(file);
  const std::string name = file.string();
  Lexer lexer(&name, bytes.begin(), bytes.end());
  std::vector<double> numbers;
  for (double value = 0; lexer.next_number(value);) numbers.push_back(value);
  if (lexer.peek() != '\0' || numbers.empty() || numbers.size() % 4 != 0)
    fail("a lens has four numbers a surface: radius of curvature, thickness, index, diameter", lexer.place());
  std::vector<LensSurface> surfaces;
  for (std::size_t i = 0; i < numbers.size(); i += 4) {
    const double radius = numbers[i], index = numbers[i + 2];
    double diameter = numbers[i + 3];
    if (radius == 0 && aperture_mm > 0) diameter = std::min(aperture_mm, diameter);
    surfaces.push_back({radius * mm, numbers[i + 1] * mm, index == 0 ? 1 : index, diameter / 2 * mm});
    const LensSurface& s = surfaces.back();
    if (!(s.thickness >= 0 && s.index > 0 && s.aperture_radius > 0))
      throw Error(
          "a lens has a surface whose thickness is negative, or whose index or diameter is not above 0",
          {name});
  }
  try {
    thin_lens(surfaces);
  } catch (const Error& e) {
    throw Error(e.what(), {name});
  }
  return surfaces;
}

FocussedLens focussed(std::vector<LensSurface> surfaces, double focus_distance, double film_diagonal,
                      bool by_area) {
  const ThinLens thin = thin_lens(surfaces);
  const auto image = image_distance(thin, focus_distance);
  const double rear = image ? *image + thin.rear_principal : 0;
  if (!(rear > 0))
    throw Error(
        fmt::format("the lens, of {:.4g} mm, cannot be focussed at {} m from the film: that is too near",
                    thin.focal_length / mm, focus_distance));
  FocussedLens lens{std::move(surfaces), {}, 0};
  lens.surfaces.back().thickness = rear;
  lens.pupils = exit_pupils(lens.surfaces, film_diagonal / 2);
  for (ExitPupil& pupil : lens.pupils)
    if (const double a = area(pupil.rectangle); a > 0) pupil.weight = by_area ? a / (rear * rear) : 1;
  const ExitPupil& first = lens.pupils.front();
  lens.middle = first.weight * mean_weight(lens.surfaces, {0, 0}, first.rectangle);
  if (!(lens.middle > 0)) throw Error("no light comes through the lens to the middle of the film");
  for (ExitPupil& pupil : lens.pupils) pupil.weight /= lens.middle;
  return lens;
}

}  // namespace vitrail::pbrt
