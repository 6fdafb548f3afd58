// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/write/write_environment.h"

#include "images/texture_values.h"
#include "importers/images/environment_images.h"
#include "importers/povray/write/write_pigments.h"
#include "importers/writing/export_colors.h"

namespace vitrail::povray {

namespace {

// The sky turns, and is never moved.
Transform rotation_of(const Transform& t) {
  Transform result = t;
  for (std::size_t row = 0; row < 3; ++row) result.m[row][3] = 0;
  result.m[3] = {0, 0, 0, 1};
  return result;
}

// POV-Ray's map_type 1 has +y up where the light has +z.
constexpr Transform swap_y_and_z() {
  Transform t;
  t.m = {{{1, 0, 0, 0}, {0, 0, 1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}}};
  return t;
}

// Half floats stay below it: colours that POV-Ray's function patterns carry as values from 0 to 1.
constexpr double largest_value = 65536;

// The equal-area octahedral map (Clarberg 2008) of the unit direction (x,y,z), in POV-Ray's functions.
// `Corner` is the map's (u,v) of |x|,|y|,|z| in the triangle u + v ≤ 1.
std::string octahedral_functions(const std::string& image) {
  return fmt::format(
      "#declare Sky_image = function {{ pigment {{ image_map {{ {} interpolate 2 }} }} }}\n"
      "#declare Sky_phi = function(x,y) {{ atan2(abs(y), abs(x)) * 2/pi }}\n"
      "#declare Sky_r = function(z) {{ sqrt(max(0, 1 - abs(z))) }}\n"
      "#declare Sky_v = function(x,y,z) {{ Sky_phi(x,y) * Sky_r(z) }}\n"
      "#declare Sky_u = function(x,y,z) {{ Sky_r(z) - Sky_v(x,y,z) }}\n"
      "#declare Sky_s = function(x,y,z) {{ select(x, -1, 1) * select(z, 1 - Sky_v(x,y,z), Sky_u(x,y,z)) }}\n"
      "#declare Sky_t = function(x,y,z) {{ select(y, -1, 1) * select(z, 1 - Sky_u(x,y,z), Sky_v(x,y,z)) }}\n",
      image);
}

std::string channel(const char* name, const char* color) {
  return fmt::format(
      "    [1 function {{ Sky_image((Sky_s(x,y,z) + 1)/2, 1 - (Sky_t(x,y,z) + 1)/2, 0).{} / {} }}\n"
      "       color_map {{ [0 rgb 0] [1 rgb {}*{}] }}]\n",
      name, largest_value, color, 3 * largest_value);
}

std::string octahedral_pigment() {
  return "average pigment_map {\n" + channel("red", "<1,0,0>") + channel("green", "<0,1,0>") +
         channel("blue", "<0,0,1>") + "  }";
}

}  // namespace

std::string environment_text(Context& context, const EnvironmentLight& light, const Origin& origin) {
  const auto image = image_of(context, image_of(light), ImageUse::light, origin);
  RGB factor = factor_rgb(light.scale);
  if (!image) return fmt::format("background {{ {} }}\n", color(factor * 0.5));
  if (light.illuminance) {
    const Image values = texture_values(image_of(light), read_stored_image(light.filename), ImageUse::light);
    if (const double natural = upward_illuminance(values, light.projection); natural > 0)
      factor = factor * (static_cast<double>(*light.illuminance) / natural);
  }
  if (*light.portal) context.dropped("portal of an environment: light enters everywhere", origin);
  const Transform turn = rotation_of(light.light_to_world);
  if (light.projection == EnvironmentLight::Projection::latitude_longitude)
    return fmt::format(
        "sky_sphere {{ pigment {{ image_map {{ {} map_type 1 interpolate 2 }} }} {} emission {} }}\n", *image,
        matrix(turn * swap_y_and_z()), color(factor));
  return octahedral_functions(*image) +
         fmt::format("sky_sphere {{\n  pigment {{ {}\n  }} {} emission {} }}\n", octahedral_pigment(),
                     matrix(turn), color(factor));
}

}  // namespace vitrail::povray
