// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/finish.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"
#include "tracer/bsdf/local.h"

namespace vitrail {

namespace {

bool reflects(Vector3d out, Vector3d in) { return out.z > 0 && in.z > 0; }

double highlight_of(const FinishBsdf& b, Vector3d out, Vector3d in) {
  double sum = 0;
  if (b.phong > 0) {
    const double cosine = out.z * in.z - out.x * in.x - out.y * in.y;  // to the mirrored direction
    if (cosine > 0) sum += b.phong * portable_pow(cosine, b.phong_size);
  }
  if (b.specular > 0) sum += b.specular * portable_pow(normalize(out + in).z, 1 / b.roughness);
  return sum;
}

}  // namespace

BsdfValue eval(const FinishBsdf& b, Vector3d out, Vector3d in) {
  if (!reflects(out, in)) return {};
  const double diffuse = b.brilliance == 1 ? in.z : portable_pow(in.z, b.brilliance);
  const double highlight = highlight_of(b, out, in);
  return {b.reflectance * static_cast<float>(diffuse / pi) + b.highlight * static_cast<float>(highlight / pi),
          pdf(b, out, in)};
}

double pdf(const FinishBsdf&, Vector3d out, Vector3d in) {
  return reflects(out, in) ? (0.5 * in.z + 0.25) / pi : 0;
}

std::optional<BsdfSample> sample(const FinishBsdf& b, Vector3d out, float u_lobe, Point2f u) {
  Vector3d in = sample_cosine_hemisphere(u.x, u.y);
  if (u_lobe < 0.5f) {  // z² of the one is even, z of the other
    const double z = in.z * in.z, across = safe_sqrt(1 - z * z), before = safe_sqrt(1 - in.z * in.z);
    in = before > 0 ? Vector3d{in.x * (across / before), in.y * (across / before), z} : Vector3d{0, 0, 1};
  }
  const BsdfValue value = eval(b, out, in);
  if (!(value.pdf > 0)) return std::nullopt;
  return BsdfSample{.in = in, .weight = value.value * static_cast<float>(1 / value.pdf), .pdf = value.pdf};
}

}  // namespace vitrail
