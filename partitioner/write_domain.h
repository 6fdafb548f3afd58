// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "bundle/census.h"
#include "bundle/manifest.h"
#include "partitioner/cut.h"

namespace vitrail {

// What a file holds of these of the triangles.
DomainContent make_domain(const NumberedTriangles& triangles, const CellContent& cell, float padding);
// The boxes of the instances are not inflated yet.
void add_instances(std::vector<InstanceRef> instances, float padding, DomainContent& content);

// Writes domain `index` of the bundle directory and counts it in the census. Returns its line in the
// manifest, whose objects are known.
DomainInfo write_domain(const Manifest& manifest, const NumberedTriangles& triangles, const CellContent& cell,
                        std::vector<InstanceRef> instances, const std::filesystem::path& bundle,
                        std::uint32_t index, Census& census);

}  // namespace vitrail
