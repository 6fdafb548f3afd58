// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "scene/records/scene.h"
#include "scene/spectra/color.h"

namespace vitrail {

// It is an image with the options that stand before its name.
struct MtlMap {
  std::string filename;  // absolute; the file exists
  UvMapping mapping;     // of -s and -o
  Wrap wrap = Wrap::repeat;
  float gain = 1;                     // of -mm
  float bump_multiplier = 1;          // of -bm
  std::optional<ImageNumber> number;  // of -imfchan
};

// It is what a library says of a material. Colours are linear sRGB.
struct MtlMaterial {
  std::string name;
  SourceLocation location;
  std::optional<RGB> kd, ks, ke, tf;
  std::optional<double> d, tr, ni, ns;
  std::optional<double> pr, pm, ps, pc, pcr, aniso;  // the extension for physically based rendering
  std::int64_t illum = 2;
  // They are by keyword: map_Kd map_Ks map_Ke map_d map_Pr map_Pm map_Ps bump norm.
  std::map<std::string, MtlMap> maps;
};

// Returns the materials of an MTL library, in its order. Statements that would show and are not kept in them
// are reported, each with its place. Throws Error on what is not a number where one has to be, and where the
// file cannot be opened.
std::vector<MtlMaterial> read_mtl(const std::filesystem::path& file, Diagnostics& diagnostics);

// Materials are named as text that can be shown: well-formed UTF-8, of about so many bytes.
inline constexpr std::size_t longest_mtl_name = 200;

// They are the textures of materials that were added, so that equal ones are one.
using MtlTextures = std::unordered_multimap<std::size_t, Id<Texture>>;  // by what differs in most

struct MtlSurface {
  Id<Material> material;
  std::optional<Id<AreaLight>> light;
};

// Appends the records that a material stands for. MTL says how to shade, not what things are made of; it is
// read as the programs mean it that write it:
//   Pr, Pm, Ps, Pc, Pcr, aniso and their maps   PrincipledMaterial (roughness Pr, metallic Pm, sheen Ps,
//                                               clearcoat Pc, its gloss 1 − Pcr); Ns gives a missing Pr.
//                                               With all of these, as Blender writes, Tf is what it transmits
//   Ni > 1, with d < 1 or illum 4, 6, 7, 9      smooth DielectricMaterial of that index; Tf is what it
//                                               transmits. (Maya writes illum 4 with Ni 1 for opaque ones.)
//                                               A ThinDielectricMaterial where it encloses nothing
//                                               (open_glass.h)
//   Ks > 0, illum ≥ 2                           PlasticMaterial: Ks times the Fresnel reflection of a coat of
//                                               index Ni (1.5 if not above 1), α = √(2/(Ns + 2)) (Beckmann;
//                                               Ns is 1 if not given)
//   the same, illum 3 or 5 and Kd black, or     ConductorMaterial that reflects Ks
//   half of Ks at most, both up to 1 together
//   otherwise                                   DiffuseMaterial: Kd, clamped to [0,1]; 0 if not given
//   map_Kd, map_Ks                              times the colour; alone where that is black or not given
//   d = 0 without Ni > 1                        InterfaceMaterial (Tr = 1 alone is opaque: mtl_material.cpp)
//   other d < 1 without Ni > 1, map_d           MaskMaterial around any of these
//   maps of numbers                             the channel of -imfchan; else luminance, of map_d alpha where
//                                               the image has one
//   map_bump, bump, disp; norm                  heights (times -bm), as a displacement; a normal map
//   Ke, map_Ke                                  area light, from both sides, since MTL has no sides
// `d` goes before `Tr` where both are given. Facets mask as Mitsuba's do (Masking::separable): MTL does not
// say.
MtlSurface add_mtl_material(const MtlMaterial& material, MtlTextures& textures, Scene& scene,
                            Diagnostics& diagnostics);

}  // namespace vitrail
