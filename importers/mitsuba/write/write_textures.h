// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "importers/mitsuba/write/write_images.h"
#include "importers/mitsuba/write/write_spectra.h"

namespace vitrail::mitsuba_writer {

// Writes every texture that Mitsuba knows as an element with an id; the others become values in
// context.textures.
void write_textures(Context& context, Element root);

void add_parameter(Context& context, Element parent, const std::string& name, const SpectrumParameter& value,
                   Meaning meaning);
void add_parameter(Context& context, Element parent, const std::string& name, const FloatParameter& value);

// They return one value for a parameter where Mitsuba takes no texture (`what`, for the report).
Spectrum constant_of(Context& context, const SpectrumParameter& value, const char* what);
float constant_of(Context& context, const FloatParameter& value, const char* what);

// They return the value, unless it is a texture with an element of its own.
std::optional<Spectrum> value_of(const Context& context, const SpectrumParameter& value);
std::optional<float> value_of(const Context& context, const FloatParameter& value);

// Adds an image within another element; `image` says how it is looked up.
void add_bitmap(Context& context, Element parent, const std::string& name, const MitsubaImage& written,
                const ImageTexture& image);

// Adds the colours of an image under D65: Mitsuba would take white for a flat spectrum.
void add_lit_image(Context& context, Element emitter, const char* name, const SpectrumParameter& image,
                   float scale);

}  // namespace vitrail::mitsuba_writer
