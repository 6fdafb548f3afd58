// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "bundle/checksum.h"
#include "bundle/manifest_json.h"
#include "bundle/records.h"
#include "scene/diagnostics.h"

namespace vitrail {

namespace {

struct Checker {
  const std::filesystem::path& file;
  void require(bool condition, const char* what) const {
    if (!condition)
      throw Error(fmt::format("the scene cannot be kept in a bundle: {}", what), {file.string()});
  }
};

bool finite(const Spectrum& s) {
  // Constant 1 and 0 reflectances are sigmoids at ±∞, so coefficients may be infinite where values are not.
  if (const auto* table = std::get_if<TabulatedSpectrum>(&s)) {
    for (const float v : table->values)
      if (!std::isfinite(v)) return false;
    return table->values.size() == table_size;
  }
  return std::isfinite(evaluate(s, lambda_min_nm)) && std::isfinite(evaluate(s, lambda_max_nm));
}

bool finite(Point3d p) { return is_finite(p); }
bool finite(Vector3d v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool finite(const bundle::Camera& camera) {
  return std::visit(
      [](const auto& c) {
        bool all = true;
        if constexpr (requires { c.screen; })
          for (const double x :
               {c.screen.x0, c.screen.x1, c.screen.y0, c.screen.y1, c.lens.radius, c.lens.focal_distance})
            all = all && std::isfinite(x);
        for (const auto& row : c.camera_to_world.m)
          for (const double x : row) all = all && std::isfinite(x);
        return all;
      },
      camera);
}

void check_film(const Checker& c, const FilmSettings& f) {
  c.require(f.width > 0 && f.height > 0, "the film has no pixels");
  c.require(0 <= f.crop.x0 && f.crop.x0 < f.crop.x1 && f.crop.x1 <= f.width && 0 <= f.crop.y0 &&
                f.crop.y0 < f.crop.y1 && f.crop.y1 <= f.height,
            "the crop window is empty or not within the film");
  c.require(std::isfinite(f.imaging_ratio), "the imaging ratio is not finite");
  const SpectralBins& bins = f.spectrum;
  c.require(bins.count >= 0 && bins.count <= max_spectral_bins && bins.min_nm < bins.max_nm &&
                std::isfinite(bins.max_nm - bins.min_nm),
            "the film's spectral bins are too many or empty");
  std::visit(
      [&](const auto& filter) {
        c.require(
            filter.radius_x > 0 && filter.radius_y > 0 && std::isfinite(filter.radius_x + filter.radius_y),
            "the radius of the pixel filter is not a positive number");
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

// Every node and every domain hangs in exactly one place, children after their parents.
void check_kd_tree(const Checker& c, const Manifest& m) {
  c.require(!m.domains.empty() && m.kd_nodes.size() == m.domains.size() - 1,
            "the kd-tree does not have one leaf a domain");
  std::vector<bool> nodes(m.kd_nodes.size(), false), domains(m.domains.size(), false);
  std::vector<int> depth(m.kd_nodes.size(), 1);
  for (std::size_t i = 0; i < m.kd_nodes.size(); ++i) {
    const KdNode& n = m.kd_nodes[i];
    c.require(n.axis < 3 && std::isfinite(n.split), "a node of the kd-tree has no plane");
    for (const std::uint32_t child : {n.below, n.above}) {
      const bool leaf = child & KdNode::leaf_bit;
      const std::size_t index = child & ~KdNode::leaf_bit;
      std::vector<bool>& seen = leaf ? domains : nodes;
      c.require(index < seen.size() && !seen[index] && (leaf || index > i), "the kd-tree is not a tree");
      seen[index] = true;
      if (!leaf) depth[index] = depth[i] + 1;
      c.require(depth[i] <= max_kd_depth, "the kd-tree is too deep");
    }
  }
}

void check_surfaces(const Checker& c, const Manifest& m) {
  c.require(m.triangles < no_triangle, "it has too many triangles");
  c.require(m.cut_triangles <= m.triangles, "more triangles are cut than there are");
  c.require(
      m.surfaces.empty() == (m.triangles == 0) && (m.surfaces.empty() || m.surfaces[0].first_triangle == 0),
      "its surfaces do not begin at triangle 0");
  for (std::size_t i = 0; i < m.surfaces.size(); ++i) {
    const Surface& s = m.surfaces[i];
    c.require(
        s.first_triangle < m.triangles && (i == 0 || s.first_triangle > m.surfaces[i - 1].first_triangle),
        "its surfaces are out of order");
    c.require(s.material < m.materials.size(), "a surface has no material");
    c.require(s.area_light >= -1 && s.area_light < static_cast<std::int64_t>(m.area_lights.size()),
              "a surface has a light that is not there");
  }
}

void check_lights(const Checker& c, const Manifest& m) {
  const char* const what = "an emission is not finite";
  for (const bundle::AreaLight& l : m.area_lights) c.require(finite(l.radiance), what);
  for (const EmissiveTriangle& t : m.emissive_triangles) {
    c.require(t.triangle < m.triangles && t.area_light < m.area_lights.size(), "a light shines from nowhere");
    for (const Point3f& p : t.p) c.require(is_finite(p), "a light has a vertex that is not finite");
  }
  for (const bundle::Light& light : m.lights) {
    if (const auto* point = std::get_if<bundle::PointLight>(&light)) {
      c.require(finite(point->position), "the position of a light is not finite");
      c.require(finite(point->intensity), what);
    } else if (const auto* distant = std::get_if<bundle::DistantLight>(&light)) {
      c.require(finite(distant->direction) && length(distant->direction) > 0,
                "a distant light has no direction");
      c.require(finite(distant->irradiance), what);
    } else {
      c.require(finite(std::get<bundle::InfiniteLight>(light).radiance), what);
    }
  }
}

}  // namespace

void check_manifest(const Manifest& m, const std::filesystem::path& file) {
  const Checker c{file};
  c.require(finite(m.offset) && std::isfinite(m.scale) && m.scale >= 0, "its coordinates are not finite");
  c.require(finite(m.camera), "the camera is not finite");
  std::visit(
      [&](const auto& camera) {
        if constexpr (requires { camera.lens; })
          c.require(camera.lens.radius >= 0 && camera.lens.focal_distance > 0,
                    "the lens has a negative radius or nothing in focus in front of it");
      },
      m.camera);
  c.require(m.settings.samples_per_pixel > 0 && m.settings.max_depth >= 0,
            "the samples a pixel or the depth is out of range");
  check_film(c, m.film);
  check_kd_tree(c, m);
  check_surfaces(c, m);
  check_lights(c, m);
  for (const bundle::Material& material : m.materials) {
    if (const auto* diffuse = std::get_if<bundle::DiffuseMaterial>(&material))
      c.require(finite(diffuse->reflectance), "a reflectance is not finite");
    if (const auto* dielectric = std::get_if<bundle::DielectricMaterial>(&material))
      c.require(finite(dielectric->eta), "an index of refraction is not finite");
  }
}

void check_domain(const Manifest& manifest, std::uint32_t domain, const MappedDomain& mapped,
                  const std::filesystem::path& file) {
  const DomainInfo& info = manifest.domains.at(domain);
  if (mapped.hash() != info.hash || mapped.bytes() != info.bytes)
    throw Error("this file is not the one that the bundle was made with; partition the scene again",
                {file.string()});
  for (const Cluster& cluster : mapped.view().clusters)
    for (const std::uint32_t id : cluster.id)
      if (id != no_triangle && id >= manifest.triangles)
        throw Error(fmt::format("it holds triangle {}, which the scene does not have", id), {file.string()});
}

std::uint64_t hash_of_records(const Manifest& manifest) {
  const std::string text = camera_to_json(manifest.camera).dump() + film_to_json(manifest.film).dump();
  Hasher hasher;
  hasher.add(encode_materials(manifest));
  hasher.add(encode_lights(manifest));
  hasher.add(std::as_bytes(std::span(text)));
  return hasher.digest();
}

}  // namespace vitrail
