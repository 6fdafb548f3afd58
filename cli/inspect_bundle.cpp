// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "bundle/census.h"
#include "bundle/loaded_domain.h"
#include "cli/inspect.h"
#include "cli/sizes.h"

namespace vitrail {

namespace {

constexpr double most_area_error = 1e-6;

std::size_t filled_lanes(const DomainView& view) {
  std::size_t filled = 0;
  for (const Cluster& c : view.clusters)
    for (const std::uint32_t id : c.id) filled += id != no_triangle;
  return filled;
}

int depth_of(const DomainView& view) {
  std::vector<int> depth(view.nodes.size(), 1);
  int deepest = 0;
  for (std::size_t i = 0; i < view.nodes.size(); ++i) {
    deepest = std::max(deepest, depth[i]);
    for (const std::uint32_t child : view.nodes[i].child)
      if (!(child & BvhNode::cluster_bit)) depth[child] = depth[i] + 1;
  }
  return deepest;
}

void check_counts(const DomainInfo& info, const MappedDomain& mapped, const std::filesystem::path& file) {
  if (info.triangles != filled_lanes(mapped.view()) || info.pieces != mapped.pieces().size() ||
      info.instances != mapped.view().instances.size())
    throw Error("it does not hold as many triangles as the manifest says", {file.string()});
}

// Of all domains, each once.
std::vector<IdRange> ids_of_instances(const Manifest& m, const std::filesystem::path& bundle) {
  std::map<std::uint64_t, std::uint64_t> counts;
  for (std::uint32_t i = 0; i < m.domains.size() && !m.objects.empty(); ++i) {
    const SharedDomain mapped = map_domain(m, bundle, i);
    for (const InstanceRef& ref : mapped->view().instances)
      counts[ref.first_triangle] = m.objects[ref.object].triangles;
  }
  std::vector<IdRange> ranges;
  for (const auto& [first, count] : counts) ranges.push_back({first, count});
  return ranges;
}

Report domain_line(std::uint32_t index, const DomainInfo& d) {
  const Vector3f size = extent(d.tight_bounds);
  return {{"domain", index},
          {"triangles", d.triangles},
          {"pieces", d.pieces},
          {"bytes", d.bytes},
          {"extent", fmt::format("{:.4g} × {:.4g} × {:.4g}", size.x, size.y, size.z)}};
}

}  // namespace

Report inspect_bundle(const std::filesystem::path& bundle) {
  const Manifest m = read_manifest(bundle);
  Census census(m.triangles, ids_of_instances(m, bundle));
  Report domains = Report::array();
  std::uint64_t bytes = 0;
  for (std::uint32_t i = 0; i < m.domains.size(); ++i) {
    const std::filesystem::path file = domain_path(bundle, i);
    const MappedDomain mapped(file);
    check_domain(m, i, mapped, file);
    check_counts(m.domains[i], mapped, file);
    census.add(i, mapped.view(), mapped.pieces(), mapped.piece_vertices());
    domains.push_back(domain_line(i, m.domains[i]));
    bytes += mapped.bytes();
  }
  for (std::uint32_t i = 0; i < m.objects.size(); ++i) bytes += map_object(m, bundle, i)->bytes();
  const CensusResult found = census.result();
  Report r{{"file", bundle.string()}, {"kind", "bundle"}, {"size", format_bytes(bytes)}};
  r.update(describe(m));
  r["checksums"] = "all correct";
  r["ghost_free"] = found.duplicates == 0 && found.lost == 0 && found.area_error < most_area_error &&
                    found.cut_triangles == m.cut_triangles;
  r["cut_triangles"] = found.cut_triangles;
  r["pieces"] = found.pieces;
  r["duplicates"] = found.duplicates;
  r["lost"] = found.lost;
  r["area_error"] = found.area_error;
  r["domains"] = std::move(domains);
  return r;
}

Report inspect_domain(const std::filesystem::path& file) {
  const MappedDomain mapped(file);
  const DomainView& view = mapped.view();
  const std::size_t filled = filled_lanes(view);
  const auto clusters = static_cast<double>(std::max<std::size_t>(view.clusters.size(), 1));
  return {{"file", file.string()},
          {"kind", "sub-domain"},
          {"size", format_bytes(mapped.bytes())},
          {"triangles", filled},
          {"pieces", mapped.pieces().size()},
          {"piece_vertices", mapped.piece_vertices().size()},
          {"shading_normals", !view.normals.empty()},
          {"instances", view.instances.size()},
          {"clusters", view.clusters.size()},
          {"triangles_per_cluster", static_cast<double>(filled) / clusters},
          {"nodes", view.nodes.size()},
          {"depth", depth_of(view)},
          {"checksums", "all correct"}};
}

}  // namespace vitrail
