// SPDX-License-Identifier: Apache-2.0
// A small bundle made by hand, with something in every field.
#pragma once

#include <filesystem>

#include "bundle/manifest.h"

namespace vitrail::test {

// Two clusters under a root, normals, and one piece.
DomainContent sample_domain();
// Two triangles; number 1 has an instance of number 0.
InstanceRef sample_instance(std::uint32_t object, std::uint32_t first_triangle);
DomainContent sample_object(std::uint32_t number);
// Three domains, all kinds of materials, lights and spectra.
Manifest sample_manifest();
// Adds objects 0 and 1, and an instance of 1, whose triangles are [11, 15), to the domains.
void add_objects(Manifest& manifest);
// Writes the manifest and three copies of the domain to the empty directory `bundle`, and enters them in the
// manifest.
void write_sample_bundle(const std::filesystem::path& bundle);

// One in which every triangle is held once, with everything in it: pieces of triangle 3 in domains 0 and 1,
// domain 2 with an instance alone, normals, (u,v), an attribute, objects, an image.
struct SampleBundle {
  Manifest manifest;
  std::vector<DomainContent> domains, objects;
};
SampleBundle whole_bundle();
// Enters bytes and hashes in the manifest.
void write(SampleBundle& sample, const std::filesystem::path& bundle);

std::string read_text(const std::filesystem::path& file);
// Overwrites a file that exists.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace vitrail::test
