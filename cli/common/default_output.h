// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace vitrail {

// What a picture is called where the user does not say: as the Film of a pbrt scene does, of which only the
// last part of a path counts, else after the input, in the current folder: "scene.exr". An extension that is
// not written becomes .exr.
std::filesystem::path default_output(const std::filesystem::path& input);

}  // namespace vitrail
