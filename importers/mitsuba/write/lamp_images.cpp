// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/write/lamp_images.h"

#include <algorithm>
#include <cmath>

#include "images/image_files.h"
#include "importers/mitsuba/write/rgb_variants.h"
#include "importers/mitsuba/write/volume_files.h"
#include "scene/shapes/deferred_mesh.h"
#include "scene/shapes/mesh_uv.h"

namespace vitrail::mitsuba_writer {

namespace {

// The affine function of place that has these values in a triangle's corners, and does not change along the
// normal.
struct Slope {
  Vector3d gradient;
  double at_zero = 0;
  double operator()(Point3d p) const { return at_zero + dot(gradient, p - Point3d{}); }
};
Slope slope(const std::array<Point3d, 3>& p, const std::array<double, 3>& value) {
  const Vector3d e1 = p[1] - p[0], e2 = p[2] - p[0], n = cross(e1, e2);
  const Vector3d g =
      (cross(e2, n) * (value[1] - value[0]) + cross(n, e1) * (value[2] - value[0])) * (1 / dot(n, n));
  return {g, value[0] - dot(g, p[0] - Point3d{})};
}

struct PlacedUv {
  Slope u, v;
};

// Of a mesh whose (u,v) are an affine function of place, all within the unit square: Mitsuba looks for light
// there alone.
std::optional<PlacedUv> placed_uv(const TriangleMesh& mesh) {
  if (mesh.quadric || mesh.triangles.empty()) return std::nullopt;
  if (mesh.uvs.empty() && mesh.missing_uv == MissingUv::barycentric) return std::nullopt;
  const auto corners = [&](std::size_t i) {
    std::array<Point3d, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = cast<double>(mesh.positions[mesh.triangles[i][k]]);
    return p;
  };
  std::size_t largest = 0;
  double area = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto p = corners(i);
    if (const double a = length(cross(p[1] - p[0], p[2] - p[0])); a > area) area = a, largest = i;
  }
  if (!(area > 0)) return std::nullopt;
  const CornerUvs uv = uvs_of(mesh, largest);
  const auto component = [&](float Point2f::*c) {
    return slope(corners(largest), {uv[0].*c, uv[1].*c, uv[2].*c});
  };
  const PlacedUv placed{component(&Point2f::x), component(&Point2f::y)};
  constexpr double tolerance = 1e-4;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto p = corners(i);
    const CornerUvs given = uvs_of(mesh, i);
    for (std::size_t k = 0; k < 3; ++k) {
      const Point2d at{given[k].x, given[k].y};
      if (!(std::abs(placed.u(p[k]) - at.x) + std::abs(placed.v(p[k]) - at.y) < tolerance))
        return std::nullopt;
      if (std::max(std::abs(at.x - 0.5), std::abs(at.y - 0.5)) > 0.5 + tolerance) return std::nullopt;
    }
  }
  return placed;
}

Transform with_rows(const Slope& s, const Slope& t, Point3d origin) {
  const Vector3d across = cross(s.gradient, t.gradient);
  const Vector3d depth = across * (length(s.gradient) / length(across));
  const auto row = [](Vector3d g, double c) { return std::array<double, 4>{g.x, g.y, g.z, c}; };
  Transform result;
  result.m[0] = row(s.gradient, s.at_zero);
  result.m[1] = row(t.gradient, t.at_zero);
  result.m[2] = row(depth, 0.5 - dot(depth, origin - Point3d{}));
  return result;
}

// From the unit cube of a grid, which has the image in its x and y, v up, to the world. Nothing where no grid
// shows the lamp as the image does.
std::optional<Transform> grid_to_world(const Scene& scene, const Shape& shape,
                                       const TextureMapping& mapping) {
  TriangleMesh storage;
  const TriangleMesh& mesh = loaded(scene.meshes[shape.mesh.value], storage);
  const auto placed = placed_uv(mesh);
  if (!placed) return std::nullopt;
  const Point3d origin = cast<double>(mesh.positions[mesh.triangles[0][0]]);
  Transform to_grid, to_world;
  if (const auto* m = std::get_if<UvMapping>(&mapping)) {
    const auto mixed = [&](double a, double b, double c) {
      return Slope{placed->u.gradient * a + placed->v.gradient * b,
                   placed->u.at_zero * a + placed->v.at_zero * b + c};
    };
    to_grid = with_rows(mixed(m->a, m->b, m->c), mixed(m->d, m->e, m->f), origin);
    to_world = shape.object_to_world;
  } else if (const auto* plane = std::get_if<PlanarMapping>(&mapping)) {
    const Point3d there = transform_point(inverse(plane->texture_to_world) * shape.object_to_world, origin);
    to_grid = with_rows({plane->v1, plane->offset_s}, {plane->v2, plane->offset_t}, there);
    to_world = plane->texture_to_world;
  } else {
    return std::nullopt;
  }
  return is_invertible(to_grid) ? std::optional(to_world * inverse(to_grid)) : std::nullopt;
}

const char* wrap_mode(Wrap wrap) {
  return wrap == Wrap::repeat ? "repeat" : wrap == Wrap::mirror ? "mirror" : "clamp";
}

// The lowest row first.
Grid grid_of(const Image& image) {
  Grid grid;
  grid.nx = image.width, grid.ny = image.height, grid.nz = 1, grid.channels = image.channels;
  const auto row = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels);
  grid.values.resize(image.values.size());
  for (std::size_t from = image.values.size(), to = 0; from > 0; to += row) {
    from -= row;
    std::copy_n(image.values.begin() + static_cast<std::ptrdiff_t>(from), row,
                grid.values.begin() + static_cast<std::ptrdiff_t>(to));
  }
  return grid;
}

std::pair<std::uint32_t, float> key_of(const AreaLight& light) {
  return {std::get<Id<Texture>>(light.radiance).value, light.scale};
}

// The file of a lamp's image times its scale, written once.
const std::string& image_file(Context& context, const AreaLight& light, const Image& image) {
  std::string& name = context.lamp_images[key_of(light)];
  if (name.empty()) {
    name = context.new_file("images", "exr", context.derived_images);
    write_exr_image(context.file.parent_path() / name, image);
  }
  return name;
}

const std::string& grid_file(Context& context, const AreaLight& light, const Image& image) {
  std::string& name = context.lamp_grids[key_of(light)];
  if (name.empty()) {
    name = context.new_file("volumes", "vol", context.derived_volumes);
    write_volume_file(context.file.parent_path() / name, grid_of(image));
  }
  return name;
}

void add_grid(Context& context, Element lit, const AreaLight& light, const Image& image,
              const ImageTexture& texture, const Transform& to_world) {
  const std::string id = context.new_id("", "lamp_image", context.derived_volumes);
  Element volume = add(add(lit, "texture", "volume", "nested"), "volume", "gridvolume", "volume", id);
  add_string(volume, "filename", grid_file(context, light, image));
  add_string(volume, "filter_type", texture.filter == TextureFilter::nearest ? "nearest" : "trilinear");
  add_string(volume, "wrap_mode", wrap_mode(texture.wrap));
  add_boolean(volume, "raw", false);
  add_transform(volume, to_world);
  // For our own reader, which looks no grid up on a surface.
  Element value = lit.root().child("scene").prepend_child("default");
  value.append_attribute("name") = ("picture:" + id).c_str();
  value.append_attribute("value") = image_file(context, light, image).c_str();
}

// Whether it could be said exactly.
bool add_exactly(Context& context, Element emitter, const AreaLight& light, const Shape& shape) {
  const auto tinted = tinted_image(context.scene, std::get<Id<Texture>>(light.radiance));
  if (!tinted || tinted->image.wrap == Wrap::black) return false;
  const double scale = static_cast<double>(light.scale);
  const RGB tint{tinted->tint.r * scale, tinted->tint.g * scale, tinted->tint.b * scale};
  Image image = texture_values(tinted->image, read_stored_image(tinted->image.filename),
                               tinted->is_number ? ImageUse::number : ImageUse::color);
  if (tint.r != tint.g || tint.g != tint.b) image = with_three_channels(std::move(image));
  multiply(image, tint);
  const float greatest = image.values.empty() ? 0 : *std::ranges::max_element(image.values);
  if (greatest <= 1 && light.scale == 1) return false;  // as the texture is written
  if (greatest > 1 && image.channels > 1) {
    const auto to_world = grid_to_world(context.scene, shape, tinted->image.mapping);
    if (!to_world) {
      if (greatest > light.scale)
        context.approximated(fmt::format(
            "Mitsuba's spectral variants cut the colours of this lamp's image at 1: it has {:.3g}",
            greatest / light.scale));
      return false;
    }
    add_grid(context, add(emitter, "texture", "d65", "radiance"), light, image, tinted->image, *to_world);
    context.approximated(
        "a lamp's image above 1 is a grid: in Mitsuba's spectral variants its colours are other spectra of "
        "the same "
        "colour");
    return true;
  }
  add_bitmap(context, add(emitter, "texture", "d65", "radiance"), "nested",
             {image_file(context, light, image), false}, tinted->image);
  return true;
}

}  // namespace

void add_lamp_image(Context& context, Element emitter, const AreaLight& light, const Shape& shape) {
  // What Mitsuba shows of a bitmap of its own files, it shows again.
  const auto* texture = &context.scene.textures[std::get<Id<Texture>>(light.radiance).value].model;
  const auto* image = std::get_if<ImageTexture>(texture);
  const bool by_place = image && std::holds_alternative<PlanarMapping>(image->mapping);
  if (by_place || !is_mitsuba_file(context.scene, light.origin)) try {
      if (add_exactly(context, emitter, light, shape)) return;
    } catch (const Error&) {  // of an image that cannot be read, which is said where the texture is written
    }
  add_lit_image(context, emitter, "radiance", light.radiance, light.scale);
  if (light.scale != 1)
    context.approximated(fmt::format(
        "Mitsuba's rgb variants leave out the scale of a lamp's image: there it is 1/{:g} as bright",
        light.scale));
}

}  // namespace vitrail::mitsuba_writer
