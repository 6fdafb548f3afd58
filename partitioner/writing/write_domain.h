// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>

#include "bundle/census.h"
#include "bundle/manifest.h"
#include "partitioner/cutting/cut.h"

namespace vitrail {

// Returns what a file holds of the triangles in a cell. If `padded`, their boxes are.
DomainContent make_domain(const NumberedTriangles& triangles, const CellContent& cell, bool padded);
// Adds instances, whose boxes are not inflated yet.
void add_instances(std::vector<InstanceRef> instances, std::span<const ObjectInfo> objects,
                   DomainContent& content);

// It stores a domain, and completes its line in the manifest with what its file says. From any thread.
using StoreDomain = std::function<void(std::uint32_t domain, DomainContent content, DomainInfo& info)>;

// Returns a StoreDomain that writes files of the bundle directory.
StoreDomain domain_files(std::filesystem::path bundle);

// Makes and stores domain `index` and counts it in the census. Returns its line in the
// manifest, whose objects are known.
DomainInfo write_domain(const Manifest& manifest, const NumberedTriangles& triangles, const CellContent& cell,
                        std::vector<InstanceRef> instances, const StoreDomain& store, std::uint32_t index,
                        Census& census);

}  // namespace vitrail
