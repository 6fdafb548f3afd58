// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "importers/images/baked_textures.h"
#include "importers/images/converted_images.h"
#include "importers/writing/conversion_notes.h"
#include "importers/writing/export_colors.h"
#include "importers/writing/side_files.h"
#include "scene/records/scene.h"

namespace vitrail {

// It writes the statements of MTL materials, and notes what they do not say exactly.
class MtlText {
 public:
  // Makes the text of `file`, with images beside it.
  MtlText(const std::filesystem::path& file, ConversionNotes& of_record)
      : notes(of_record), scene_(of_record.scene), folder_(file.parent_path()), side_files_(file) {}

  std::string text;
  ConversionNotes& notes;
  void approximated(std::string message) { notes.approximated(std::move(message)); }

  void line(const char* keyword, RGB c);
  void line(const char* keyword, double value);
  void line(const char* keyword, float value);  // by the digits that a float needs

  // Writes "keyword options name" of an image, its scale as `scale_option` if there is one.
  void map(const char* keyword, const ImageTexture& image, ImageUse use, const char* scale_option);
  // Returns false where the texture is no image.
  bool map(const char* keyword, Id<Texture> id, ImageUse use, const char* scale_option);
  // Writes a colour, with the image that it multiplies.
  void color(const char* keyword, const char* map_keyword, const SpectrumParameter& parameter,
             RGB (*rgb)(const Spectrum&) = factor_rgb, double factor = 1);
  void number(const char* keyword, const char* map_keyword, const FloatParameter& parameter);
  // Returns the value, or 0.5 and a note where it is a texture.
  double constant(const FloatParameter& parameter, const char* what);

 private:
  std::string channel_option(const char* keyword, const ImageTexture& image);

  const Scene& scene_;
  std::filesystem::path folder_;
  SideFiles side_files_;
  std::size_t images_ = 0;
  BakedTextures baked_{scene_, [this] { return folder_ / side_files_.name("images", images_++, "png"); }};
};

}  // namespace vitrail
