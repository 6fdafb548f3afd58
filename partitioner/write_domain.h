// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "bundle/census.h"
#include "bundle/manifest.h"
#include "partitioner/cut.h"

namespace vitrail {

// What a domain file holds for a cell with these of the triangles.
DomainContent make_domain(const Manifest& manifest, const NumberedTriangles& triangles,
                          const CellContent& cell);

// Writes domain `index` of the bundle directory and counts it in the census. Returns its line in the
// manifest.
DomainInfo write_domain(const Manifest& manifest, const NumberedTriangles& triangles, const CellContent& cell,
                        const std::filesystem::path& bundle, std::uint32_t index, Census& census);

}  // namespace vitrail
