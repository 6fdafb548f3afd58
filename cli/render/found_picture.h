// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "cli/render/frame_record.h"

namespace vitrail {

// Found says what lies under the name of a frame's picture.
enum class Found {
  missing,  // nothing, or what a render has not finished
  whole,    // the picture that is asked for
  damaged,  // the picture that is asked for was here, and cannot be read any more
  another,
};

struct FoundPicture {
  Found found = Found::missing;
  std::string words;  // of one that is damaged or another: why
};

// Compares the file with what is asked for and with its mark in the record, which is XXH3 of
// all its bytes. Where the mark differs, or there is none, vitrail-develop decodes the picture.
// `film` is the picture's work file.
FoundPicture find_picture(const std::filesystem::path& picture, const std::filesystem::path& film,
                          const FrameRecord& record, const WorkWords& asked);

}  // namespace vitrail
