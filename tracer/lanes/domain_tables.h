// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bundle/domain_file.h"

namespace vitrail::lanes {

// It holds the tables of a DomainView; an empty table is null.
struct DomainTables {
  const Cluster* clusters = nullptr;
  const ClusterNormals* normals = nullptr;
  const ClusterUvs* uvs = nullptr;
};

inline DomainTables tables_of(const DomainView& view) {
  return {view.clusters.data(), view.normals.empty() ? nullptr : view.normals.data(),
          view.uvs.empty() ? nullptr : view.uvs.data()};
}

}  // namespace vitrail::lanes
