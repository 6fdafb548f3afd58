// SPDX-License-Identifier: Apache-2.0
// These codes are what connections to lights carry beside what every ray does.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace vitrail {

// It codes the least power of two that is not below x, out of 15 from 2^`least` on, or 0. Greater values
// become the greatest power.
template <int least>
struct PowerCode {
  static std::uint32_t of(double x) {
    if (!(x > 0)) return 0;
    int exponent = 0;
    const double mantissa = std::frexp(x, &exponent);  // [½, 1)
    const int above = mantissa > 0.5 ? exponent : exponent - 1;
    return static_cast<std::uint32_t>(above < least ? 1 : above > least + 14 ? 15 : above - least + 1);
  }
  static double value(std::uint32_t code) {
    return code == 0 ? 0 : std::ldexp(1.0, least - 1 + static_cast<int>(code));
  }
};

// It bounds how far faces of glass may be off parallel, in rad. They are those that light has crossed since
// it last had the direction of its distant light. It is the greatest of them, at most 3.6°. It is the same in
// either direction, and no less than the sum of two faces.
struct FaceDoubt {
  using Code = PowerCode<-18>;
  std::uint32_t code = 0;

  void cross(double face_rad) { code = std::max(code, Code::of(face_rad)); }
  double allowed_rad() const { return 2 * Code::value(code); }
};

// It belongs to a connection to a distant light that smooth interfaces refract: the light, and the faces'
// doubt.
struct RefractedAim {
  std::uint32_t light = 0;  // lowest bits of its number
  FaceDoubt doubt;

  static constexpr std::uint32_t light_mask = 0xfff;
  std::uint16_t bits() const { return static_cast<std::uint16_t>((light & light_mask) | doubt.code << 12); }
  static RefractedAim of(std::uint16_t bits) {
    return {bits & light_mask, {static_cast<std::uint32_t>(bits) >> 12}};
  }
};

// It belongs to any other connection. It is the tangent of the ray's angle to the light's normal: how much
// earlier the ray meets the light's plane for each length that it is moved aside. It takes 4 bits.
struct StraightAim {
  double slope = 0;  // rounded up, at most 2048

  using Slope = PowerCode<-3>;
  std::uint32_t bits() const { return Slope::of(slope); }
  static StraightAim of(std::uint32_t bits) { return {Slope::value(bits)}; }
};

// They code the distance that such a connection has left in 36 bits: it is rounded down to 28 bits of
// mantissa, with 8 of exponent above them. A distance below 2⁻¹²⁶ becomes 0. ∞, of lights infinitely far,
// stays ∞, and a distance beyond 2¹²⁸ becomes ∞.
inline constexpr int end_code_length = 36;
inline constexpr std::uint64_t end_code_mask = (std::uint64_t{1} << end_code_length) - 1;
inline constexpr std::uint64_t endless_code = std::uint64_t{0xff} << 28;
inline std::uint64_t end_code(double left) {
  if (!(left >= 0x1p-126)) return 0;
  if (!(left < 0x1p128)) return endless_code;
  return (std::bit_cast<std::uint64_t>(left) - (std::uint64_t{1023 - 127} << 52)) >> 24;
}
inline double end_value(std::uint64_t code) {
  if (code == 0) return 0;
  if (code >= endless_code) return std::numeric_limits<double>::infinity();
  return std::bit_cast<double>((code << 24) + (std::uint64_t{1023 - 127} << 52));
}

}  // namespace vitrail
