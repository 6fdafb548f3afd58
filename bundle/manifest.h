// SPDX-License-Identifier: Apache-2.0
// The manifest is what every rank knows of a bundle without loading a domain. It has the kd-tree, the
// domains' tight bounds, the surfaces, materials and lights, the camera. Coordinates are the bundle's: the
// world's minus `offset`.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bundle/domain_file.h"
#include "bundle/features.h"
#include "bundle/occupancy.h"
#include "bundle/oriented_quadric.h"
#include "scene/geometry/bounds.h"
#include "scene/records/scene.h"

namespace vitrail {

class TextureFile;

// Node 0 is the root. A leaf is one domain.
struct KdNode {
  static constexpr std::uint32_t leaf_bit = 0x80000000u;
  // This value stands in place of an axis where no plane parts the children, which share the cell. The first
  // such node on a way has below it the domain with the scene's own triangles and the points of the cell. Its
  // `split` is how many domains share the cell: they are numbered in a row from that one. Each may be a leaf
  // in several places; a ray visits it once, at the first of them, for all of its way.
  static constexpr std::uint32_t no_axis = 3;
  float split = 0;                            // coordinate of the interface on `axis`, or as above
  std::uint32_t axis = 0;                     // 0, 1, 2, or no_axis
  std::uint32_t below = 0, above = leaf_bit;  // index of a node, or leaf_bit | domain
  bool operator==(const KdNode&) const = default;
};

// A PackPlace says where in the packs (packs.h) a domain is.
struct PackPlace {
  std::uint32_t pack = 0;
  std::uint64_t offset = 0;  // bytes
  auto operator<=>(const PackPlace&) const = default;
};

// It holds what the manifest knows of a domain's file.
struct DomainInfo {
  std::uint64_t triangles = 0;  // whole triangles and pieces in it
  std::uint64_t pieces = 0;     // of which pieces
  std::uint64_t bytes = 0;      // of its file
  std::uint64_t hash = 0;       // MappedDomain::hash of its file
  Bounds3f tight_bounds;  // of the triangles' and instances' parts in it, padded; empty when it has none
  Occupancy occupancy;    // which cells of the tight bounds hold any of these parts, padded
  std::uint64_t instances = 0;         // that reach into it
  std::vector<std::uint32_t> objects;  // that tracing it needs, ascending: its instances' and what they need
  std::optional<PackPlace> pack;       // none: it is a file of its own
  bool operator==(const DomainInfo&) const = default;
};

// Instances refer to objects. An object is a prototype, a part of a large one, or a quadric, which has no
// file. Its ids count its own triangles first, then those of its instances; parts of one prototype share the
// ids.
struct ObjectInfo {
  std::uint64_t triangles = 0;                         // ids are [0, triangles)
  std::uint64_t bytes = 0;                             // of its file
  std::uint64_t hash = 0;                              // MappedDomain::hash of its file
  std::uint32_t first_surface = 0, surface_count = 0;  // the surfaces of its own triangles
  std::vector<std::uint32_t> objects;      // that its own instances are of, ascending, below its own number
  std::optional<OrientedQuadric> quadric;  // with one id
  Motion motion;           // of all that is in it, within the coordinates that its instances place
  bool continues = false;  // it is a further part of the prototype that the object before it is of
  bool operator==(const ObjectInfo&) const = default;
};

// Triangles [first_triangle, first_triangle of the next surface) share a material, an emission and the media
// on their sides.
struct Surface {
  std::uint32_t first_triangle = 0;
  std::uint32_t material = 0;
  std::int32_t area_light = -1;  // index, or −1: no light
  // They are indices of the media behind and in front, −1: vacuum. Where the two are the same, the surface
  // stands in a medium and does not bound one.
  std::int32_t interior = -1, exterior = -1;
  FloatParameter opacity = 1.0f;  // as a Shape's
  // It bounds how far the file's rounding to decimals may have moved the vertices of smooth glass under a
  // distant light. It is in the coordinates of the scene, or of the object; 0 for other surfaces.
  float vertex_doubt = 0;
  bool operator==(const Surface&) const = default;
};

// Returns whether the surface is a light that connections go to.
inline bool is_lamp(std::span<const AreaLight> lights, const Surface& surface) {
  return surface.area_light >= 0 && lights[static_cast<std::size_t>(surface.area_light)].sampled;
}

// It is one triangle that emits, replicated on every rank for light sampling. It is wound so that its front
// emits.
struct EmissiveTriangle {
  Point3f p[3];
  Point2f uv[3];
  std::uint32_t triangle = 0;    // global id
  std::uint32_t area_light = 0;  // index
};

// It is one quadric that emits from its front, likewise replicated.
struct EmissiveQuadric {
  OrientedQuadric quadric;
  Affine to_bundle{};
  std::uint32_t triangle = 0;     // global id
  std::uint32_t area_light = 0;   // index
  FloatParameter opacity = 1.0f;  // of its surface
};

// It holds a mesh attribute at the corners of a triangle: [vertex][channel].
using CornerValues = std::array<std::array<float, 3>, 3>;

// They say what the scene needs of a renderer; everything that is false costs nothing.
struct Requirements {
  bool shading_normals = false;
  bool uv = false;          // some texture, tangent or light is looked up by (u,v)
  bool filtering = false;   // some image is filtered by the width of the ray's cone
  bool dispersion = false;  // some smooth surface refracts by an index that depends on λ
  bool refraction = false;  // some smooth surface refracts
  // It says that some surface lets light straight through: interfaces, masks, thin sheets, opacities.
  bool see_through = false;
  bool media = false;
  bool motion = false;  // the camera or an object moves
  bool operator==(const Requirements&) const = default;
};

// A TextureFileEntry describes a file of textures/.
struct TextureFileEntry {
  std::string name;  // "textures/000003.tex"
  std::uint64_t bytes = 0, hash = 0;
  std::uint64_t read_bytes =
      0;  // of its texels in memory, where the file has codes; else 0, and they are `bytes`
  bool operator==(const TextureFileEntry&) const = default;
};

// It is the most mesh attributes that the textures of a bundle read.
inline constexpr std::uint32_t max_attributes = 8;

// A Manifest holds all of a bundle but its domains, objects and textures.
struct Manifest {
  std::uint64_t triangles = 0;      // global ids are [0, triangles)
  std::uint64_t cut_triangles = 0;  // of which straddle an interface
  Vector3d offset;                  // world = bundle + offset
  Bounds3f bounds;                  // of all triangles
  std::optional<Bounds3f> core;     // of all but a few that lie far away, where there are such
  float scale = 0;                  // greatest |coordinate| of a vertex
  std::vector<KdNode> kd_nodes;     // empty when there is one domain
  std::vector<DomainInfo> domains;
  std::vector<ObjectInfo> objects;
  // They ascend by first_triangle: those of the scene's own triangles, then each object's, in its ids.
  std::vector<Surface> surfaces;
  // They are the scene's own records. Their spectra are `resolved`, their transforms end in the bundle's
  // coordinates, and their filenames name texture files.
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<ScatteringTable> tables;  // of tabulated materials; each once
  std::vector<Medium> media;
  std::vector<AreaLight> area_lights;
  std::vector<EmissiveTriangle> emissive_triangles;
  // They hold the triangles' mesh attributes, [triangle][slot]; empty where no area light reads one.
  std::vector<CornerValues> emissive_attributes;
  std::vector<FloatParameter> emissive_opacities;  // their surfaces'; empty where all are 1
  std::vector<EmissiveQuadric> emissive_quadrics;
  std::vector<Light> lights;
  Camera camera;
  Motion camera_motion;
  Shutter shutter;
  std::int32_t camera_medium = -1;  // index, or −1: vacuum
  std::vector<TextureFileEntry> texture_files;
  std::uint32_t attributes = 0;  // mesh attributes that textures read: slots a vertex
  std::uint32_t switching_glazings =
      0;  // systems in glazing.json; where there are none there is no such file
  FilmSettings film;
  RenderSettings settings;
  Requirements requirements;
  std::uint64_t scene_hash =
      0;  // of all triangles and records, whatever the cuts: equal scenes have equal hashes
};

// Returns the bounds of the scene without the few triangles that lie far away.
inline Bounds3f core_of(const Manifest& m) { return m.core.value_or(m.bounds); }

// The walk visits both sides of an interface within this distance, which is more than the padding of any
// triangle.
inline double interface_epsilon(const Manifest& m) { return 2 * padding(double{m.scale}); }
// The cells of domains are marked with this margin more. The way of a ray through them is as certain if it
// starts within 128 scales.
inline double cell_margin(const Manifest& m) { return 0x1p-40 * double{m.scale} + 1e-37; }

// It is the most planes on the way from the root of a kd-tree to a domain.
inline constexpr int max_kd_depth = 62;

// Domains in a pack begin at multiples of this.
inline constexpr std::uint64_t pack_page = 4096;

// They return the file of a domain, of an object and of a pack of domains.
std::filesystem::path domain_path(const std::filesystem::path& bundle, std::uint32_t domain);
std::filesystem::path object_path(const std::filesystem::path& bundle, std::uint32_t object);
std::filesystem::path pack_path(const std::filesystem::path& bundle, std::uint32_t pack);

// Returns where a domain is: its file, or its part of a pack.
Stored stored_domain(const Manifest& m, const std::filesystem::path& bundle, std::uint32_t domain);

// They return whether any surface has a vertex doubt, and whether any material casts no shadow.
bool has_vertex_doubts(const Manifest& m);
bool has_shadowless_materials(const Manifest& m);

// They return the surfaces of triangles that no instance has, and those of an object's own triangles.
std::span<const Surface> scene_surfaces(const Manifest& m);
std::span<const Surface> surfaces_of(const Manifest& m, const ObjectInfo& object);

// Returns the bytes of a domain's file and of those of all objects that it needs.
std::uint64_t bytes_needed(const Manifest& manifest, std::uint32_t domain);

// Returns the features of the bundle; its files have no others.
Features features_of(const Manifest& m);

// These files beside manifest.json have its binary records.
inline constexpr std::array records_file_names{"materials.bin", "lights.bin", "domains.bin"};

// Writes manifest.json and the files of records. Throws MachineError.
void write_manifest(const std::filesystem::path& bundle, const Manifest& manifest);

// Reads and checks everything but the domain files. Throws Error (bad content, with the file's name).
Manifest read_manifest(const std::filesystem::path& bundle);

// Reads the kd-tree, domains and objects alone, unchecked. Throws Error where domains.bin is damaged.
Manifest read_domains(const std::filesystem::path& bundle);

// Throw Error where a file is not the one that the manifest speaks of, or holds triangles it does not have.
void check_domain(const Manifest& manifest, std::uint32_t domain, const MappedDomain& mapped,
                  const std::filesystem::path& file);
void check_object(const Manifest& manifest, std::uint32_t object, const MappedDomain& mapped,
                  const std::filesystem::path& file);
void check_texture(const TextureFileEntry& expected, const TextureFile& texture,
                   const std::filesystem::path& file);
// Throws Error where a file of records is not whole by itself.
void check_records_file(const std::filesystem::path& file);

}  // namespace vitrail
