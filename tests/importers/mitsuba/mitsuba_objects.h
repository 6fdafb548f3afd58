// SPDX-License-Identifier: Apache-2.0
// Objects of a Mitsuba file for tests of parts of the reader: an XML loader without includes, defaults and
// older spellings, and properties by hand.
#pragma once

#include <filesystem>
#include <string>

#include "importers/mitsuba/read/builder.h"

namespace vitrail::mitsuba {

// The top-level objects of the scene in a file or text, in order. References have been followed.
Object load_objects(const std::filesystem::path& file);
Object load_objects_of_text(const std::string& xml);

// A Scene under construction, with what was said on the way.
struct TestBuilder {
  TestBuilder() : report(scene.files), builder{scene, report, {}, {}, {}, {}, {}} {}
  Scene scene;
  Report report;
  Builder builder;
};

// Reads the sensor, integrators, emitters, media and the emitters of shapes.
void read_all(Builder& builder, const Object& root);

}  // namespace vitrail::mitsuba
