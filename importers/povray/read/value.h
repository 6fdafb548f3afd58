// SPDX-License-Identifier: Apache-2.0
// An identifier of a POV-Ray scene can stand for a Value.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace vitrail::pov {

// It is a number (one term), a vector or a colour of up to five: x y z t or red green blue filter transmit.
struct Numbers {
  std::array<double, 5> v{};
  int terms = 1;
  bool is_color = false;  // five terms, linear

  Numbers() = default;
  explicit Numbers(double number) : v{number} {}
  static Numbers vector(double x, double y, double z) {
    Numbers n;
    n.v = {x, y, z, 0, 0}, n.terms = 3;
    return n;
  }
  // Returns the same with so many terms: a number fills all, a shorter vector gets zeros.
  Numbers promoted(int count) const {
    Numbers n = *this;
    n.terms = count;
    if (terms == 1)
      for (int i = 1; i < count; ++i) n.v[static_cast<std::size_t>(i)] = v[0];
    for (int i = terms == 1 ? count : std::min(terms, count); i < 5; ++i)
      n.v[static_cast<std::size_t>(i)] = 0;
    return n;
  }
};

struct Array;
struct Macro;
struct Function;
struct Spline;
struct Object;
struct Pigment;
struct Bump;
struct Finish;
struct Texture;
struct Interior;
struct MaterialParts;
struct CameraView;
struct SkySphere;
struct Fog;
struct MediaBlock;
struct BlendMap;
struct OpenFile;
struct Placement;

template <class T>
using Shared = std::shared_ptr<const T>;

// They are things that are read and dropped, by the statement that they are of: "fog".
struct Dropped {
  std::string kind;
};

using Value =
    std::variant<std::monostate, Numbers, std::string, std::shared_ptr<Array>, Shared<Macro>,
                 Shared<Function>, std::shared_ptr<Spline>, Shared<Object>, Shared<Pigment>, Shared<Bump>,
                 Shared<Finish>, Shared<Texture>, Shared<Interior>, Shared<MaterialParts>, Shared<CameraView>,
                 Shared<SkySphere>, Shared<Fog>, Shared<MediaBlock>, Shared<BlendMap>,
                 std::shared_ptr<OpenFile>, Shared<Placement>, Dropped>;

// Returns "a number", "a texture" … for messages.
const char* kind_of(const Value& value);

// It has elements in rows: those of the last dimension are next to each other.
struct Array {
  std::vector<std::size_t> sizes;
  std::vector<Value> elements;
  int levels = 1;  // of this and the following things: how many lie within each other (levels.h)
};

}  // namespace vitrail::pov
