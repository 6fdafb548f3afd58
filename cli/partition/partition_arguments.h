// SPDX-License-Identifier: Apache-2.0
// This file is the command line of `vitrail partition`.
#pragma once

#include <CLI/CLI.hpp>

#include "cli/common/bundle_origin.h"
#include "cli/common/import_arguments.h"
#include "cli/common/mesh_options.h"
#include "partitioner/partition.h"

namespace vitrail {

struct PartitionArguments {
  std::filesystem::path input, output, stats, profile;
  std::string domain_bytes, pack, memory, aov, progress = "auto";
  bool force = false, strict = false, quiet = false, summary = true, cached = true, keeps_domains = false;
  bool view_only = false;
  ImportArguments imports;
  std::string rgb;
  MeshOptions meshes;
  std::optional<FilmLayers> layers;  // none: the scene's
  PartitionOptions options{.durable = true};
};

void declare(CLI::App& app, PartitionArguments& arguments);

// Returns what the bundle will say that it was made of, and how.
BundleOrigin origin_of(const PartitionArguments& arguments);

}  // namespace vitrail
