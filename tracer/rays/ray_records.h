// SPDX-License-Identifier: Apache-2.0
// A record is the state of a ray between domains: it waits in queues and travels between ranks. Records are
// packed, trivially copyable and little-endian. Wavelengths and random numbers are functions of (seed, pixel,
// sample), so they do not travel. Each kind of ray has a record of its own, in which a field means one thing.
#pragma once

#include <bit>
#include <cstdint>
#include <type_traits>

#include "scene/spectra/sampled_spectrum.h"
#include "tracer/rays/direction.h"
#include "tracer/rays/ray_codes.h"

namespace vitrail {

static_assert(std::endian::native == std::endian::little);

// Samples of a pixel are numbered in 23 bits, and domains in 16. Depth has 16 bits, beside which one says
// that the ray scatters no more.
inline constexpr std::uint32_t max_samples = 1u << 23;
inline constexpr int max_path_depth = (1 << 16) - 1;
inline constexpr std::uint32_t max_domains = 0xffff;

enum class RayRecordKind : std::uint8_t { path, connection, photon, probe };

enum RayFlags : std::uint8_t {
  ray_resolved = 4,    // the hit is certain: it is to be shaded in hit_domain
  ray_dispersed = 8,   // only the hero wavelength is left
  ray_in_pane = 16,    // it has a PaneRecord; of a connection: it walks through panes
  ray_passed = 32,     // went straight on at an event that had the random numbers of its depth
  ray_unrecorded = 64  // the film keeps layers of the first surface, and it is yet to be met
};
// This bit of a path says that it was scattered where connections to lights are made from.
inline constexpr std::uint8_t ray_connected = 128;

#pragma pack(push, 1)
// It is what every ray has on its way to its next hit.
struct RayRecordHead {
  double hit_t;  // of the best hit so far; ∞: none yet
  std::uint32_t hit_triangle;
  std::uint16_t hit_domain;  // which domain found it
  DirectionCode direction;
  float origin[3];
  std::uint32_t exclude;        // triangle it starts on
  std::uint8_t throughput[11];  // as pack_throughput
  std::uint8_t inside;          // state of Interiors
  std::uint8_t kind_and_flags;  // RayRecordKind in the lowest two bits, RayFlags

  RayRecordKind kind() const { return static_cast<RayRecordKind>(kind_and_flags & 3); }
  bool is(std::uint8_t flag) const { return (kind_and_flags & flag) != 0; }
};

// It is a sample of a pixel and the depth of its ray.
struct SampleRecord {
  std::uint32_t pixel;
  std::uint32_t sample_depth;  // sample << 9 | high 9 bits of the depth
  std::uint8_t depth;          // its low 8 bits

  static SampleRecord of(std::uint32_t pixel, std::uint32_t sample, std::uint32_t depth) {
    return {pixel, sample << 9 | depth >> 8, static_cast<std::uint8_t>(depth)};
  }
  std::uint32_t sample() const { return sample_depth >> 9; }
  std::uint32_t all_depth() const { return (sample_depth & 0x1ff) << 8 | depth; }
};

// It belongs to a path or photon that comes from a smooth face of glass.
struct PaneRecord {
  std::uint8_t face_and_bits[3];  // its FaceCode in 20 bits, PaneBits above it
  std::uint8_t polarization;      // bits of its Polarization
};
enum PaneBits : std::uint8_t { pane_within = 1, pane_parts = 2, pane_owes = 4 };

struct PathRecord : RayRecordHead {
  SampleRecord sample;
  std::uint8_t cone;  // cone_code of its ray's width
  // It describes the last scattering: its density over solid angle, as pdf_code (0: specular or camera). It
  // also has the way since then, straight through surfaces, as distance_code.
  struct Scattered {
    std::uint16_t pdf, travelled;
  };
  union {
    Scattered scattered;
    PaneRecord pane;  // where ray_in_pane is set
  };
};

// It is a connection to a light: a ray that deposits its throughput when it gets there.
struct ConnectionRecord : RayRecordHead {
  SampleRecord sample;
  // It goes straight through all that lets it: to hit_t, the end of this ray, where its light is.
  struct Straight {
    std::uint8_t left_and_slope[5];  // end_code of its whole way from here in 36 bits, StraightAim above it
  };
  // It goes through panes to a distant light, with the hit so far.
  struct Walking {
    std::uint16_t light_and_doubt;  // RefractedAim
    std::uint8_t walk[3];           // bits of its PaneWalk
  };
  union {
    Straight straight;
    Walking walking;  // where ray_in_pane is set
  };
  std::uint8_t light_group;  // of its light, as LightGroups has them
};

// They are bits of a photon (transport/scatterer.h, PhotonPath). The code of its FaceDoubt is above them.
enum PhotonHistory : std::uint8_t { photon_refracted = 1, photon_scattered = 2, photon_counted = 4 };
inline constexpr int photon_doubt_shift = 3;

struct PhotonRecord : RayRecordHead {
  std::uint32_t number;   // among those of its iteration
  std::uint8_t depth[3];  // least significant first
  std::uint8_t cone;
  std::uint8_t history;  // PhotonHistory
  std::uint8_t walk;     // bits of its PhotonWalk
  union {
    std::uint16_t pdf;  // of the last scattering, as pdf_code
    PaneRecord pane;    // where ray_in_pane is set
  };
};

// It is a ray that looks for what is around a sensor, before the sensor's paths begin.
struct ProbeRecord : RayRecordHead {
  SampleRecord sample;
  std::uint8_t known;  // SensorPlace
};

// It is any of these records.
union RayRecord {
  RayRecordHead head;
  PathRecord path;
  ConnectionRecord connection;
  PhotonRecord photon;
  ProbeRecord probe;
};

// It is a ray to a point on a light. It deposits `radiance` unless something is hit in (0, tmax).
struct ShadowRecord {
  float origin[3];
  DirectionCode direction;
  float tmax;
  std::uint32_t exclude;
  std::uint8_t radiance[hero_count][3];  // as pack_radiance
  std::uint32_t pixel;
  std::uint32_t sample_group;  // sample << 9 | light group

  static std::uint32_t with_group(std::uint32_t sample, std::uint8_t group) { return sample << 9 | group; }
  std::uint32_t sample() const { return sample_group >> 9; }
  std::uint8_t light_group() const { return static_cast<std::uint8_t>(sample_group); }
};
#pragma pack(pop)
static_assert(sizeof(RayRecord) == 64 && std::is_trivially_copyable_v<RayRecord>);
static_assert(sizeof(ShadowRecord) == 46 && std::is_trivially_copyable_v<ShadowRecord>);

}  // namespace vitrail
