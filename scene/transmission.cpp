// SPDX-License-Identifier: Apache-2.0
#include "scene/transmission.h"

namespace vitrail {

namespace {

struct Transmits {
  const std::vector<bool>& others;

  bool operator()(const DielectricMaterial&) const { return true; }
  bool operator()(const ThinDielectricMaterial&) const { return true; }
  bool operator()(const DiffuseTransmissionMaterial&) const { return true; }
  bool operator()(const PrincipledMaterial& m) const {
    return m.thin || m.spec_trans != FloatParameter{0.0f};
  }
  bool operator()(const SubsurfaceMaterial&) const { return true; }
  bool operator()(const HairMaterial&) const { return true; }
  bool operator()(const InterfaceMaterial&) const { return true; }
  bool operator()(const MaskMaterial&) const { return true; }
  bool operator()(const BlendMaterial& m) const {
    return others.at(m.first.value) || others.at(m.second.value);
  }
  bool operator()(const TwoSidedMaterial& m) const {
    return others.at(m.front.value) || others.at(m.back.value);
  }
  bool operator()(const auto&) const { return false; }
};

}  // namespace

bool transmits(const Material& material, const std::vector<bool>& others) {
  return std::visit(Transmits{others}, material.model);
}

std::vector<bool> transmitting(const std::vector<Material>& materials) {
  std::vector<bool> result;
  for (const Material& material : materials) result.push_back(transmits(material, result));
  return result;
}

}  // namespace vitrail
