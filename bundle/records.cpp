// SPDX-License-Identifier: Apache-2.0
#include "bundle/records.h"

#include "bundle/byte_stream.h"

namespace vitrail {

namespace {

// Every record lists its fields once, for both directions: `io` is a Writer or a Reader.
struct Writer {
  static constexpr bool reads = false;
  ByteWriter stream;
  template <Number T>
  void operator()(T& value) {
    stream.put(value);
  }
};

struct Reader {
  static constexpr bool reads = true;
  ByteReader stream;
  template <Number T>
  void operator()(T& value) {
    value = stream.get<T>();
  }
};

void fields(auto& io, bool& value) {
  auto byte = static_cast<std::uint8_t>(value);
  io(byte);
  value = byte != 0;
}

// Points and vectors.
template <class V>
requires requires(V v) { v.z; }
void fields(auto& io, V& v) { io(v.x), io(v.y), io(v.z); }

// The colour that a sigmoid was fitted to is for writing scenes: it stays behind.
void fields(auto& io, ConstantSpectrum& s) { io(s.value); }
void fields(auto& io, SigmoidSpectrum& s) { io(s.c0), io(s.c1), io(s.c2); }
void fields(auto& io, RgbIlluminantSpectrum& s) { fields(io, s.shape), io(s.scale); }
void fields(auto& io, RgbUnboundedSpectrum& s) { fields(io, s.shape), io(s.scale); }
void fields(auto& io, TabulatedSpectrum& s) {
  s.values.resize(table_size);
  for (float& value : s.values) io(value);
}
void fields(auto& io, SellmeierSpectrum& s) {
  for (double& b : s.b) io(b);
  for (double& c : s.c_um2) io(c);
}

// These are resolved before they come here.
template <class T>
concept Unresolved = std::same_as<T, BlackbodySpectrum> || std::same_as<T, NamedSpectrum>;
void fields(auto& io, Unresolved auto&) {
  if constexpr (std::decay_t<decltype(io)>::reads) io.stream.fail("a spectrum is not resolved");
  throw std::logic_error("a bundle takes resolved spectra");
}

void fields(auto&, bundle::InterfaceMaterial&) {}

// A variant is its index in one byte, then the fields of that alternative.
template <class... Alternatives>
void fields(auto& io, std::variant<Alternatives...>& v) {
  auto index = static_cast<std::uint8_t>(v.index());
  io(index);
  if constexpr (std::decay_t<decltype(io)>::reads) {
    if (index >= sizeof...(Alternatives)) io.stream.fail("a record is of an unknown kind");
    std::uint8_t i = 0;
    ((i++ == index ? static_cast<void>(v = Alternatives{}) : void()), ...);
  }
  std::visit([&](auto& alternative) { fields(io, alternative); }, v);
}

void fields(auto& io, bundle::DiffuseMaterial& m) { fields(io, m.reflectance); }
void fields(auto& io, bundle::DielectricMaterial& m) { fields(io, m.eta); }
void fields(auto& io, bundle::AreaLight& l) { fields(io, l.radiance), fields(io, l.two_sided); }
void fields(auto& io, bundle::PointLight& l) { fields(io, l.position), fields(io, l.intensity); }
void fields(auto& io, bundle::DistantLight& l) { fields(io, l.direction), fields(io, l.irradiance); }
void fields(auto& io, bundle::InfiniteLight& l) { fields(io, l.radiance); }
void fields(auto& io, Surface& s) { io(s.first_triangle), io(s.material), io(s.area_light); }
void fields(auto& io, EmissiveTriangle& t) {
  for (Point3f& p : t.p) fields(io, p);
  io(t.triangle), io(t.area_light);
}

// A list is its length in 8 bytes, then its records.
template <class T>
void list(auto& io, std::vector<T>& records) {
  if constexpr (std::decay_t<decltype(io)>::reads) {
    records.resize(io.stream.get_count(1));
  } else {
    io.stream.put(static_cast<std::uint64_t>(records.size()));
  }
  for (T& record : records) fields(io, record);
}

void materials(auto& io, Manifest& m) { list(io, m.surfaces), list(io, m.materials); }
void lights(auto& io, Manifest& m) {
  list(io, m.area_lights), list(io, m.emissive_triangles), list(io, m.lights);
}

}  // namespace

std::vector<std::byte> encode_materials(const Manifest& manifest) {
  Writer io;
  Manifest copy = manifest;
  materials(io, copy);
  return io.stream.take();
}

std::vector<std::byte> encode_lights(const Manifest& manifest) {
  Writer io;
  Manifest copy = manifest;
  lights(io, copy);
  return io.stream.take();
}

void decode_materials(std::vector<std::byte> payload, const std::filesystem::path& file, Manifest& manifest) {
  Reader io{{std::move(payload), file}};
  materials(io, manifest);
  io.stream.expect_end();
}

void decode_lights(std::vector<std::byte> payload, const std::filesystem::path& file, Manifest& manifest) {
  Reader io{{std::move(payload), file}};
  lights(io, manifest);
  io.stream.expect_end();
}

}  // namespace vitrail
