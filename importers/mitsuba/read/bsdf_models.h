// SPDX-License-Identifier: Apache-2.0
// These functions read the kinds of BSDF. Each takes the <bsdf> and gives what it is, without its place and
// name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "importers/mitsuba/read/builder.h"

namespace vitrail::mitsuba {

// ---- plain_bsdfs.cpp: one surface or sheet, smooth or rough.
MaterialModel diffuse(Builder& builder, const Object& bsdf);        // diffuse, lambertian
MaterialModel rough_diffuse(Builder& builder, const Object& bsdf);  // 0.6's
MaterialModel dielectric(Builder& builder, const Object& bsdf);     // dielectric, roughdielectric
MaterialModel thin_dielectric(Builder& builder, const Object& bsdf);
MaterialModel plastic(Builder& builder, const Object& bsdf);  // plastic, roughplastic, pplastic
MaterialModel phong(Builder& builder, const Object& bsdf);    // 0.6's phong, ward
MaterialModel diffuse_transmitter(Builder& builder, const Object& bsdf);
MaterialModel nothing(Builder& builder, const Object& bsdf);     // null
MaterialModel polarizing(Builder& builder, const Object& bsdf);  // polarizer, retarder, circular

// ---- Those in files of their own.
MaterialModel conductor(Builder& builder, const Object& bsdf);  // conductor, roughconductor, mirror
MaterialModel hair(Builder& builder, const Object& bsdf);
MaterialModel principled(Builder& builder, const Object& bsdf);  // principled, principledthin
// It is 0.6's Hanrahan and Krueger model, which takes the first of the measured media by default.
MaterialModel slab(Builder& builder, const Object& bsdf);
MaterialModel measured(Builder& builder, const Object& bsdf);  // measured, measured_polarized
// It is a system of panes in a file, in the state that the object gives.
MaterialModel glazing_system(Builder& builder, const Object& bsdf, std::string file);

// ---- bsdf_mixtures.cpp: they are made of other materials, which stay as they are.
MaterialModel mask(Builder& builder, const Object& bsdf);
MaterialModel blend(Builder& builder, const Object& bsdf);
MaterialModel mixture(Builder& builder, const Object& bsdf);  // 0.6's

// ---- bsdf_adapters.cpp, coating_bsdf.cpp: they change the material inside of them and have no record of
// their own.
Material two_sided(Builder& builder, const Object& adapter);
Material bump_map(Builder& builder, const Object& adapter);  // bumpmap, bump
Material normal_map(Builder& builder, const Object& adapter);
Material coated(Builder& builder, const Object& adapter);  // 0.6's coating, roughcoating

// ---- bsdfs.cpp
// Returns the material inside of an adapter, not yet of the scene; without one throws Error.
Material inner_material(Builder& builder, const Object& adapter);

// ---- bsdf_parameters.cpp
// They return a reflectance in [0,1], and a factor, which is 1 where it is absent.
SpectrumParameter reflectance(Builder& builder, const Object& bsdf, const char* name, double otherwise);
SpectrumParameter factor(Builder& builder, const Object& bsdf, const char* name);
// Returns the roughness of microfacets; α is 0.1 where nothing is said.
Roughness roughness_of(Builder& builder, const Object& bsdf);
// Returns the product; of a texture, a texture of the scene at `origin`.
SpectrumParameter times(Builder& builder, const SpectrumParameter& value, const Spectrum& factor,
                        const Origin& origin);
SpectrumParameter times(Builder& builder, const SpectrumParameter& value, double factor,
                        const Origin& origin);
// Returns the nested <bsdf>s, in order; fewer than `least` or more than `most` throw Error.
std::vector<Id<Material>> nested_materials(Builder& builder, const Object& bsdf, std::size_t least,
                                           std::size_t most);

}  // namespace vitrail::mitsuba
