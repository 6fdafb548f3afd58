// SPDX-License-Identifier: Apache-2.0
#include "tests/laws/scattering/table_cases.h"

#include <cmath>
#include <fstream>
#include <span>
#include <string>
#include <utility>

#include "scene/geometry/portable_math.h"
#include "tracer/bsdf/local.h"
#include "tracer/bsdf/warp.h"

namespace vitrail::laws {

namespace {

constexpr std::array<double, 3> luminance_of_rgb{0.212671, 0.715160, 0.072169};

template <class T>
void put(std::ofstream& out, const T& value) {
  out.write(reinterpret_cast<const char*>(&value), sizeof value);
}
template <class T>
void put_all(std::ofstream& out, const std::vector<T>& values) {
  out.write(reinterpret_cast<const char*>(values.data()),
            static_cast<std::streamsize>(values.size() * sizeof(T)));
}

// aₖ of a lobe for one pair of cosines, by midpoints.
std::vector<double> coefficients(const Lobe& lobe, double mu_out, double mu_in, std::uint32_t orders) {
  const double sine_out = safe_sqrt(1 - mu_out * mu_out), sine_in = safe_sqrt(1 - mu_in * mu_in);
  const std::uint32_t points = 4 * orders;
  std::vector<double> a(orders);
  for (std::uint32_t j = 0; j < points; ++j) {
    const double phi = pi * (j + 0.5) / points;
    const double f =
        lobe({sine_out, 0, mu_out}, {-sine_in * std::cos(phi), -sine_in * std::sin(phi), -mu_in});
    double cosine = 1, before = std::cos(phi);  // of kφ, and of (k − 1)φ
    for (std::uint32_t k = 0; k < orders; ++k) {
      a[k] += f * cosine * (k == 0 ? 1 : 2) / points;
      before = std::exchange(cosine, 2 * std::cos(phi) * cosine - before);
    }
  }
  return a;
}

Vector3d direction(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

// A square of a function of (θ, φ): columns √(2θ/π), rows φ/2π + ½.
template <class F>
void add_square(SquareTable& table, std::uint32_t resolution, const F& f) {
  table.rows = table.columns = resolution;
  for (std::uint32_t row = 0; row < resolution; ++row)
    for (std::uint32_t column = 0; column < resolution; ++column) {
      const double u = column / (resolution - 1.0), v = row / (resolution - 1.0);
      table.values.push_back(static_cast<float>(f(u, u * u * pi / 2, (2 * v - 1) * pi)));
    }
}

// What one incidence adds: the warp to visible normals, and what is seen of the light at each place of it.
void add_incidence(AdaptiveTable& t, const FacetTable& of, double theta, double phi) {
  const Microfacets& mf = of.facets;
  const Vector3d out = direction(theta, phi);
  const double turned_by = is_isotropic(t) ? phi : 0;
  SquareTable normals;
  add_square(normals, of.resolution, [&](double u, double theta_m, double phi_m) {
    const Vector3d m = direction(theta_m, phi_m + turned_by);
    return normal_density(mf, m) * std::max(0.0, dot(out, m)) * u * std::sin(theta_m) + 1e-9;
  });
  const Warp warp = make_warp(normals);
  SquareTable seen;
  add_square(seen, of.resolution, [&](double, double, double) { return 0; });
  for (std::uint32_t i = 0; i < seen.values.size(); ++i) {
    const double x = i % of.resolution / (of.resolution - 1.0), y = i / of.resolution / (of.resolution - 1.0);
    Slices first;
    first.add(0, 1);
    const Point2d p = sample(warp, first, {x, y}).p;
    const Vector3d m = direction(p.x * p.x * pi / 2, (2 * p.y - 1) * pi + turned_by), in = mirror(out, m);
    if (in.z > 0 && dot(out, m) > 0)
      seen.values[i] = static_cast<float>(visible_area(mf, out) * shadowing_over_cosines(mf, out, in) * in.z);
  }
  const auto append = [](SquareTable& to, const SquareTable& from, double factor) {
    to.rows = from.rows, to.columns = from.columns;
    for (const float x : from.values)
      to.values.push_back(static_cast<float>(static_cast<double>(x) * factor));
  };
  append(t.visible_normals, normals, 1);
  append(t.luminance, seen, 1);
  for (const double factor : {of.low, (of.low + of.high) / 2, of.high}) append(t.spectra, seen, factor);
}

}  // namespace

FourierTable fourier_table(const Lobe& lobe, int nodes_a_side, std::uint32_t orders, float eta,
                           const std::array<double, 3>* color) {
  FourierTable t;
  t.eta = eta;
  t.channels = color ? 3 : 1;
  std::vector<double> asked;  // 0 is asked for a little to its side
  for (const double side : {-1.0, 1.0})
    for (int j = 0; j <= nodes_a_side; ++j) {
      const double angle = (side < 0 ? j : nodes_a_side - j) * pi / (2 * nodes_a_side);
      t.mu.push_back(static_cast<float>(side * std::max(0.0, std::cos(angle) - 1e-16)));
      asked.push_back(side * std::max(std::cos(angle), 1e-7));
    }
  for (float& mu : t.mu)
    if (std::abs(mu) < 1e-7f) mu = 0;
  t.mu.front() = -1, t.mu.back() = 1;
  for (const double mu_out : asked)
    for (const double mu_in : asked) {
      std::vector<double> a = coefficients(lobe, mu_out, mu_in, orders);
      while (!a.empty() && std::abs(a.back()) < 1e-7) a.pop_back();
      t.first.push_back(static_cast<std::uint32_t>(t.coefficients.size()));
      t.orders.push_back(static_cast<std::uint32_t>(a.size()));
      const double y = color ? (*color)[0] * luminance_of_rgb[0] + (*color)[1] * luminance_of_rgb[1] +
                                   (*color)[2] * luminance_of_rgb[2]
                             : 1;
      for (const double x : a) t.coefficients.push_back(static_cast<float>(x * y));
      if (!color) continue;
      for (const double x : a) t.coefficients.push_back(static_cast<float>(x * (*color)[0]));
      for (const double x : a) t.coefficients.push_back(static_cast<float>(x * (*color)[2]));
    }
  return t;
}

void write(const FourierTable& t, const std::filesystem::path& file) {
  std::ofstream out(file, std::ios::binary);
  out.write("SCATFUN\x01", 8);
  const auto nodes = static_cast<std::int32_t>(t.mu.size());
  for (const std::int32_t x : {1, nodes, static_cast<std::int32_t>(t.coefficients.size()),
                               static_cast<std::int32_t>(std::ranges::max(t.orders)),
                               static_cast<std::int32_t>(t.channels), 1, 0, 0, 0})
    put(out, x);
  put(out, t.eta);
  put_all(out, std::vector<std::int32_t>(4));
  put_all(out, t.mu);
  put_all(out, std::vector<float>(t.first.size()));  // integrals, which no reader has to trust
  for (std::size_t i = 0; i < t.first.size(); ++i) put(out, t.first[i]), put(out, t.orders[i]);
  put_all(out, t.coefficients);
}

AdaptiveTable adaptive_table(const FacetTable& of) {
  AdaptiveTable t;
  const bool isotropic = of.facets.alpha_u == of.facets.alpha_v;
  if (isotropic)
    t.phi_i = {0};
  else
    for (int i = 0; i < of.incidences; ++i)
      t.phi_i.push_back(static_cast<float>(-pi + i * pi / 2 / (of.incidences - 1)));
  for (int i = 0; i < of.incidences; ++i)
    t.theta_i.push_back(static_cast<float>(i * 0.98 * pi / 2 / (of.incidences - 1)));
  t.wavelengths_nm = {400, 550, 700};
  t.normalised = true;
  add_square(t.normals, 128, [&](double, double theta, double phi) {
    return normal_density(of.facets, direction(theta, phi));
  });
  add_square(t.projected_area, 128, [&](double, double theta, double phi) {
    return visible_area(of.facets, direction(theta, phi));
  });
  for (const float phi : t.phi_i)
    for (const float theta : t.theta_i)
      add_incidence(t, of, static_cast<double>(theta), static_cast<double>(phi));
  return t;
}

void write(const AdaptiveTable& t, const std::filesystem::path& file) {
  struct Field {
    std::string name;
    std::uint8_t type;
    std::vector<std::uint64_t> shape;
    std::span<const std::byte> bytes;
  };
  const auto size = [](const auto& list) { return std::uint64_t{list.size()}; };
  const auto floats = [](const std::vector<float>& v) { return std::as_bytes(std::span(v)); };
  const std::uint64_t phis = size(t.phi_i), thetas = size(t.theta_i), lambdas = size(t.wavelengths_nm);
  const auto square = [&](const char* name, const SquareTable& s, std::vector<std::uint64_t> shape) {
    shape.push_back(s.rows), shape.push_back(s.columns);
    return Field{name, 10, shape, floats(s.values)};
  };
  const std::string about = "a test";
  const std::uint8_t normalised = t.normalised;
  const std::vector<Field> fields{{"description", 1, {size(about)}, std::as_bytes(std::span(about))},
                                  {"phi_i", 10, {phis}, floats(t.phi_i)},
                                  {"theta_i", 10, {thetas}, floats(t.theta_i)},
                                  {"wavelengths", 10, {lambdas}, floats(t.wavelengths_nm)},
                                  square("ndf", t.normals, {}),
                                  square("sigma", t.projected_area, {}),
                                  square("vndf", t.visible_normals, {phis, thetas}),
                                  square("luminance", t.luminance, {phis, thetas}),
                                  square("spectra", t.spectra, {phis, thetas, lambdas}),
                                  {"jacobian", 1, {1}, std::as_bytes(std::span(&normalised, 1))}};
  std::uint64_t at = 18;
  for (const Field& f : fields) at += 2 + f.name.size() + 11 + 8 * f.shape.size();
  std::ofstream out(file, std::ios::binary);
  out.write("tensor_file\0\1\0", 14);
  put(out, static_cast<std::uint32_t>(fields.size()));
  for (const Field& f : fields) {
    put(out, static_cast<std::uint16_t>(f.name.size()));
    out << f.name;
    put(out, static_cast<std::uint16_t>(f.shape.size()));
    put(out, f.type), put(out, at), put_all(out, f.shape);
    at += f.bytes.size();
  }
  for (const Field& f : fields)
    out.write(reinterpret_cast<const char*>(f.bytes.data()), static_cast<std::streamsize>(f.bytes.size()));
}

}  // namespace vitrail::laws
