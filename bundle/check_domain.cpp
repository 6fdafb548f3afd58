// SPDX-License-Identifier: Apache-2.0
// Whether files of domains, objects and textures are the ones that the manifest speaks of.
#include <fmt/format.h>

#include <algorithm>

#include "bundle/manifest.h"
#include "bundle/texture_file.h"
#include "bundle/triangle_number.h"
#include "scene/shapes/curve.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

constexpr const char* another_file =
    "this file is not the one that the bundle was made with; partition the scene again";

// What the manifest says of a file.
struct Expected {
  std::uint64_t bytes, hash;
  std::uint64_t triangles;  // ids are below
  std::span<const Surface> surfaces;
  std::span<const std::uint32_t> objects;  // that instances may be of, ascending
};

void check(const Manifest& manifest, const Expected& expected, const MappedDomain& mapped,
           const std::filesystem::path& file) {
  const auto reject = [&](const std::string& what) { throw Error(what, {file.string()}); };
  if (mapped.hash() != expected.hash || mapped.bytes() != expected.bytes) reject(another_file);
  const DomainView& view = mapped.view();
  const auto one_a_cluster = [&](bool required) { return required ? view.clusters.size() : 0; };
  if (view.normals.size() != one_a_cluster(manifest.requirements.shading_normals) ||
      view.uvs.size() != one_a_cluster(manifest.requirements.uv))
    reject("it does not hold the normals or (u,v) that the scene has");
  if (view.attributes.size() != view.clusters.size() * manifest.attributes)
    reject("it does not hold the mesh attributes that the scene has");
  const auto numbers = std::min<std::uint64_t>(expected.triangles, triangle_numbers);
  const std::uint64_t first = expected.surfaces.empty() ? no_triangle : expected.surfaces[0].first_triangle;
  for (const Cluster& cluster : view.clusters)
    for (const std::uint32_t id : cluster.id)
      if (id != no_triangle && (id >= numbers || id < first))
        reject(fmt::format("it holds triangle {}, which the scene does not have", id));
  for (const InstanceRef& ref : view.instances)
    if (!std::ranges::binary_search(expected.objects, ref.object) || ref.first_triangle >= numbers ||
        (expected.triangles <= triangle_numbers &&
         ref.first_triangle + manifest.objects[ref.object].triangles > expected.triangles))
      reject(fmt::format("it holds an instance of object {}, which the scene does not have", ref.object));
  for (std::size_t i = 0; i < view.instances.size(); ++i) {
    const InstanceRef& ref = view.instances[i];
    const auto& quadric = manifest.objects[ref.object].quadric;
    if (quadric && is_curve(quadric->quadric) && !is_valid(unpacked_curve(ref.to_parent.m)))
      reject(fmt::format("instance {} is no curve", i));
  }
}

}  // namespace

void check_domain(const Manifest& manifest, std::uint32_t domain, const MappedDomain& mapped,
                  const std::filesystem::path& file) {
  const DomainInfo& d = manifest.domains.at(domain);
  check(manifest, {d.bytes, d.hash, manifest.triangles, scene_surfaces(manifest), d.objects}, mapped, file);
}

void check_object(const Manifest& manifest, std::uint32_t object, const MappedDomain& mapped,
                  const std::filesystem::path& file) {
  const ObjectInfo& o = manifest.objects.at(object);
  check(manifest, {o.bytes, o.hash, o.triangles, surfaces_of(manifest, o), o.objects}, mapped, file);
}

void check_texture(const TextureFileEntry& expected, const TextureFile& texture,
                   const std::filesystem::path& file) {
  if (texture.hash() != expected.hash || texture.layout().file_bytes != expected.bytes)
    throw Error(another_file, {file.string()});
}

}  // namespace vitrail
