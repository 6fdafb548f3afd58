// SPDX-License-Identifier: Apache-2.0
#include "bundle/manifest_json.h"

#include <fmt/format.h>

#include <cmath>

#include "bundle/checked_json.h"

namespace vitrail {

namespace {

template <class V>
Json triple(const V& v) {
  return {v.x, v.y, v.z};
}

template <class V>
V triple_from(const Json& j) {
  using T = decltype(V{}.x);
  return {number<T>(j, 0), number<T>(j, 1), number<T>(j, 2)};
}

// Empty boxes are null: JSON has no infinity.
Json box(const Bounds3f& b) { return b.empty() ? Json(nullptr) : Json{triple(b.lower), triple(b.upper)}; }

Bounds3f box_from(const Json& j) {
  if (j.is_null()) return {};
  const Bounds3f b{triple_from<Point3f>(j.at(0)), triple_from<Point3f>(j.at(1))};
  if (b.empty()) throw Error("the bounds of something end before they begin");
  return b;
}

// 64-bit hashes are hexadecimal strings: many JSON readers keep 53 bits of a number.
Json hash(std::uint64_t h) { return fmt::format("{:016x}", h); }

std::uint64_t hash_from(const Json& j) {
  const auto text = j.get<std::string>();
  if (text.size() != 16 || text.find_first_not_of("0123456789abcdef") != std::string::npos)
    throw Error(fmt::format("'{}' is not a hash of 16 hexadecimal digits", text));
  return std::stoull(text, nullptr, 16);
}

// The kinds of a variant, in the order of its alternatives.
constexpr std::array camera_kinds{"perspective", "orthographic", "spherical", "sensors", "realistic", "wide"};
constexpr std::array sphere_kinds{"equal area", "latitude longitude"};
constexpr std::array wide_kinds{"latitude longitude", "fisheye",          "ultra wide",
                                "panoramic",          "upright cylinder", "lying cylinder"};
constexpr std::array filter_kinds{"box", "triangle", "gaussian", "mitchell", "sinc"};

template <std::size_t n>
std::size_t kind_index(const Json& j, const std::array<const char*, n>& kinds, const char* key = "kind") {
  const auto word = j.at(key).get<std::string>();
  for (std::size_t i = 0; i < n; ++i)
    if (word == kinds[i]) return i;
  throw Error(fmt::format("unknown kind '{}'", word));
}

Json filter_to_json(const Filter& filter) {
  Json j{{"kind", filter_kinds.at(filter.index())}};
  std::visit([&](const auto& f) { j["radius_px"] = {f.radius_x, f.radius_y}; }, filter);
  if (const auto* gaussian = std::get_if<GaussianFilter>(&filter)) j["sigma_px"] = gaussian->sigma;
  if (const auto* mitchell = std::get_if<MitchellFilter>(&filter)) j["b_c"] = {mitchell->b, mitchell->c};
  if (const auto* sinc = std::get_if<SincFilter>(&filter)) j["tau"] = sinc->tau;
  return j;
}

Filter filter_from_json(const Json& j) {
  const double x = number<double>(j.at("radius_px"), 0), y = number<double>(j.at("radius_px"), 1);
  const std::size_t kind = kind_index(j, filter_kinds);
  if (kind == 0) return BoxFilter{x, y};
  if (kind == 1) return TriangleFilter{x, y};
  if (kind == 2) return GaussianFilter{x, y, number<double>(j, "sigma_px")};
  if (kind == 3) return MitchellFilter{x, y, number<double>(j.at("b_c"), 0), number<double>(j.at("b_c"), 1)};
  return SincFilter{x, y, number<double>(j, "tau")};
}

Transform transform_from_json(const Json& j) {
  Transform t;
  for (std::size_t i = 0; i < 16; ++i) t.m[i / 4][i % 4] = number<double>(j, i);
  return t;
}

Json transform_to_json(const Transform& t) {
  Json j;
  for (const auto& row : t.m)
    for (const double x : row) j.push_back(x);
  return j;
}

Json motion_to_json(const Motion& motion) {
  Json j = Json::array();
  for (const Keyframe& key : motion.keys())
    j.push_back({{"time_s", key.time_s}, {"transform", transform_to_json(key.transform)}});
  return j;
}

// None where there is no such key.
Motion motion_from_json(const Json& of, const char* key) {
  if (!of.contains(key)) return {};
  std::vector<Keyframe> keys;
  for (const Json& k : of[key])
    keys.push_back({number<double>(k, "time_s"), transform_from_json(k.at("transform"))});
  return Motion(std::move(keys));
}

RealisticCamera realistic_from_json(const Json& j, const Transform& camera_to_world) {
  RealisticCamera camera{camera_to_world, number<double>(j, "film_diagonal"), {}, {}};
  for (const Json& s : j.at("surfaces")) {
    const auto n = [&](std::size_t i) { return number<double>(s, i); };
    camera.surfaces.push_back({n(0), n(1), n(2), n(3)});
  }
  for (const Json& p : j.at("pupils")) {
    const auto n = [&](std::size_t i) { return number<double>(p, i); };
    camera.pupils.push_back({{n(0), n(1), n(2), n(3)}, n(4)});
  }
  const auto positive_index = [](const LensSurface& s) { return s.index > 0; };
  if (camera.surfaces.empty() || camera.pupils.empty() || !(camera.film_diagonal > 0) ||
      !std::ranges::all_of(camera.surfaces, positive_index))
    throw Error("the camera's lens makes no sense");
  return camera;
}

// Of planes that cut nothing away there is no key.
ClipRange clip_from_json(const Json& of) {
  ClipRange clip;
  if (!of.contains("clip")) return clip;
  const Json& j = of["clip"];
  if (j.contains("near")) clip.near = number<float>(j, "near");
  if (j.contains("far")) clip.far = number<float>(j, "far");
  if (!(clip.near >= 0 && clip.near < clip.far)) throw Error("the camera's clip planes make no sense");
  return clip;
}

Camera camera_from_json(const Json& j) {
  const Transform t = transform_from_json(j.at("camera_to_world"));
  const std::size_t kind = kind_index(j, camera_kinds);
  if (kind == 2)
    return SphericalCamera{
        t, static_cast<SphericalCamera::Projection>(kind_index(j.at("projection"), sphere_kinds))};
  if (kind == 3) {
    SensorCamera camera{t, {}};
    for (const Json& sensor : j.at("sensors")) {
      const auto n = [&](std::size_t i) { return number<double>(sensor, i); };
      camera.sensors.push_back({{n(0), n(1), n(2)}, {n(3), n(4), n(5)}});
    }
    return camera;
  }
  if (kind == 4) return realistic_from_json(j, t);
  if (kind == 5)
    return WideCamera{t,
                      static_cast<WideCamera::Projection>(kind_index(j.at("projection"), wide_kinds)),
                      number<double>(j, "across"),
                      number<double>(j, "above"),
                      number<double>(j, "edge_deg"),
                      j.at("parallel").get<bool>()};
  const auto s = [&](std::size_t i) { return number<double>(j.at("screen"), i); };
  const ScreenWindow screen{s(0), s(1), s(2), s(3)};
  Lens lens;
  if (j.contains("lens"))
    lens = {number<double>(j["lens"], "radius"), number<double>(j["lens"], "focal_distance")};
  const ClipRange clip = clip_from_json(j);
  if (kind == 0) return PerspectiveCamera{t, screen, lens, clip};
  return OrthographicCamera{t, screen, lens, clip};
}

SpectralBins bins_from_json(const Json& film) {
  if (!film.contains("spectrum")) return {};
  const Json& j = film["spectrum"];
  return {number<int>(j, "bins"), number<double>(j, "min_nm"), number<double>(j, "max_nm")};
}

FilmLayers layers_from_json(const Json& film) {
  FilmLayers layers;
  if (!film.contains("layers")) return layers;
  const Json& j = film["layers"];
  for (const Json& name : j.at("names"))
    if (!add_named(layers, name.get<std::string>()))
      throw Error(
          fmt::format("the film has a layer that this program does not know: {}", name.get<std::string>()));
  layers.in_camera_space = j.at("in_camera_space").get<bool>();
  return layers;
}

FilmSettings film_from_json(const Json& j) {
  const auto crop = [&](std::size_t i) { return number<int>(j.at("crop_px"), i); };
  FilmSettings film{number<int>(j, "width_px"),
                    number<int>(j, "height_px"),
                    {crop(0), crop(1), crop(2), crop(3)},
                    filter_from_json(j.at("filter")),
                    number<double>(j, "imaging_ratio"),
                    bins_from_json(j),
                    layers_from_json(j)};
  film.working_gamma = j.value("working_gamma", 1.0);
  return film;
}

// The names of the requirements, for both directions.
constexpr std::array requirement_names{std::pair{"shading_normals", &Requirements::shading_normals},
                                       std::pair{"uv", &Requirements::uv},
                                       std::pair{"filtering", &Requirements::filtering},
                                       std::pair{"dispersion", &Requirements::dispersion},
                                       std::pair{"refraction", &Requirements::refraction},
                                       std::pair{"see_through", &Requirements::see_through},
                                       std::pair{"media", &Requirements::media}};

Json requirements_to_json(const Requirements& r) {
  Json j;
  for (const auto& [name, member] : requirement_names) j[name] = r.*member;
  if (r.motion) j["motion"] = true;
  return j;
}

Requirements requirements_from_json(const Json& j) {
  Requirements r;
  for (const auto& [name, member] : requirement_names) r.*member = j.at(name).get<bool>();
  r.motion = j.value("motion", false);
  return r;
}

Json texture_file_to_json(const TextureFileEntry& t) {
  Json j{{"name", t.name}, {"bytes", t.bytes}, {"hash", hash(t.hash)}};
  if (t.read_bytes > 0) j["read_bytes"] = t.read_bytes;
  return j;
}

TextureFileEntry texture_file_from_json(const Json& j) {
  return {j.at("name").get<std::string>(), number<std::uint64_t>(j, "bytes"), hash_from(j.at("hash")),
          j.contains("read_bytes") ? number<std::uint64_t>(j, "read_bytes") : 0};
}

}  // namespace

Json camera_to_json(const Camera& camera) {
  Json j{{"kind", camera_kinds.at(camera.index())}};
  std::visit(
      [&](const auto& c) {
        j["camera_to_world"] = transform_to_json(c.camera_to_world);
        if constexpr (requires { c.across; }) {
          j["projection"] = {{"kind", wide_kinds.at(static_cast<std::size_t>(c.projection))}};
          j["across"] = c.across, j["above"] = c.above, j["edge_deg"] = c.edge_deg;
          j["parallel"] = c.parallel;
        } else if constexpr (requires { c.projection; }) {
          j["projection"] = {{"kind", sphere_kinds.at(static_cast<std::size_t>(c.projection))}};
        } else if constexpr (requires { c.sensors; }) {
          j["sensors"] = Json::array();
          for (const Sensor& s : c.sensors)
            j["sensors"].push_back(
                {s.position.x, s.position.y, s.position.z, s.normal.x, s.normal.y, s.normal.z});
        } else if constexpr (requires { c.surfaces; }) {
          j["film_diagonal"] = c.film_diagonal;
          j["surfaces"] = j["pupils"] = Json::array();
          for (const LensSurface& s : c.surfaces)
            j["surfaces"].push_back({s.radius, s.thickness, s.index, s.aperture_radius});
          for (const auto& [r, weight] : c.pupils) j["pupils"].push_back({r.x0, r.x1, r.y0, r.y1, weight});
        } else {
          j["screen"] = {c.screen.x0, c.screen.x1, c.screen.y0, c.screen.y1};
          if (c.lens != Lens{})
            j["lens"] = {{"radius", c.lens.radius}, {"focal_distance", c.lens.focal_distance}};
          if (c.clip.near > 0) j["clip"]["near"] = c.clip.near;
          if (std::isfinite(c.clip.far)) j["clip"]["far"] = c.clip.far;
        }
      },
      camera);
  return j;
}

Json motions_to_json(const Manifest& m) {
  Json j{{"shutter_s", {m.shutter.open_s, m.shutter.close_s}}, {"camera", motion_to_json(m.camera_motion)}};
  for (const ObjectInfo& o : m.objects) j["objects"].push_back(motion_to_json(o.motion));
  return j;
}

Json film_to_json(const FilmSettings& f) {
  Json j{{"width_px", f.width},
         {"height_px", f.height},
         {"crop_px", {f.crop.x0, f.crop.x1, f.crop.y0, f.crop.y1}},
         {"filter", filter_to_json(f.filter)},
         {"imaging_ratio", f.imaging_ratio}};
  if (f.spectrum.count > 0)
    j["spectrum"] = {
        {"bins", f.spectrum.count}, {"min_nm", f.spectrum.min_nm}, {"max_nm", f.spectrum.max_nm}};
  if (f.working_gamma != 1) j["working_gamma"] = f.working_gamma;
  if (!f.layers.any()) return j;
  Json names = Json::array();
  for (std::size_t i = 0; i < layer_count; ++i)
    if (f.layers.has(static_cast<Layer>(i))) names.push_back(layer_kinds[i].name);
  j["layers"] = {{"names", names}, {"in_camera_space", f.layers.in_camera_space}};
  return j;
}

namespace {

Json photons_to_json(const PhotonSettings& p) {
  Json j = Json::object();
  if (p.photons) j["count"] = *p.photons;
  if (p.first_radius) j["radius"] = *p.first_radius;
  if (p.alpha) j["alpha"] = *p.alpha;
  return j;
}

PhotonSettings photons_from_json(const Json& j) {
  PhotonSettings p;
  if (j.contains("count")) p.photons = number<std::uint64_t>(j, "count");
  if (j.contains("radius")) p.first_radius = number<double>(j, "radius");
  if (j.contains("alpha")) p.alpha = number<double>(j, "alpha");
  return p;
}

}  // namespace

Json manifest_to_json(const Manifest& m) {
  Json j;
  j["units"] = {{"length", "scene units"}, {"wavelength", "nm"}, {"radiance", "W·m⁻²·sr⁻¹·nm⁻¹"}};
  j["scene_hash"] = hash(m.scene_hash);
  j["triangles"] = m.triangles;
  j["cut_triangles"] = m.cut_triangles;
  j["offset"] = triple(m.offset);
  j["bounds"] = box(m.bounds);
  if (m.core) j["core"] = box(*m.core);
  j["scale"] = m.scale;
  j["requirements"] = requirements_to_json(m.requirements);
  j["attributes"] = m.attributes;
  if (m.switching_glazings > 0) j["switching_glazings"] = m.switching_glazings;
  j["camera"] = camera_to_json(m.camera);
  if (m.requirements.motion) j["shutter_s"] = {m.shutter.open_s, m.shutter.close_s};
  if (m.camera_motion.moves()) j["camera_motion"] = motion_to_json(m.camera_motion);
  j["camera_medium"] = m.camera_medium;
  j["texture_files"] = Json::array();
  for (const TextureFileEntry& t : m.texture_files) j["texture_files"].push_back(texture_file_to_json(t));
  j["film"] = film_to_json(m.film);
  j["settings"] = {{"samples_per_pixel", m.settings.samples_per_pixel},
                   {"max_depth", m.settings.max_depth},
                   {"direct_only", m.settings.direct_only},
                   {"straight_counts", m.settings.straight_counts}};
  if (m.settings.rgb != RgbMethod::jakob_hanika)
    j["settings"]["rgb"] = rgb_method_names[static_cast<std::size_t>(m.settings.rgb)];
  if (m.settings.hides_emitters) j["settings"]["hides_emitters"] = true;
  if (m.settings.photons) j["settings"]["photons"] = photons_to_json(*m.settings.photons);
  return j;
}

Manifest manifest_from_json(const Json& j) {
  Manifest m;
  m.scene_hash = hash_from(j.at("scene_hash"));
  m.triangles = number<std::uint64_t>(j, "triangles");
  m.cut_triangles = number<std::uint64_t>(j, "cut_triangles");
  m.offset = triple_from<Vector3d>(j.at("offset"));
  m.bounds = box_from(j.at("bounds"));
  if (j.contains("core")) m.core = box_from(j["core"]);
  m.scale = number<float>(j, "scale");
  m.requirements = requirements_from_json(j.at("requirements"));
  m.attributes = number<std::uint32_t>(j, "attributes");
  if (j.contains("switching_glazings")) m.switching_glazings = number<std::uint32_t>(j, "switching_glazings");
  m.camera_medium = number<std::int32_t>(j, "camera_medium");
  for (const Json& t : j.at("texture_files")) m.texture_files.push_back(texture_file_from_json(t));
  m.camera = camera_from_json(j.at("camera"));
  if (m.requirements.motion)
    m.shutter = {number<double>(j.at("shutter_s"), 0), number<double>(j.at("shutter_s"), 1)};
  m.camera_motion = motion_from_json(j, "camera_motion");
  m.film = film_from_json(j.at("film"));
  const Json& s = j.at("settings");
  m.settings = {number<int>(s, "samples_per_pixel"),
                number<int>(s, "max_depth"),
                s.at("direct_only").get<bool>(),
                s.at("straight_counts").get<bool>(),
                s.value("hides_emitters", false),
                s.contains("rgb") ? static_cast<RgbMethod>(kind_index(s, rgb_method_names, "rgb"))
                                  : RgbMethod::jakob_hanika};
  if (s.contains("photons")) m.settings.photons = photons_from_json(s["photons"]);
  return m;
}

Json view_to_json(const View& view) {
  Json j{{"camera", camera_to_json(view.camera)},
         {"shutter_s", {view.shutter.open_s, view.shutter.close_s}},
         {"film", {view.width, view.height}}};
  if (view.motion.moves()) j["camera_motion"] = motion_to_json(view.motion);
  return j;
}

View view_from_json(const Json& j) {
  return {camera_from_json(j.at("camera")),
          motion_from_json(j, "camera_motion"),
          {number<double>(j.at("shutter_s"), 0), number<double>(j.at("shutter_s"), 1)},
          number<int>(j.at("film"), 0),
          number<int>(j.at("film"), 1)};
}

}  // namespace vitrail
