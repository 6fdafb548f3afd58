// SPDX-License-Identifier: Apache-2.0
// Adapters that turn the sides and normals of the material inside of them: twosided, bumps, normal maps.
#include "importers/mitsuba/read/bsdf_leaves.h"
#include "importers/mitsuba/read/bsdf_models.h"

namespace vitrail::mitsuba {

namespace {

void report_mirrored_bumps(Builder& b, const Object& o) {
  b.report.approximated(
      "\"twosided\" around bumps: on the back they are turned over with the normal, not mirrored", o.origin);
}

// What an adapter with bumps is around.
Material bumped(Builder& b, const Object& o) {
  Material material = inner_material(b, o);
  if (parts_of(material, b.parts).straight) b.bumps_of_straight.push_back(o.origin);
  return material;
}

// Of a leaf that has been given bumps.
void report_bumps(Builder& b, const Object& o, const Material& leaf) {
  for (const char* what : bumps_shown_otherwise(leaf)) b.report.approximated(what, o.origin);
}

// Whether bumps shadow, since 3.7.1.
bool has_bump_shadowing(Builder& b, const Object& o) {
  if (!o.boolean("flip_invalid_normals", true, b.report))
    b.report.approximated("normals that are turned away are never used", o.origin);
  return o.boolean("use_shadowing_function", o.type != "bump", b.report);
}

}  // namespace

Material two_sided(Builder& b, const Object& o) {
  const std::vector<const Property*> sides = o.children("bsdf");
  if (sides.size() == 2) {
    const std::vector<Id<Material>> ids = nested_materials(b, o, 2, 2);
    if (b.parts[ids[1].value].bumps) report_mirrored_bumps(b, o);
    Material material{TwoSidedMaterial{ids[0], ids[1]}};
    change_leaves(b, material, [](Material& leaf) { leaf.two_sided = true; });
    return material;
  }
  Material material = inner_material(b, o);
  bool bumps = false;
  change_leaves(b, material, [&](Material& leaf) {
    leaf.two_sided = true;
    bumps = bumps || leaf.displacement || leaf.normal_map;
  });
  if (bumps) report_mirrored_bumps(b, o);
  material.two_sided = true;
  return material;
}

// The height of a bump map times its scale.
Material bump_map(Builder& b, const Object& o) {
  Material material = bumped(b, o);
  const double scale = o.number("scale", 1, b.report);
  const Object* texture = o.child("texture");
  if (!texture) {
    b.report.dropped("a bump map without a texture", o.origin);
    return material;
  }
  Id<Texture> height = add_texture(b, *texture, true);
  if (scale != 1) {
    b.scene.textures.push_back(
        {ProductTexture{height, ConstantSpectrum{static_cast<float>(scale)}}, true, "", o.origin});
    height = {static_cast<std::uint32_t>(b.scene.textures.size() - 1)};
  }
  const bool shadows = has_bump_shadowing(b, o);
  change_leaves(b, material, [&](Material& leaf) {
    if (leaf.displacement) b.report.dropped("a second bump map on one material", o.origin);
    leaf.displacement = height;
    leaf.bump_shadowing = shadows;
    report_bumps(b, o, leaf);
  });
  return material;
}

Material normal_map(Builder& b, const Object& o) {
  Material material = bumped(b, o);
  const Object* texture = o.child("texture");
  const bool shadows = has_bump_shadowing(b, o);
  if (!texture) {
    b.report.dropped("a normal map without a texture", o.origin);
  } else if (texture->type == "rawconstant") {
    const bool is_flat = texture->vector("value", b.report) == Vector3d{0.5, 0.5, 1};
    if (!is_flat) b.report.dropped("a normal map that is the same everywhere", texture->origin);
  } else {
    if (texture->type == "bitmap" && !texture->boolean("raw", false, b.report))
      b.report.approximated(
          "a normal map that is not raw counts as if it were: Mitsuba's rgb variants decode it, and its "
          "spectral ones refuse it",
          texture->origin);
    const Id<Texture> map = add_texture(b, *texture, false);
    change_leaves(b, material, [&](Material& leaf) {
      leaf.normal_map = map;
      leaf.bump_shadowing = shadows;
      report_bumps(b, o, leaf);
    });
  }
  return material;
}

}  // namespace vitrail::mitsuba
