// SPDX-License-Identifier: Apache-2.0
// Formats that take one light from all around get one in the place of several.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "importers/images/converted_images.h"
#include "importers/writing/conversion_notes.h"
#include "scene/records/light.h"

namespace vitrail {

// Makes the first of two or more of `lights` from all around one that shines as they do together: a constant
// of the summed spectra, or an image (linear sRGB, by latitude and longitude) that `images` names. The suns
// of their skies become parallel lights. `format` is in the notes, `directory` is the scene's. Throws
// MachineError where the image cannot be written.
void join_surroundings(ConversionNotes& notes, std::vector<Light>& lights, const std::string& format,
                       const ConvertedImages& images, const std::filesystem::path& directory);

}  // namespace vitrail
