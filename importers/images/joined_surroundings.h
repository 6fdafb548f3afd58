// SPDX-License-Identifier: Apache-2.0
// One light from all around in the place of several, for formats that take one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "importers/images/converted_images.h"
#include "importers/writing/conversion_notes.h"
#include "scene/records/light.h"

namespace vitrail {

// Where `lights` has two or more from all around, the first becomes one that shines as they do together: a
// constant of the summed spectra, or an image (linear sRGB, by latitude and longitude) that `images` names.
// The suns of their skies become parallel lights. `format` is in the notes, `directory` is the scene's.
// Throws MachineError where the image cannot be written.
void join_surroundings(ConversionNotes& notes, std::vector<Light>& lights, const std::string& format,
                       const ConvertedImages& images, const std::filesystem::path& directory);

}  // namespace vitrail
