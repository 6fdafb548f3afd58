// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "bundle/domain_layout.h"
#include "bundle/packs.h"
#include "bundle/texture_file.h"
#include "cli/inspect/inspect.h"

namespace vitrail {

namespace {

std::string hexadecimal(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

int depth_of(std::span<const BvhNode> tree) {
  std::vector<int> depth(tree.size(), 1);
  int deepest = 0;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    deepest = std::max(deepest, depth[i]);
    for (const std::uint32_t child : tree[i].child)
      if (!(child & BvhNode::cluster_bit)) depth[child] = depth[i] + 1;
  }
  return deepest;
}

Report sections_of(const MappedDomain& mapped) {
  Report sections = Report::array();
  for (const layout::Section& s : mapped.sections())
    sections.push_back({{"section", s.kind < layout::section_count ? layout::section_name[s.kind]
                                                                   : fmt::format("kind {}", s.kind)},
                        {"offset", s.offset},
                        {"count", s.count},
                        {"bytes", layout::padded_bytes(s.count, s.element_size)},
                        {"checksum", hexadecimal(s.checksum)}});
  return sections;
}

Report to_json(const Bounds3f& box) {
  if (box.empty()) return nullptr;
  return {{"lower", {box.lower.x, box.lower.y, box.lower.z}},
          {"upper", {box.upper.x, box.upper.y, box.upper.z}}};
}

}  // namespace

Report inspect_pack(const std::filesystem::path& file) {
  Report domains = Report::array();
  for (const Stored& stored : domains_of_pack(file)) domains.push_back(inspect_domain(stored));
  return {{"file", file.string()},
          {"kind", "pack of sub-domains"},
          {"bytes", std::filesystem::file_size(file)},
          {"domains", std::move(domains)}};
}

Report inspect_domain(const Stored& stored) {
  const std::filesystem::path file = stored.name();
  const MappedDomain mapped(stored);
  mapped.check_cold();
  const DomainView& view = mapped.view();
  const auto [pieces, piece_vertices] = mapped.pieces();
  const std::uint64_t triangles = triangles_in(view.clusters);
  const auto clusters = static_cast<double>(std::max<std::size_t>(view.clusters.size(), 1));
  std::set<std::uint32_t> objects;
  for (const InstanceRef& ref : view.instances) objects.insert(ref.object);
  const Features& features = mapped.header().features;
  return {{"file", file.string()},
          {"kind", "sub-domain or object"},
          {"version", mapped.header().version},
          {"required_features", required_names(features.required)},
          {"optional_features", optional_names(features.optional)},
          {"bytes", mapped.bytes()},
          {"hash", hexadecimal(mapped.hash())},
          {"triangles", triangles},
          {"pieces", pieces.size()},
          {"piece_vertices", piece_vertices.size()},
          {"shading_normals", !view.normals.empty()},
          {"clusters", view.clusters.size()},
          {"triangles_per_cluster", static_cast<double>(triangles) / clusters},
          {"nodes", view.nodes.size()},
          {"depth", depth_of(view.nodes)},
          {"instances", view.instances.size()},
          {"instance_nodes", view.instance_nodes.size()},
          {"instance_depth", depth_of(view.instance_nodes)},
          {"objects", objects},
          {"bounds", to_json(content_bounds(view))},
          {"sections", sections_of(mapped)},
          {"checksums", "all correct"}};
}

Report inspect_texture(const std::filesystem::path& file) {
  constexpr std::array names{"number",
                             "vector of 8 bits",
                             "vector of 16 bits",
                             "vector of floats",
                             "reflectance",
                             "unbounded",
                             "illuminant",
                             "reflectance by Matrix-R",
                             "unbounded by Matrix-R",
                             "illuminant by Matrix-R",
                             "reflectance by codes of 8 bits",
                             "number by codes of 8 bits",
                             "illuminant by codes of 8 bits",
                             "illuminant by codes of 16 bits",
                             "bands",
                             "bands by codes of 8 bits"};
  static_assert(names.size() == texel_format_count);
  const TextureFile texture(file);
  texture.check_tiles();
  const TextureFileInfo& info = texture.info();
  return {{"file", file.string()},
          {"kind", "texture"},
          {"version", texture_version},
          {"required_features", required_names(texture.features().required)},
          {"optional_features", optional_names(texture.features().optional)},
          {"bytes", texture.layout().file_bytes},
          {"hash", hexadecimal(texture.hash())},
          {"format", names[static_cast<std::size_t>(info.format)]},
          {"width", info.width},
          {"height", info.height},
          {"levels", info.levels},
          {"tiles", texture.layout().tiles},
          {"checksums", "all correct"}};
}

}  // namespace vitrail
