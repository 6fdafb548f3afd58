// SPDX-License-Identifier: Apache-2.0
// The stages of lane_stages.h for W paths at a time. Included by one file an instruction set, within
// vitrail::lanes' unnamed namespace, with W defined. Nothing that is called here may be an inline function of
// another header, unless it is in an unnamed namespace: the linker would take one of all files' copies.

using D = Doubles<W>;
using F = Floats<W>;
using U = Words<W>;
using L = Longs<W>;

#define VITRAIL_EACH(value) ([&](int j) __attribute__((always_inline)) { return value; })

#include "tracer/transport/waves/lane_connections.inl"
#include "tracer/transport/waves/lane_kinds.inl"

// As scatter_path has it.
template <class Read>
void scatter(LaneWork& work, const LaneList& list) {
  const bool can_sample = !work.tracing.scene.lights.share.empty();
  for (std::size_t first = 0; first < list.count; first += W) {
    const Group g = group_at_surfaces(work, list, first);
    const Interaction<D> at = interaction_of(work, g, list.is_placed);
    const Carried carried(g);
    Mask<D> transmits{};
    if constexpr (Read::may_transmit) transmits = gather_mask<D>(VITRAIL_EACH(g.material[j]->transmits));
    const Mask<D> on = at.front | transmits | gather_mask<D>(VITRAIL_EACH(g.material[j]->two_sided));
    const Vector<D> along =
        select<D>(gather_mask<D>(VITRAIL_EACH(g.material[j]->along_surface)), at.dpdu, fill<D>(Vector3d{}));
    const Frame<D> frame = frame_around(at.shading, along, select<D>(transmits, fill<D>(1), at.side()));
    Vector<D> out = frame.to_local(at.out);
    // As local_out (shading.cpp) has it.
    if constexpr (Read::takes_any_normal)
      out.z = select<D>(gather_mask<D>(VITRAIL_EACH(g.material[j]->is_raised)), abs(out.z), out.z);
    const auto bsdf = Read::read(work, g, at);
    if constexpr (!Read::is_specular)
      if (can_sample) connect(work, g, carried, at, bsdf, frame, out, on, transmits, list.candidates);

    const Four<F> u = scatter_numbers(work, g, carried);
    const BsdfSample<D> s = sample(bsdf, out, u[2], u[0], u[1]);
    Four<F> throughput;
    for (int i = 0; i < 4; ++i) throughput[i] = carried.throughput[i] * s.weight[i];
    const F brightest = greatest(throughput);
    // A mirror goes by the surface's own normal where the shading normal would have it leave its side.
    const Vector<D> sampled = frame.to_world(s.in);
    const D sides = out.z * s.in.z;
    const Mask<D> leaves =
        no(transmits) & ((dot(sampled, at.geometric) > 0) != (at.cosine * out.z * s.in.z > 0));
    const Mask<D> by_surface = leaves & s.specular & (sides > 0);
    const Vector<D> direction = select<D>(by_surface, at.geometric * (2.0 * at.cosine) - at.out, sampled);
    const Mask<F> specular = mask_for<F>(s.specular);
    const F pdf = select<F>(specular, fill<F>(0), lanes::density_beside(s.pdf, list.candidates));
    Mask<F> lives =
        mask_for<F>(on & s.scatters & (no(leaves) | by_surface)) & (brightest > 0) & (specular | (pdf > 0));
    if (work.ends_lit) lives = lives & specular;
    if (!Read::is_specular && work.roulette_worth > 0)
      lives = survivors(work, carried, lives, no(specular), brightest, u[3], throughput);
    go_on(work, g, carried, at, lives, direction, throughput, pdf, no(specular));
  }
}

// As scatter_in_medium has it.
void scatter_in_media(LaneWork& work, const LaneList& list) {
  const bool can_sample = !work.tracing.scene.lights.share.empty();
  for (std::size_t first = 0; first < list.count; first += W) {
    const Group group = group_of(work, list, first);
    const Carried carried(group);
    const Vector<D> p = gather_vector<D>([&](int j) __attribute__((always_inline))->const Point3d& {
      return work.placed[group.place[j]].p;
    });
    const D g = gather<D>(VITRAIL_EACH(group.bsdf[j]->g));
    const Vector<D> out =
        normalize(-to_doubles(gather_vector<F>([&](int j) __attribute__((always_inline))->const Vector3f& {
          return group.path[j]->ray.direction;
        })));
    if (can_sample) connect_in_media(work, group, carried, p, g, out, list.candidates);
    if (work.ends_lit) continue;

    const Four<F> u = scatter_numbers(work, group, carried);
    Vector<D> in = out;
    for (int j = 0; j < W; ++j)
      set_lane(in, j, lane_by_lane::sample_phase(lane(g, j), lane(out, j), lane(u[0], j), lane(u[1], j)));
    const F pdf = lanes::density_beside(phase(g, out, in), list.candidates);
    Mask<F> lives = pdf > 0;
    Four<F> throughput = carried.throughput;
    if (work.roulette_worth > 0)
      lives = survivors(work, carried, lives, pdf > 0, greatest(throughput), u[3], throughput);
    go_on_from(
        work, group, carried, to_floats(p), lives, in, throughput, pdf, pdf > 0,
        [](CameraPath & path, int) __attribute__((always_inline)) { path.ray.exclude = no_triangle; });
  }
}

// As glass.cpp has it, of a path that does not end there, in a pane whose wavelengths do not part.
void scatter_glass(LaneWork& work, const LaneList& list) {
  for (std::size_t first = 0; first < list.count; first += W) {
    const Group g = group_at_surfaces(work, list, first);
    const Interaction<D> at = interaction_of(work, g, list.is_placed);
    const Carried carried(g);
    const Vector<D> normal = at.shading * at.side();
    const F behind = gather<F>(VITRAIL_EACH(g.material[j]->eta_behind)),
            before = gather<F>(VITRAIL_EACH(g.material[j]->eta_before));
    const D eta = to_doubles(select<F>(mask_for<F>(at.front), behind / before, before / behind));
    const D cosine = dot(at.out, normal);
    const D q = gather<D>(VITRAIL_EACH(lane_by_lane::polarization_at(*g.path[j], lane(normal, j))));
    const Polarized<D> r = fresnel_polarized(cosine, eta);
    const F reflectance = to_floats(part_of(q, r));
    D reflected = fill<D>(0), polarized = fill<D>(0), all = fill<D>(0);
    for (int i = 0; i < 4; ++i) {
      const D carries = to_doubles(carried.throughput[i]);
      reflected = reflected + carries * to_doubles(reflectance);
      polarized = polarized + carries * polarized_part_of(q, r);
      all = all + carries;
    }
    const D reflects = attainable(reflected / all);
    const Four<F> u = scatter_numbers(work, g, carried);
    const Mask<D> goes_back = to_doubles(u[2]) < reflects;
    Vector<D> refracted;
    const Mask<D> passes = refract(at.out, normal, eta, refracted);
    const Vector<D> direction = select<D>(goes_back, normal * (2.0 * cosine) - at.out, refracted);
    const F back = to_floats(1.0 / reflects);
    const F through = to_floats((1.0 - to_doubles(reflectance)) / (1.0 - reflects) / (eta * eta));
    Four<F> throughput;
    for (int i = 0; i < 4; ++i)
      throughput[i] = select<F>(mask_for<F>(goes_back), carried.throughput[i] * reflectance * back,
                                carried.throughput[i] * through);
    if (any(gather_mask<D>(VITRAIL_EACH(g.material[j]->is_tinted)))) {
      const Four<F> of_reflected = spectrum_of(g, 0), of_passed = spectrum_of(g, 1);
      for (int i = 0; i < 4; ++i)
        throughput[i] = throughput[i] * select<F>(mask_for<F>(goes_back), of_reflected[i], of_passed[i]);
    }
    const Mask<F> lives = mask_for<F>(goes_back | passes) & (greatest(throughput) > 0);
    const D q_behind =
        select<D>(goes_back, q_of(polarized, reflected), q_of(q * all - polarized, all - reflected));
    for (int j = 0; j < g.valid; ++j)
      if (is_set(lives, j))
        lane_by_lane::cross_face(*g.path[j], {lane(normal, j), is_set(at.front, j), is_set(goes_back, j),
                                              lane(q_behind, j), lane(u[0], j)});
    go_on(work, g, carried, at, lives, direction, throughput, fill<F>(0), Mask<F>{});
  }
}

// Thin glass of one index: as scatter_path has it.
void scatter_sheet(LaneWork& work, const LaneList& list) {
  for (std::size_t first = 0; first < list.count; first += W) {
    const Group g = group_at_surfaces(work, list, first);
    const Interaction<D> at = interaction_of(work, g, list.is_placed);
    const Carried carried(g);
    const Frame<D> frame = frame_around(at.shading, fill<D>(Vector3d{}), fill<D>(1));
    const Vector<D> out = frame.to_local(at.out);
    const D eta = to_doubles(gather<F>(VITRAIL_EACH(g.material[j]->eta_behind)));
    const F reflectance = sheet_reflectance(abs(out.z), eta, fill<D>(0));
    Four<F> reflected = spectrum_of(g, 0), passed = spectrum_of(g, 1);
    D bright_r = fill<D>(0), bright_t = fill<D>(0);
    for (int i = 0; i < 4; ++i) {
      reflected[i] = reflected[i] * reflectance, passed[i] = passed[i] * (1.0f - reflectance);
      bright_r = bright_r + to_doubles(carried.throughput[i]) * to_doubles(reflected[i]);
      bright_t = bright_t + to_doubles(carried.throughput[i]) * to_doubles(passed[i]);
    }
    const F reflects = to_floats(attainable(bright_r / (bright_r + bright_t)));
    const Four<F> u = scatter_numbers(work, g, carried);
    const Mask<F> goes_back = u[2] < reflects;
    const F back = 1.0f / reflects, through = 1.0f / (1.0f - reflects);
    Four<F> throughput;
    for (int i = 0; i < 4; ++i)
      throughput[i] = carried.throughput[i] * select<F>(goes_back, reflected[i] * back, passed[i] * through);
    const Mask<F> lives = mask_for<F>(bright_r + bright_t > 0) & (greatest(throughput) > 0);
    const Vector<D> direction = frame.to_world({-out.x, -out.y, out.z});
    go_on(work, g, carried, at, lives & goes_back, direction, throughput, fill<F>(0), Mask<F>{});
    const Mask<F> passes = lives & no(goes_back);
    for (int j = 0; j < g.valid; ++j) {
      if (!is_set(passes, j)) continue;
      lane_by_lane::pass_sheet(
          work, *g.path[j],
          {g.place[j], point_of(at.p, j), lane(at.geometric, j), lane(at.rounding, j), is_set(at.front, j)},
          lane(throughput, j));
      work.next[work.next_count++] = g.place[j];
    }
  }
}

// Of W paths that begin: where they lie from the centres of their pixels, and their weights.
struct Offsets {
  D x, y, weight;
};

VITRAIL_LANES Offsets offsets_of(const NewPaths& work, const Four<F>& u) {
  if (work.is_even)
    return {(2.0 * to_doubles(u[0]) - 1.0) * work.radius.x, (2.0 * to_doubles(u[1]) - 1.0) * work.radius.y,
            fill<D>(1)};
  Offsets offsets{};
  for (int j = 0; j < W; ++j) {
    const FilterSample sample = lane_by_lane::filter_sample(work.tracing, lane(u[0], j), lane(u[1], j));
    set_lane(offsets.x, j, sample.offset.x);
    set_lane(offsets.y, j, sample.offset.y);
    set_lane(offsets.weight, j, sample.weight);
  }
  return offsets;
}

VITRAIL_LANES Vector<D> linear_at(const CameraSampler::Linear& of, D x, D y) {
  return fill<D>(of.at_corner) + fill<D>(of.per_x) * x + fill<D>(of.per_y) * y;
}

// As CameraSampler::ray has it, of a linear camera. `pixel`, `seed`: of the paths' keys.
VITRAIL_LANES void start_rays(const NewPaths& work, CameraPath* const (&path)[W], U pixel, L seed,
                              const Offsets& offsets) {
  const D place = to_doubles(pixel), row = to_doubles(convert<std::int32_t>(place / work.width)),
          column = place - row * work.width;
  const D x = column + 0.5 + offsets.x, y = row + 0.5 + offsets.y;
  const Vector<F> origin = to_floats(linear_at(work.rays->origin, x, y));
  const Code<U> code = encode_direction(linear_at(work.rays->direction, x, y));
  const Vector<F> direction = decode_direction(code);
  const L random = hash_of_ray<L>(seed, origin, code);
  for (int j = 0; j < W; ++j) {
    CameraPath& p = *path[j];
    p.ray.origin.x = lane(origin.x, j);
    p.ray.origin.y = lane(origin.y, j);
    p.ray.origin.z = lane(origin.z, j);
    p.ray.direction.x = lane(direction.x, j);
    p.ray.direction.y = lane(direction.y, j);
    p.ray.direction.z = lane(direction.z, j);
    p.ray.exclude = no_triangle;
    set_code(p.direction, code, j);
    p.random = lane(random, j);
  }
}

void begin(const NewPaths& work) {
  const WavelengthTables tables = wavelength_tables();
  const float* const observer = observer_of(work.tracing.scene)[0].data();
  for (std::size_t first = 0; first < work.count; first += W) {
    CameraPath* path[W];
    for (std::size_t j = 0; j < W; ++j)
      path[j] = work.paths + work.places[first + j < work.count ? first + j : work.count - 1];
    const U pixel = gather<U>(VITRAIL_EACH(path[j]->key.pixel)),
            sample = gather<U>(VITRAIL_EACH(path[j]->key.sample));
    const L seed = sample_seed(work.tracing.scene.seed.value, pixel, sample);
    Four<F> u = lanes::sample_4d(work.tracing.scene.seed, pixel, sample, pixel * 0u + sample_set::camera);
    lanes::place_hero(u);
    const Wavelengths<F> wavelengths = lanes::sample_wavelengths(tables, u[2]);
    const Offsets offsets = offsets_of(work, u);
    const SensorXyz<F> sensor = lanes::sensor_weights(observer, wavelengths, offsets.weight);
    for (int j = 0; j < W; ++j) {
      CameraPath& p = *path[j];
      p.seed = lane(seed, j);
      p.film.has_wavelengths = true;
      for (int i = 0; i < 4; ++i) {
        p.film.camera.data()[i] = lane(u[i], j);
        p.wavelengths.lambda_nm.data()[i] = lane(wavelengths.lambda_nm[i], j);
        p.film.sensor.x.data()[i] = lane(sensor.x[i], j);
        p.film.sensor.y.data()[i] = lane(sensor.y[i], j);
        p.film.sensor.z.data()[i] = lane(sensor.z[i], j);
      }
    }
    if (work.rays) start_rays(work, path, pixel, seed, offsets);
  }
}

constexpr LaneStages stages{
    begin,
    leave_scene,
    scatter_in_media,
    {nullptr, scatter<ReadLambert>, scatter<ReadMirror>, scatter<ReadMetal>, scatter<ReadPlastic>,
     scatter<ReadRoughPlastic>, scatter<ReadPrincipled>, scatter<ReadFinish>, scatter<ReadCoatedDiffuse>,
     scatter<ReadCoatedConductor>, scatter<ReadRoughGlass>, scatter_glass, scatter_sheet}};
