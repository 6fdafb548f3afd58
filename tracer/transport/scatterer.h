// SPDX-License-Identifier: Apache-2.0
// A Scatterer travels by scattering. It is a path from the camera or a photon from a light, which have the
// same events.
#pragma once

#include "tracer/panes/pane_walk.h"
#include "tracer/panes/polarization.h"
#include "tracer/rays/connection_code.h"
#include "tracer/transport/traveller.h"

namespace vitrail {

// It holds what is known of the last smooth face of glass. Within glass the far face may be parallel to that:
// wavelengths go on together until they meet a face that is not.
struct PaneState {
  bool within = false;
  bool parts = false;         // its wavelengths part but at a face parallel to that,
  bool owes = false;          // and it counts as scattered there then
  FaceCode face;              // the one it came in through; where it is not within, the last
  Polarization polarization;  // by the faces up to that

  bool is_known() const { return within || polarization.code != 0; }
  // Lets a face of that normal, on its side, leave a ray polarised so; u in [0,1) rounds q.
  void meet(Vector3d normal, double q, float u) {
    if (!within) face = encode_face(normal);
    polarization = Polarization::rounded(q, u);
  }

  PaneRecord record() const {
    std::uint32_t code = face.bits;
    if (within) code |= std::uint32_t{pane_within} << FaceCode::length;
    if (parts) code |= std::uint32_t{pane_parts} << FaceCode::length;
    if (owes) code |= std::uint32_t{pane_owes} << FaceCode::length;
    return {{static_cast<std::uint8_t>(code), static_cast<std::uint8_t>(code >> 8),
             static_cast<std::uint8_t>(code >> 16)},
            static_cast<std::uint8_t>(polarization.bits())};
  }
  static PaneState of(const PaneRecord& r) {
    const auto& byte = r.face_and_bits;
    const std::uint32_t code = byte[0] | std::uint32_t{byte[1]} << 8 | std::uint32_t{byte[2]} << 16;
    const std::uint32_t bits = code >> FaceCode::length;
    return {(bits & pane_within) != 0,
            (bits & pane_parts) != 0,
            (bits & pane_owes) != 0,
            {code & ((1u << FaceCode::length) - 1)},
            Polarization::of(r.polarization)};
  }
};

struct Scatterer : Traveller {
  float pdf = 0;          // of the last scattering, solid angle, as density_beside says; 0: specular
  bool passed = false;    // went straight on at an event that had the random numbers of its depth
  std::uint8_t cone = 0;  // cone_code of its width where it starts
  PaneState pane;
};

// It is a path from the camera: its throughput is the importance of what it meets.
struct CameraPath : Scatterer {
  FilmSample film;
  double travelled = 0;     // since the last scattering, straight through surfaces; rounded as it travels
  bool unrecorded = false;  // the film keeps layers of the first surface, and it is yet to be met
  bool connected = false;   // it was scattered where connections to lights are made from
  mutable LastLamp lamp;

  // It is the density of a path that nothing has turned from its way yet.
  static constexpr float unscattered = -1;
  bool has_scattered() const { return pdf >= 0; }

  // Returns about the point of the last scattering.
  Point3d scattered_from() const {
    return cast<double>(ray.origin) - cast<double>(ray.direction) * travelled;
  }
};

// It is a photon: its throughput is power, in units of PhotonPass::power_w_nm.
struct PhotonPath : Scatterer {
  std::uint32_t number = 0;  // among those of its iteration
  // They say what has happened to it since its light. Where neither of the first two is set, it went
  // straight, and connections find the same light.
  bool refracted = false;  // by smooth interfaces, or reflected to and fro by parallel faces
  bool scattered = false;  // by anything else
  bool counted = false;    // of what connections pass, it has met something that counts for its depth
  FaceDoubt doubt;         // of the faces that it has met since it last had the direction of its light
  PhotonWalk walk;
};

// Returns numbers for a scattering. The first event at a depth has a stratified set. Events that follow,
// where going straight on counts for no depth, have numbers of their ray.
std::array<float, 4> numbers_for_scattering(const Scatterer& s, Wanted wanted = Wanted::four);

// They are called at anything in glass but a face parallel to the one that the ray entered by. The
// wavelengths part, and entering counts. They return false where that was one scattering too many.
bool leave_pane(CameraPath& path);
bool leave_pane(PhotonPath& photon);
// Returns Q/I as the ray meets a face of that normal (polarization.h).
double polarization_at(const Scatterer& s, Vector3d normal);

// Photons have the cones of a first sample.
inline std::uint32_t sample_of(const CameraPath& path) { return path.film.sample; }
inline std::uint32_t sample_of(const PhotonPath&) { return 0; }
// Returns the cone. It widens by the angle between rays, and after a scattering by a tenth of a lobe's width.
// The lobe's density is up to four times the path's (Akenine-Möller et al., "Texture Level of Detail
// Strategies for Real-Time Ray Tracing", 2019).
RayCone cone_of(const Tracing& tracing, const Scatterer& s, std::uint32_t sample);
// Widens the cone up to where the next ray starts.
void widen_cone(const Tracing& tracing, Scatterer& s, std::uint32_t sample, double distance);

// It is a surface that a ray has come to.
struct Event {
  const Surface& surface;
  const MaterialKind& kind;
  Interaction at;
  bool is_there = true;  // not a face of an interior that lies in one of higher priority
};
template <class T>
Event event_of(const Tracing& tracing, T& t) {
  const Surface& surface = surface_at(tracing, t);
  Event event{surface, tracing.scene.materials.kind(surface.material),
              interaction_at(tracing, t, cone_of(tracing, t, sample_of(t)))};
  widen_cone(tracing, t, sample_of(t), t.hit.t);
  event.is_there = is_there(tracing, t, surface, event.at);
  return event;
}

// They go on, on the other side of a surface, as if it was not there; null: the surface of a hole.
// Connections go through it too, so a path keeps the density of the scattering that it comes from.
void pass_straight(const Tracing& tracing, CameraPath& path, const Interaction& at, const Surface* surface);
void pass_straight(const Tracing& tracing, PhotonPath& photon, const Interaction& at, const Surface* surface);
// They count that the ray goes straight on, where that counts: through a sheet, or a part of the surface that
// is not there.
void count_straight(const Tracing& tracing, CameraPath& path);
void count_straight(const Tracing& tracing, PhotonPath& photon);
// Tells the ray that it meets a surface. Only the far face of a pane lets the wavelengths out the way they
// came in, and only smooth glass keeps their polarisation. Returns what leave_pane does.
template <class T>
bool come_to(T& t, const Event& event) {
  if (!event.kind.smooth_dielectric) t.pane.polarization = {};
  return (!event.at.front && event.kind.smooth_dielectric) || leave_pane(t);
}
// Handles an event after which the ray goes on as it came.
template <class T>
void scatter_straight(const Tracing& tracing, T& t, const Event& event) {
  if (tracing.settings().straight_counts)
    count_straight(tracing, t);
  else
    t.passed = true;
  pass_straight(tracing, t, event.at, &event.surface);
}

// Returns the chance that the path lives on after the event at hand. It is what the path carries over what is
// worth going on for; a path that lives on carries the latter. It is 1 after the first event that is not a
// mirror's or smooth glass's. The ray from there brings light that the camera sees on what it looks at.
float survival(const Tracing& tracing, const CameraPath& path);
// They count a scattering event, and decide by roulette whether the ray lives on. A path that is to scatter
// no more lives on for the light that it may still see directly.
bool go_on(const Tracing& tracing, CameraPath& path, float u, bool specular, bool no_more = false);
bool go_on(const Tracing& tracing, PhotonPath& photon, float u, bool specular);

// They return whether the ray scatters no more. A photon is scattered once more, where it is gathered.
bool is_spent(const Tracing& tracing, const CameraPath& path);
bool is_spent(const Tracing& tracing, const PhotonPath& photon);

// Returns the material that chance chooses of a surface; null: nothing.
const Material* chosen_at(const Tracing& tracing, const Scatterer& s, const Surface& surface,
                          const Interaction& at);
// Passes a path where chance chooses nothing.
void pass_nothing(const Tracing& tracing, CameraPath& path, const Surface& surface, const Interaction& at);
// It is the material that the ray meets where it scatters. If the material is null, it does not scatter;
// `goes_on` then says whether it has passed, or ends.
struct MetMaterial {
  const Material* material = nullptr;
  bool goes_on = false;
};
MetMaterial material_at(const Tracing& tracing, CameraPath& path, const Event& event);
MetMaterial material_at(const Tracing& tracing, PhotonPath& photon, const Event& event);
Scattering scattering_at(const Tracing& tracing, const Scatterer& s, const Interaction& at,
                         const Material& material);

}  // namespace vitrail
