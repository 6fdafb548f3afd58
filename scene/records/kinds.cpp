// SPDX-License-Identifier: Apache-2.0
#include "scene/records/kinds.h"

#include <array>

namespace vitrail {

namespace {

template <class... Models, std::size_t n>
const char* name_of(const std::variant<Models...>& v, const std::array<const char*, n>& names) {
  static_assert(n == sizeof...(Models));
  return names[v.index()];
}

}  // namespace

const char* kind_of(const Spectrum& spectrum) {
  return name_of(spectrum, std::array{"constant", "sigmoid", "RGB illuminant", "tabulated", "Sellmeier",
                                      "unbounded RGB", "blackbody", "named"});
}

const char* kind_of(const TextureModel& model) {
  return name_of(model, std::array{"image", "checkerboard", "product", "mix", "direction mix", "bilinear",
                                   "dots", "noise", "ptex", "mesh attribute", "uv", "pattern"});
}

const char* kind_of(const MaterialModel& model) {
  return name_of(model, std::array{"diffuse",
                                   "dielectric",
                                   "thin dielectric",
                                   "conductor",
                                   "plastic",
                                   "coated diffuse",
                                   "coated conductor",
                                   "diffuse transmission",
                                   "principled",
                                   "subsurface",
                                   "hair",
                                   "measured",
                                   "interface",
                                   "blend",
                                   "mask",
                                   "two-sided",
                                   "tabulated",
                                   "slab",
                                   "finish",
                                   "glazed finish"});
}

const char* kind_of(const LightModel& model) {
  return name_of(model, std::array{"point", "spot", "projection", "goniometric", "distant", "infinite",
                                   "environment", "sky"});
}

const char* kind_of(const Camera& camera) {
  return name_of(camera,
                 std::array{"perspective", "orthographic", "spherical", "sensors", "realistic", "wide"});
}

const char* kind_of(QuadricKind kind) {
  constexpr std::array names{"sphere", "cylinder", "disk", "cone", "paraboloid", "curve"};
  return names.at(static_cast<std::size_t>(kind));
}

}  // namespace vitrail
