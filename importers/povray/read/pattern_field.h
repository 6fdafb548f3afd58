// SPDX-License-Identifier: Apache-2.0
// Formulas ask for pigments and patterns at points (`function { pigment {…} }`).
#pragma once

#include <memory>
#include <vector>

#include "importers/povray/read/density_values.h"
#include "importers/povray/read/image_values.h"
#include "importers/povray/read/surface.h"
#include "scene/records/pattern_texture.h"

namespace vitrail::pov {

// It has values at a point of the space that has the pigment. It is thread-safe once it is made.
class PatternField {
 public:
  // Notes what is approximated; throws Error where an image cannot be read.
  PatternField(Reader& reader, const Pigment& pigment);

  // Returns red, green, blue, filter, transmit; in the numbers of the scene.
  Numbers color(Point3d p) const;
  // Returns the mean over the sphere of radius 1 around the origin, as of a sky.
  Numbers mean() const;
  // Returns the pattern's value alone: 0 … 1; of checker, brick, hexagon and object the place in their list.
  double value(Point3d p) const;

 private:
  struct Entry {
    double at = 0;
    Numbers color;
    std::shared_ptr<const PatternField> pigment;  // in place of the colour
    Numbers at_point(Point3d p) const { return pigment ? pigment->color(p) : color; }
  };
  Point3d moved(Point3d p) const;
  double own_value(Point3d p) const;
  Numbers blended(Point3d p) const;
  Numbers average(Point3d p) const;

  Numbers color_;
  bool plain_ = false;  // of this one colour
  Pattern pattern_;
  Transform from_object_;
  PatternTexture record_;  // its kind, if the record has it, and its wave
  bool recorded_ = false;
  std::vector<Entry> entries_;
  std::shared_ptr<const ImageValues> image_;
  std::shared_ptr<const DensityValues> density_;
  std::shared_ptr<const PatternField> inner_;  // of pigment_pattern
};

}  // namespace vitrail::pov
