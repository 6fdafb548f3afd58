// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <string_view>

#include "bundle/binary_records.h"
#include "bundle/checksum.h"
#include "bundle/manifest_json.h"
#include "bundle/record_fields.h"
#include "bundle/triangle_number.h"
#include "scene/daylight/daylight_illuminant.h"
#include "scene/records/film_extent.h"
#include "scene/records/nesting_limits.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

struct Checker {
  const std::filesystem::path& file;
  void require(bool condition, const char* what) const {
    if (!condition)
      throw Error(fmt::format("the scene cannot be kept in a bundle: {}", what), {file.string()});
  }
};

}  // namespace

namespace records {

struct FieldChecker {
  static constexpr bool reads = false;
  const std::filesystem::path& file;
  std::size_t textures = 0, materials = 0;  // that may be referred to
  void require(bool condition, const char* what) const { vitrail::Checker{file}.require(condition, what); }
  template <Number T>
  void operator()(T value) const {
    if constexpr (std::floating_point<T>) require(std::isfinite(value), "a number is not finite");
  }
  void operator()(Id<Texture> id) const { require(id.value < textures, "a texture is not there"); }
  void operator()(Id<ScatteringTable>) const {}  // check_tables
  void operator()(Id<Material> id) const { require(id.value < materials, "a material is not there"); }
  void may_be_infinite(float value) const { require(!std::isnan(value), "a number is not a number"); }
};

}  // namespace records

namespace {

template <class V>
bool finite(const V& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void check_film(const Checker& c, const FilmSettings& f) {
  c.require(f.width > 0 && f.height > 0, "the film has no pixels");
  c.require(f.width <= max_film_extent && f.height <= max_film_extent,
            "the film has more than 1048576 pixels a side");
  c.require(0 <= f.crop.x0 && f.crop.x0 < f.crop.x1 && f.crop.x1 <= f.width && 0 <= f.crop.y0 &&
                f.crop.y0 < f.crop.y1 && f.crop.y1 <= f.height,
            "the crop window is empty or not within the film");
  c.require(std::isfinite(f.imaging_ratio), "the imaging ratio is not finite");
  c.require(f.working_gamma >= 0 && std::isfinite(f.working_gamma), "the film's gamma is negative");
  const SpectralBins& bins = f.spectrum;
  c.require(bins.count >= 0 && bins.count <= max_spectral_bins && bins.min_nm < bins.max_nm &&
                std::isfinite(bins.max_nm - bins.min_nm),
            "the film's spectral bins are too many or empty");
  std::visit(
      [&](const auto& filter) {
        c.require(0 < filter.radius_x && filter.radius_x <= max_film_extent && 0 < filter.radius_y &&
                      filter.radius_y <= max_film_extent,
                  "the radius of the pixel filter is not above 0, or more than 1048576 pixels");
      },
      f.filter);
  if (const auto* gaussian = std::get_if<GaussianFilter>(&f.filter))
    c.require(gaussian->sigma > 0 && std::isfinite(gaussian->sigma),
              "σ of the pixel filter is not a positive number");
  if (const auto* mitchell = std::get_if<MitchellFilter>(&f.filter))
    c.require(std::isfinite(mitchell->b) && std::isfinite(mitchell->c),
              "B or C of the pixel filter is not finite");
  if (const auto* sinc = std::get_if<SincFilter>(&f.filter))
    c.require(sinc->tau > 0 && std::isfinite(sinc->tau), "τ of the pixel filter is not a positive number");
}

void check_surfaces(const Checker& c, const Manifest& m, std::span<const Surface> surfaces,
                    std::uint64_t triangles) {
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const Surface& s = surfaces[i];
    c.require(s.first_triangle < triangles && (i == 0 || s.first_triangle > surfaces[i - 1].first_triangle),
              "its surfaces are out of order");
    c.require(s.material < m.materials.size(), "a surface has no material");
    for (const std::int32_t medium : {s.interior, s.exterior})
      c.require(medium >= -1 && medium < static_cast<std::int64_t>(m.media.size()),
                "a surface has a medium that is not there");
    c.require(s.area_light >= -1 && s.area_light < static_cast<std::int64_t>(m.area_lights.size()),
              "a surface has a light that is not there");
    c.require(s.vertex_doubt >= 0 && std::isfinite(s.vertex_doubt),
              "a surface has vertices that stand anywhere");
  }
}

void check_triangles(const Checker& c, const Manifest& m) {
  c.require(m.triangles <= most_triangles, "it has too many triangles");
  c.require(m.cut_triangles <= m.triangles, "more triangles are cut than there are");
  const std::size_t first = m.objects.empty() ? m.surfaces.size() : m.objects[0].first_surface;
  c.require(first <= m.surfaces.size(), "an object has surfaces that are not there");
  const std::span<const Surface> own = scene_surfaces(m);
  if (m.objects.empty())
    c.require(own.empty() == (m.triangles == 0) && (own.empty() || own[0].first_triangle == 0),
              "its surfaces do not begin at triangle 0");
  check_surfaces(c, m, own, m.triangles);
}

void check_shape(const Checker& c, const Quadric& q) {
  const bool from_zero = q.kind == QuadricKind::disk || q.kind == QuadricKind::paraboloid;
  c.require(q.low >= (from_zero ? 0 : -1), "a quadric begins below its least");
  c.require(q.low < q.high && q.high <= 1 && q.phi_max_rad > 0, "a quadric has no surface");
}

void check_quadric(const Checker& c, const OrientedQuadric& q, const ObjectInfo& o) {
  check_shape(c, q.quadric);
  c.require(o.triangles == 1 && o.objects.empty() && o.surface_count == 1, "a quadric is not by itself");
}

// Objects refer to smaller numbers, so no chain of instances comes back to where it was.
void check_objects(const Checker& c, const Manifest& m) {
  std::vector<int> depth(m.objects.size(), 1);
  bool moves = m.camera_motion.moves();
  for (std::size_t i = 0; i < m.objects.size(); ++i) {
    const ObjectInfo& o = m.objects[i];
    c.require(!o.continues || (i > 0 && m.objects[i - 1].triangles == o.triangles),
              "an object continues no other");
    c.require(o.triangles > 0 && o.triangles <= m.triangles, "an object has no triangles, or too many");
    c.require(o.first_surface >= m.objects[0].first_surface &&
                  std::uint64_t{o.first_surface} + o.surface_count <= m.surfaces.size(),
              "an object has surfaces that are not there");
    check_surfaces(c, m, surfaces_of(m, o), o.triangles);
    if (o.quadric) check_quadric(c, *o.quadric, o);
    moves = moves || o.motion.moves();
    for (const std::uint32_t other : o.objects) {
      c.require(other < i, "an object holds itself");
      depth[i] = std::max(depth[i], depth[other] + 1);
    }
    c.require(depth[i] <= max_instance_depth, "instances are nested too deep");
  }
  c.require(moves == m.requirements.motion, "it says that something moves, or nothing, and that is not so");
  c.require(std::isfinite(m.shutter.open_s) && m.shutter.open_s <= m.shutter.close_s &&
                std::isfinite(m.shutter.close_s),
            "the shutter closes before it has opened");
  for (const DomainInfo& d : m.domains) {
    const Bounds3f& box = d.tight_bounds;
    c.require(box == Bounds3f{} || (!box.empty() && finite(box.lower) && finite(box.upper)),
              "a domain's bounds end before they begin, or nowhere");
    c.require(std::ranges::is_sorted(d.objects), "the objects of a domain are out of order");
    for (const std::uint32_t object : d.objects) {
      c.require(object < m.objects.size(), "a domain needs an object that is not there");
      for (const std::uint32_t other : m.objects[object].objects)
        c.require(std::ranges::binary_search(d.objects, other),
                  "a domain does not name all objects that it needs");
    }
  }
}

// Whatever the records hold, by their lists of fields: numbers are finite, ids refer to what is there.
void check_records(const Checker& c, const Manifest& m) {
  records::FieldChecker io{c.file};
  for (const Texture& t : m.textures) records::fields(io, t), ++io.textures;
  for (const Material& material : m.materials) records::fields(io, material), ++io.materials;
  for (const Nesting& nesting : nesting_of(m.materials))
    c.require(nesting.levels <= most_nested_baked && nesting.lookups <= most_lookups_baked,
              "a material is nested too deeply");
  records::list(io, m.media), records::list(io, m.area_lights), records::list(io, m.lights);
  records::list(io, m.emissive_triangles), records::list(io, m.emissive_attributes);
  records::list(io, m.emissive_quadrics);
  for (const Surface& s : m.surfaces) records::fields(io, s.opacity);
  for (const ObjectInfo& o : m.objects) records::fields(io, o);
  records::list(io, m.emissive_opacities);
  records::fields(io, m.camera);
}

void check_sheets(const Checker& c, const Manifest& m) {
  for (const Material& material : m.materials) {
    const auto* measured = std::get_if<MeasuredMaterial>(&material.model);
    if (!measured) continue;
    c.require(measured->sheet.has_value(), "a measured material has no measurements");
    const MeasuredSheet& s = *measured->sheet;
    const std::size_t cells = s.wavelengths_nm.size() * s.cosines.size();
    c.require(cells > 0 && s.reflectance.size() == cells && s.transmittance.size() == cells,
              "a table of measurements is not whole");
    c.require(std::ranges::is_sorted(s.wavelengths_nm) && std::ranges::is_sorted(s.cosines),
              "a table of measurements is out of order");
  }
}

void check_tables(const Checker& c, const Manifest& m) {
  for (const ScatteringTable& table : m.tables)
    if (const char* fault = fault_of(table)) c.require(false, fault);
  for (const Material& material : m.materials)
    if (const auto* t = std::get_if<TabulatedMaterial>(&material.model))
      c.require(t->table.value < m.tables.size() &&
                    std::holds_alternative<FourierTable>(m.tables[t->table.value]) ==
                        (t->format == TabulatedMaterial::Format::fourier),
                "a material has no table");
  for (const Material& material : m.materials)
    if (const auto* slab = std::get_if<SlabMaterial>(&material.model))
      c.require(slab->thickness >= 0 && slab->g > -1 && slab->g < 1,
                "a slab has a negative thickness, or its g is not between -1 and 1");
  for (const Material& material : m.materials) {
    const auto* glazed = std::get_if<GlazedMaterial>(&material.model);
    const auto* finish = glazed ? &glazed->finish : std::get_if<FinishMaterial>(&material.model);
    if (finish)
      c.require(finish->brilliance >= 0 && finish->phong_size >= 0 && finish->roughness > 0 &&
                    std::isfinite(finish->brilliance + finish->phong_size + finish->roughness +
                                  finish->phong + finish->specular),
                "a finish has a negative exponent, or one that is not finite");
    if (glazed)
      c.require(glazed->falloff >= 0 && glazed->metallic >= 0 && glazed->metallic <= 1 && glazed->eta > 0 &&
                    std::isfinite(glazed->falloff + glazed->eta),
                "a finish that mirrors has a negative exponent, or an index that is not above 0");
  }
}

void check_lights(const Checker& c, const Manifest& m) {
  const auto numbers = std::min<std::uint64_t>(m.triangles, triangle_numbers);
  for (const EmissiveTriangle& t : m.emissive_triangles)
    c.require(t.triangle < numbers && t.area_light < m.area_lights.size(), "a light shines from nowhere");
  for (const EmissiveQuadric& q : m.emissive_quadrics) {
    c.require(!is_curve(q.quadric.quadric), "a curve shines");
    check_shape(c, q.quadric.quadric);
    c.require(q.triangle < numbers && q.area_light < m.area_lights.size(), "a light shines from nowhere");
  }
  c.require(m.emissive_attributes.empty() ||
                m.emissive_attributes.size() == m.emissive_triangles.size() * m.attributes,
            "the attributes of emissive triangles are not whole");
  c.require(m.emissive_opacities.empty() || m.emissive_opacities.size() == m.emissive_triangles.size(),
            "the opacities of emissive triangles are not whole");
  for (const Light& light : m.lights)
    std::visit(
        [&](const auto& l) {
          if constexpr (requires { l.fading; })
            c.require(!l.fading || (l.fading->fade_distance >= 0 && l.fading->fade_power >= 0),
                      "a light fades over a negative distance, or by a negative power");
          if constexpr (requires { l.tightness; })
            c.require(std::isfinite(l.tightness), "a light's tightness is no number");
        },
        light.model);
  for (const Light& light : m.lights)
    if (const auto* distant = std::get_if<DistantLight>(&light.model))
      c.require(length(distant->direction) > 0, "a distant light has no direction");
  for (const Light& light : m.lights)
    if (const auto* sky = std::get_if<SkyLight>(&light.model))
      c.require(std::abs(length(sky->to_sun) - 1) < 1e-6 && sky->sun_diameter_deg > 0, "a sky has no sun");
  for (const Light& light : m.lights)
    if (const auto* sky = std::get_if<SkyLight>(&light.model)) {
      c.require(sky->ground >= 0 && sky->ground <= 1, "a sky's ground reflects no share from 0 to 1");
      c.require(sky->color_temperature_k == 0 || is_daylight(static_cast<double>(sky->color_temperature_k)),
                "a sky has the temperature of no daylight");
    }
  for (const Light& light : m.lights)
    if (const auto* sky = std::get_if<SkyLight>(&light.model); sky && *sky->distribution)
      c.require((*sky->distribution)->diffuse_lx >= 0, "a sky has a negative illuminance");
}

constexpr std::uint64_t most_bytes = std::uint64_t{1} << 47;

void check_packs(const Checker& c, const Manifest& m) {
  std::vector<std::pair<PackPlace, std::uint64_t>> parts;  // with their bytes
  for (const DomainInfo& d : m.domains) {
    if (!d.pack) continue;
    c.require(d.pack->offset % pack_page == 0, "a domain does not begin at a page of its pack");
    c.require(d.bytes > 0 && d.bytes <= most_bytes && d.pack->offset <= most_bytes - d.bytes,
              "a pack is larger than files can be");
    parts.emplace_back(*d.pack, d.bytes);
  }
  std::ranges::sort(parts);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const auto& [before, bytes] = parts[i - 1];
    const PackPlace& here = parts[i].first;
    c.require(here.pack != before.pack || here.offset >= before.offset + bytes,
              "two domains overlap in their pack");
  }
}

// Images are files of the bundle, as others are not checked; and no file has more bytes than all together
// could be counted in.
void check_files(const Checker& c, const Manifest& m) {
  std::set<std::string_view> images;
  for (const TextureFileEntry& t : m.texture_files) {
    c.require(t.name.starts_with("textures/") && t.name.find("..") == std::string::npos,
              "a texture has no place in it");
    c.require(std::max(t.bytes, t.read_bytes) <= most_bytes, "a file is larger than files can be");
    images.insert(t.name);
  }
  for (const DomainInfo& d : m.domains)
    c.require(d.bytes <= most_bytes, "a file is larger than files can be");
  for (const ObjectInfo& o : m.objects)
    c.require(o.bytes <= most_bytes, "a file is larger than files can be");
  check_packs(c, m);
  const auto check_image = [&](const auto& model) {
    if constexpr (requires { model.filename; })
      c.require(images.contains(model.filename), "an image is no file of it");
  };
  for (const Texture& t : m.textures) std::visit(check_image, t.model);
  for (const Light& l : m.lights) std::visit(check_image, l.model);
}

// Of positive factors, whose product may be more than can be counted.
bool is_product(std::size_t product, std::initializer_list<int> factors) {
  std::size_t left = product;
  for (const int factor : factors) {
    if (left % static_cast<std::size_t>(factor) != 0) return false;
    left /= static_cast<std::size_t>(factor);
  }
  return left == 1;
}

void check_media(const Checker& c, const Manifest& m) {
  // Numbers, or spectra: of four, x of the sigmoid at three wavelengths and a scale; of three, the values in
  // bands.
  const auto check_grid = [&](const Grid& g, bool may_be_spectra = false) {
    c.require(g.nx > 0 && g.ny > 0 && g.nz > 0 &&
                  (g.channels == 1 || (may_be_spectra && (g.channels == 4 || g.channels == 3))),
              "a grid has no cells");
    c.require(is_product(g.values.size(), {g.nx, g.ny, g.nz, g.channels}),
              "a grid does not have one value a cell");
    c.require(!g.bounds.empty(), "a grid has no bounds");
  };
  const auto check_volume = [&](const VolumeParameter& v) {
    if (const auto* grid = std::get_if<Grid>(&v)) check_grid(*grid, true);
  };
  for (const Medium& medium : m.media) {
    c.require(!medium.fade || (medium.fade->distance > 0 && medium.fade->power > 0),
              "a medium fades over nothing");
    if (const auto* k = std::get_if<AbsorptionScattering>(&medium.coefficients))
      check_volume(k->sigma_a), check_volume(k->sigma_s);
    if (const auto* k = std::get_if<ExtinctionAlbedo>(&medium.coefficients))
      check_volume(k->sigma_t), check_volume(k->albedo);
    if (const auto* grid = std::get_if<Grid>(&medium.density)) check_grid(*grid);
    if (medium.emission_scale) check_grid(*medium.emission_scale, true);
    if (medium.temperature) check_grid(*medium.temperature);
    c.require(medium.g > -1 && medium.g < 1, "g of a medium is not between -1 and 1");
    c.require(is_invertible(medium.medium_to_world), "the transform of a medium cannot be inverted");
  }
}

bool in_range(const PhotonSettings& p) {
  return p.photons.value_or(1) >= 1 && p.photons.value_or(1) <= std::uint64_t{1} << 31 &&
         p.first_radius.value_or(1) > 0 && std::isfinite(p.first_radius.value_or(1)) &&
         p.alpha.value_or(0.5) > 0 && p.alpha.value_or(0.5) < 1;
}

}  // namespace

const char* fault_of_kd_tree(std::span<const KdNode> tree, std::size_t leaves) {
  // Of the cell that a node is in: the domains that share it, or none where it is one's alone.
  struct Sharers {
    std::size_t first = 0, count = 0;
    bool has(std::size_t domain) const { return domain >= first && domain - first < count; }
  };
  if (leaves == 0 || tree.size() + 1 < leaves) return "the kd-tree does not have a leaf for each domain";
  std::vector<bool> nodes(tree.size(), false), domains(leaves, false);
  std::vector<int> depth(tree.size(), 1);
  std::vector<Sharers> sharers(tree.size());
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const KdNode& n = tree[i];
    if (n.axis > KdNode::no_axis || !std::isfinite(n.split)) return "a node of the kd-tree has no plane";
    if (depth[i] > max_kd_depth) return "the kd-tree is too deep";
    Sharers& of = sharers[i];
    if (n.axis == KdNode::no_axis && of.count == 0) {
      of = {n.below & ~KdNode::leaf_bit,
            n.split >= 2 ? static_cast<std::size_t>(std::min(n.split, 1e9f)) : 0};
      if (!(n.below & KdNode::leaf_bit) || of.count == 0 || of.first + of.count > leaves)
        return "a cell of the kd-tree that domains share does not say which";
    }
    for (const std::uint32_t child : {n.below, n.above}) {
      const bool leaf = child & KdNode::leaf_bit;
      const std::size_t index = child & ~KdNode::leaf_bit;
      std::vector<bool>& seen = leaf ? domains : nodes;
      if (index >= seen.size() || (!leaf && index <= i) || (leaf && of.count > 0 && !of.has(index)) ||
          (seen[index] && !(leaf && of.has(index))))
        return "the kd-tree is not a tree";
      seen[index] = true;
      if (leaf) continue;
      depth[index] = depth[i] + 1;
      sharers[index] = of;
    }
  }
  if (!tree.empty() && !std::ranges::all_of(domains, std::identity{})) return "the kd-tree lacks a domain";
  return nullptr;
}

void check_manifest(const Manifest& m, const std::filesystem::path& file) {
  const Checker c{file};
  c.require(finite(m.offset) && std::isfinite(m.scale) && m.scale >= 0, "its coordinates are not finite");
  c.require(!m.core || !m.core->empty(), "nothing is in its core");
  std::visit(
      [&](const auto& camera) {
        if constexpr (requires { camera.lens; })
          c.require(camera.lens.radius >= 0 && camera.lens.focal_distance > 0,
                    "the lens has a negative radius or nothing in focus in front of it");
        if constexpr (requires { camera.sensors; }) {
          c.require(!camera.sensors.empty(), "it has no sensor");
          for (const Sensor& s : camera.sensors)
            c.require(std::abs(dot(s.normal, s.normal) - 1) < 1e-6,
                      "the normal of a sensor is not a unit vector");
        }
      },
      m.camera);
  c.require(m.settings.samples_per_pixel > 0 && m.settings.max_depth >= 0,
            "the samples a pixel or the depth is out of range");
  c.require(!m.settings.photons || in_range(*m.settings.photons), "its photons are out of range");
  check_files(c, m);
  check_film(c, m.film);
  if (const char* fault = fault_of_kd_tree(m.kd_nodes, m.domains.size())) c.require(false, fault);
  check_triangles(c, m);
  check_objects(c, m);
  check_records(c, m);
  check_sheets(c, m);
  check_tables(c, m);
  check_lights(c, m);
  check_media(c, m);
  c.require(m.attributes <= max_attributes, "its textures read more than 8 mesh attributes");
  c.require(m.camera_medium >= -1 && m.camera_medium < static_cast<std::int64_t>(m.media.size()),
            "the camera is in a medium that is not there");
}

std::uint64_t hash_of_records(const Manifest& manifest) {
  std::string text = camera_to_json(manifest.camera).dump() + film_to_json(manifest.film).dump();
  if (manifest.requirements.motion) text += motions_to_json(manifest).dump();
  Hasher hasher;
  const ByteSink add = [&](std::span<const std::byte> bytes) { hasher.add(bytes); };
  encode_materials(manifest, add);
  encode_lights(manifest, add);
  hasher.add(std::as_bytes(std::span(text)));
  for (const TextureFileEntry& t : manifest.texture_files) hasher.add(std::as_bytes(std::span(&t.hash, 1)));
  return hasher.digest();
}

}  // namespace vitrail
