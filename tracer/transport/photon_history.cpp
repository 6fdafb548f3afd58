// SPDX-License-Identifier: Apache-2.0
#include "tracer/transport/photon_history.h"

namespace vitrail {

namespace {

// How a photon stands to a face, as a connection would; empty where none finds its light anyway.
std::optional<ParallelWay> parallel_way_of(const Tracing& tracing, const PhotonPath& photon,
                                           const Interaction& at, const MetFace& face, double doubt_rad) {
  if (photon.scattered || tracing.scene.lights.distant.empty()) return std::nullopt;
  const EmittedPhoton emitted = emission_of(tracing, photon);
  if (!emitted.is_distant) return std::nullopt;
  return parallel_way(-at.out, photon.walk.back, emitted.direction, face, doubt_rad);
}

// Of the face alone, and with those before.
struct Doubts {
  FaceDoubt alone, all;
};
Doubts doubts_at(const Tracing& tracing, const PhotonPath& photon, const Event& event, const MetFace& face) {
  const double face_rad = face_doubt(tracing, photon, event.at, event.surface, face.normal);
  Doubts doubts{{}, photon.doubt};
  doubts.alone.cross(face_rad), doubts.all.cross(face_rad);
  return doubts;
}

}  // namespace

EmittedPhoton emission_of(const Tracing& tracing, const PhotonPath& photon) {
  return tracing.photons->emission->sample(sample_4d(photon.key, sample_set::camera),
                                           sample_4d(photon.key, sample_set::lens), photon.wavelengths);
}

bool is_connected_to(const Tracing& tracing, const PhotonPath& photon) {
  if (!photon.refracted && !photon.scattered) return true;
  if (photon.scattered || tracing.scene.lights.distant.empty()) return false;
  if (photon.walk.before > 0) return false;
  const EmittedPhoton emitted = emission_of(tracing, photon);
  return emitted.is_distant && encode_direction(emitted.direction) == photon.direction;
}

void pass_sheet(PhotonPath& photon) {
  if (!photon.walk.has_way_back()) photon.scattered = true;
  if (!photon.scattered) photon.walk.pass();
}

void pass_interface(const Tracing& tracing, PhotonPath& photon, const Event& event, const MetFace& face,
                    Vector3d& direction) {
  photon.refracted = true;
  const Doubts doubts = doubts_at(tracing, photon, event, face);
  const auto way = parallel_way_of(tracing, photon, event.at, face, doubts.all.allowed_rad());
  if (!way) return;
  photon.doubt = doubts.all;
  if ((way->is_in || way->is_out) && way->passes) {
    direction = way->passed;
    photon.doubt = way->is_out && !photon.walk.back && !event.at.front ? FaceDoubt{} : doubts.alone;
  }
  pass_sheet(photon);
}

void turn_at_face(const Tracing& tracing, PhotonPath& photon, const Event& event, const MetFace& face,
                  Vector3d& direction) {
  const Doubts doubts = doubts_at(tracing, photon, event, face);
  const auto way = parallel_way_of(tracing, photon, event.at, face, doubts.all.allowed_rad());
  if (!way || !way->holds()) {
    photon.scattered = true;
    return;
  }
  photon.walk.turn();
  direction = way->turned;
  photon.refracted = true;
  photon.doubt = way->is_in || way->is_out ? doubts.alone : doubts.all;
}

}  // namespace vitrail
