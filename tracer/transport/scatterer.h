// SPDX-License-Identifier: Apache-2.0
// What travels by scattering: paths from the camera and photons from lights, which have the same events.
#pragma once

#include "tracer/panes/pane_walk.h"
#include "tracer/panes/polarization.h"
#include "tracer/rays/connection_code.h"
#include "tracer/transport/traveller.h"

namespace vitrail {

// What is known of the last smooth face of glass. Within glass its far face may be parallel to that:
// wavelengths go on together until they meet a face that is not.
struct PaneState {
  bool within = false;
  bool parts = false;         // its wavelengths part but at a face parallel to that,
  bool owes = false;          // and it counts as scattered there then
  FaceCode face;              // the one it came in through; where it is not within, the last
  Polarization polarization;  // by the faces up to that

  bool is_known() const { return within || polarization.code != 0; }
  // Lets a face of that normal, on its side, leave a ray polarised so; u in [0,1) rounds it.
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

// A path from the camera: its throughput is the importance of what it meets.
struct CameraPath : Scatterer {
  FilmSample film;
  double travelled = 0;     // since the last scattering, straight through surfaces; rounded as it travels
  bool unrecorded = false;  // the film keeps layers of the first surface, and it is yet to be met
  bool connected = false;   // it was scattered where connections to lights are made from
  mutable LastLamp lamp;

  // A path that nothing has turned from its way yet has this as its density.
  static constexpr float unscattered = -1;
  bool has_scattered() const { return pdf >= 0; }

  // About the point of the last scattering.
  Point3d scattered_from() const {
    return cast<double>(ray.origin) - cast<double>(ray.direction) * travelled;
  }
};

// A photon: its throughput is power, in units of PhotonPass::power_w_nm.
struct PhotonPath : Scatterer {
  std::uint32_t number = 0;  // among those of its iteration
  // What has happened to it since its light. Neither of the first two: it went straight, and connections find
  // the same light.
  bool refracted = false;  // by smooth interfaces, or reflected to and fro by parallel faces
  bool scattered = false;  // by anything else
  bool counted = false;    // of what connections pass, it has met something that counts for its depth
  FaceDoubt doubt;         // of the faces that it has met since it last had the direction of its light
  PhotonWalk walk;
};

// The first event at a depth has a stratified set; those that follow where going straight on counts for no
// depth have numbers of their ray.
std::array<float, 4> numbers_for_scattering(const Scatterer& s, Wanted wanted = Wanted::four);

// At anything in glass but a face parallel to the one it entered by: the wavelengths part, and entering
// counts. False where that was one scattering too many.
bool leave_pane(CameraPath& path);
bool leave_pane(PhotonPath& photon);
// Returns Q/I as the ray meets a face of that normal (polarization.h).
double polarization_at(const Scatterer& s, Vector3d normal);

// Photons have the cones of a first sample.
inline std::uint32_t sample_of(const CameraPath& path) { return path.film.sample; }
inline std::uint32_t sample_of(const PhotonPath&) { return 0; }
// It widens by the angle between rays, and after a scattering by a tenth of the width of a lobe, whose
// density is up to four times the path's (Akenine-Möller et al., "Texture Level of Detail Strategies for
// Real-Time Ray Tracing", 2019).
RayCone cone_of(const Tracing& tracing, const Scatterer& s, std::uint32_t sample);
// To where it starts next.
void widen_cone(const Tracing& tracing, Scatterer& s, std::uint32_t sample, double distance);

// A surface where it has come to it.
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

// On the other side of a surface, as if it was not there; null: of a hole. Connections go through it too, so
// a path keeps the density of the scattering that it comes from.
void pass_straight(const Tracing& tracing, CameraPath& path, const Interaction& at, const Surface* surface);
void pass_straight(const Tracing& tracing, PhotonPath& photon, const Interaction& at, const Surface* surface);
// Counts that it goes straight on, where that counts: through a sheet, or what is not there of it.
void count_straight(const Tracing& tracing, CameraPath& path);
void count_straight(const Tracing& tracing, PhotonPath& photon);
// Tells the ray that it meets a surface: only the far face of a pane lets the wavelengths out the way they
// came in, and only smooth glass keeps their polarisation. Returns what leave_pane does.
template <class T>
bool come_to(T& t, const Event& event) {
  if (!event.kind.smooth_dielectric) t.pane.polarization = {};
  return (!event.at.front && event.kind.smooth_dielectric) || leave_pane(t);
}
// An event after which it goes on as it came.
template <class T>
void scatter_straight(const Tracing& tracing, T& t, const Event& event) {
  if (tracing.settings().straight_counts)
    count_straight(tracing, t);
  else
    t.passed = true;
  pass_straight(tracing, t, event.at, &event.surface);
}

// The chance that it lives on after the event at hand: what it carries over what is worth going on for, which
// is what it carries then. 1 after the first event that is not a mirror's or smooth glass's: the ray from
// there brings light that the camera sees on what it looks at.
float survival(const Tracing& tracing, const CameraPath& path);
// Counts a scattering event, and decides by roulette whether it lives on. A path that is to scatter no more
// lives on for the light that it may still see directly.
bool go_on(const Tracing& tracing, CameraPath& path, float u, bool specular, bool no_more = false);
bool go_on(const Tracing& tracing, PhotonPath& photon, float u, bool specular);

// Scatters no more. A photon is scattered once more, where it is gathered.
bool is_spent(const Tracing& tracing, const CameraPath& path);
bool is_spent(const Tracing& tracing, const PhotonPath& photon);

// The material that chance chooses of a surface; null: nothing.
const Material* chosen_at(const Tracing& tracing, const Scatterer& s, const Surface& surface,
                          const Interaction& at);
// What a path does then.
void pass_nothing(const Tracing& tracing, CameraPath& path, const Surface& surface, const Interaction& at);
// The material that it meets where it scatters, and what scatters there. Empty material: it does not;
// `goes_on` says whether it has passed, or ends.
struct MetMaterial {
  const Material* material = nullptr;
  bool goes_on = false;
};
MetMaterial material_at(const Tracing& tracing, CameraPath& path, const Event& event);
MetMaterial material_at(const Tracing& tracing, PhotonPath& photon, const Event& event);
Scattering scattering_at(const Tracing& tracing, const Scatterer& s, const Interaction& at,
                         const Material& material);

}  // namespace vitrail
