// SPDX-License-Identifier: Apache-2.0
#include "bundle/binary_records.h"

#include "bundle/record_fields.h"

namespace vitrail {

namespace records {

struct Writer {
  static constexpr bool reads = false;
  ByteWriter stream;
  template <Number T>
  void operator()(T value) {
    stream.put(value);
  }
  template <class T>
  void operator()(const Id<T>& id) {
    stream.put(id.value);
  }
  void may_be_infinite(float value) { stream.put(value); }
};

struct Reader {
  static constexpr bool reads = true;
  ByteReader stream;
  template <Number T>
  void operator()(T& value) {
    value = stream.get<T>();
  }
  template <class T>
  void operator()(Id<T>& id) {
    id.value = stream.get<std::uint32_t>();
  }
  void may_be_infinite(float& value) { value = stream.get<float>(); }
};

// The last lists are there where they, or what comes after them, have something.
void materials(auto& io, auto& m) {
  list(io, m.surfaces), list(io, m.materials), list(io, m.textures), list(io, m.media);
  if constexpr (reads<decltype(io)>) {
    m.tables.clear();
    if (!io.stream.at_end()) list(io, m.tables);
    if (!io.stream.at_end())
      for (Surface& s : m.surfaces) io(s.vertex_doubt);
    if (!io.stream.at_end())
      for (Material& material : m.materials) fields(io, material.casts_shadow);
  } else {
    const bool shadowless = has_shadowless_materials(m), doubts = shadowless || has_vertex_doubts(m);
    if (doubts || !m.tables.empty()) list(io, m.tables);
    if (doubts)
      for (const Surface& s : m.surfaces) io(s.vertex_doubt);
    if (shadowless)
      for (const Material& material : m.materials) fields(io, material.casts_shadow);
  }
}
// The last lists are there where they, or what comes after them, have something.
void lights(Writer& io, const Manifest& m) {
  list(io, m.area_lights), list(io, m.emissive_triangles), list(io, m.lights);
  const bool quadrics = !m.emissive_quadrics.empty(), opacities = quadrics || !m.emissive_opacities.empty();
  if (opacities || !m.emissive_attributes.empty()) list(io, m.emissive_attributes);
  if (opacities) list(io, m.emissive_opacities);
  if (quadrics) list(io, m.emissive_quadrics);
}
void lights(Reader& io, Manifest& m) {
  list(io, m.area_lights), list(io, m.emissive_triangles), list(io, m.lights);
  m.emissive_attributes.clear(), m.emissive_opacities.clear(), m.emissive_quadrics.clear();
  if (!io.stream.at_end()) list(io, m.emissive_attributes);
  if (!io.stream.at_end()) list(io, m.emissive_opacities);
  if (!io.stream.at_end()) list(io, m.emissive_quadrics);
}
void domains(auto& io, auto& m) {
  list<kd_node_bytes>(io, m.kd_nodes);
  list<least_domain_bytes>(io, m.domains);
  list<least_object_bytes>(io, m.objects);
}

}  // namespace records

void encode_materials(const Manifest& manifest, const ByteSink& sink) {
  records::Writer io{ByteWriter(sink)};
  records::materials(io, manifest);
  io.stream.flush();
}

void encode_lights(const Manifest& manifest, const ByteSink& sink) {
  records::Writer io{ByteWriter(sink)};
  records::lights(io, manifest);
  io.stream.flush();
}

void encode_domains(const Manifest& manifest, const ByteSink& sink) {
  records::Writer io{ByteWriter(sink)};
  records::domains(io, manifest);
  io.stream.flush();
}

void decode_materials(std::vector<std::byte> payload, const std::filesystem::path& file, Manifest& manifest) {
  records::Reader io{{std::move(payload), file}};
  records::materials(io, manifest);
  io.stream.expect_end();
}

void decode_lights(std::vector<std::byte> payload, const std::filesystem::path& file, Manifest& manifest) {
  records::Reader io{{std::move(payload), file}};
  records::lights(io, manifest);
  io.stream.expect_end();
}

void decode_domains(std::vector<std::byte> payload, const std::filesystem::path& file, Manifest& manifest) {
  records::Reader io{{std::move(payload), file}};
  records::domains(io, manifest);
  io.stream.expect_end();
}

}  // namespace vitrail
