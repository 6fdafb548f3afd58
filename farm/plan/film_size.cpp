// SPDX-License-Identifier: Apache-2.0
#include "farm/plan/film_size.h"

#include <algorithm>
#include <cmath>

namespace vitrail {

namespace {

// What is beyond the int is refused with the film.
int rounded(double pixels) { return static_cast<int>(std::lround(std::clamp(pixels, 1.0, 0x1p30))); }

void stretch(double& from, double& to, double factor) {
  const double centre = (from + to) / 2, half = (to - from) / 2 * factor;
  from = centre - half, to = centre + half;
}

// Of a screen that covers a film which is given so many times its width and height.
void fit_screen(Camera& camera, double wider, double taller) {
  if (wider == 1 && taller == 1) return;
  const double least = std::min(wider, taller);
  std::visit(
      [&](auto& c) {
        if constexpr (requires { c.screen; }) {
          stretch(c.screen.x0, c.screen.x1, wider / least);
          stretch(c.screen.y0, c.screen.y1, taller / least);
        }
      },
      camera);
}

}  // namespace

void resize_film(Manifest& m, const PictureSettings& picture) {
  FilmSettings& film = m.film;
  const double w = film.width, h = film.height;
  const int width = picture.width    ? *picture.width
                    : picture.height ? rounded(*picture.height * w / h)
                                     : rounded(picture.scale * w);
  const int height = picture.height  ? *picture.height
                     : picture.width ? rounded(*picture.width * h / w)
                                     : rounded(picture.scale * h);
  const auto& view = picture.view.view;
  const bool is_of_view = view && !picture.view.fov_deg;
  fit_screen(m.camera, width / (is_of_view ? view->width : w), height / (is_of_view ? view->height : h));
  if (width == film.width && height == film.height) return;
  const double wider = width / w, taller = height / h;
  PixelRect& c = film.crop;
  c = {static_cast<int>(c.x0 * wider), std::min(width, static_cast<int>(std::ceil(c.x1 * wider))),
       static_cast<int>(c.y0 * taller), std::min(height, static_cast<int>(std::ceil(c.y1 * taller)))};
  film.width = width, film.height = height;
}

}  // namespace vitrail
