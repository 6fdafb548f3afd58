// SPDX-License-Identifier: Apache-2.0
// This file divides a cell in memory into its domains.
#pragma once

#include <functional>
#include <mutex>

#include "bundle/census.h"
#include "partitioner/cutting/kd_plan.h"
#include "partitioner/cutting/work_estimate.h"
#include "partitioner/writing/write_domain.h"
#include "partitioner/writing/write_objects.h"

namespace vitrail {

// SharedCells are the cells that several domains share, as they are found. From any thread.
class SharedCells {
 public:
  // Returns the next number, from `planned` on, in any order.
  std::uint32_t take_number(std::uint32_t planned);
  void add(SharedCell cell);
  std::vector<SharedCell> take();

 private:
  std::mutex mutex_;
  std::uint32_t taken_ = 0;
  std::vector<SharedCell> cells_;
};

// All cells have a DomainWriter in common. They write to places of their own in the manifest.
struct DomainWriter {
  StoreDomain store;
  Manifest& manifest;  // kd_nodes and domains have their sizes
  Census& census;
  const InstanceDealer& instances;
  SharedCells& shared;
  std::uint64_t domain_bytes = 0;  // a domain with its objects; 0: they are not parted
  const WorkEstimate& work;
  std::uint64_t items = 0;                   // the scene's own triangles and instances
  bool median = false;                       // PlanRule::median
  std::size_t at_once = 1;                   // domains that are made at the same time
  std::function<void(std::uint64_t)> wrote;  // triangles and pieces of one domain, from any thread
};

// Divides a cell into the domains of the subtree and stores them. `cut` has the pieces of those of
// its triangles that are not whole in it. Where the objects in a cell take more than the writer's
// bytes, several domains share it.
void divide_cell(const NumberedTriangles& triangles, const CellContent& cut, const Subtree& subtree,
                 const DomainWriter& writer);

}  // namespace vitrail
