// SPDX-License-Identifier: Apache-2.0
// A small bundle made by hand, with something in every field.
#pragma once

#include <filesystem>

#include "bundle/manifest.h"

namespace vitrail::test {

// Two clusters under a root, normals, and one piece.
DomainContent sample_domain();
// Three domains, all kinds of materials, lights and spectra.
Manifest sample_manifest();
// Writes the manifest and three copies of the domain to the empty directory `bundle`, and enters them in the
// manifest.
void write_sample_bundle(const std::filesystem::path& bundle);

std::string read_text(const std::filesystem::path& file);
// Overwrites a file that exists.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace vitrail::test
