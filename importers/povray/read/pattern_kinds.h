// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "importers/povray/read/surface.h"
#include "scene/records/pattern_texture.h"

namespace vitrail::pov {

// Returns the record's kind of a pattern's word, or none where it has no such.
std::optional<PatternTexture::Kind> pattern_kind(Word word);
// Returns the pattern in its own space, without a map; where the record lacks the kind, all but the kind. Its
// warps are left to the caller.
PatternTexture record_of(const Pattern& pattern);
// `none` is what the pattern has by default.
PatternTexture::Wave wave_of(Word wave, Word pattern);
// Returns whether `turbulence` does something else to the kind than a warp of turbulence.
bool is_turbulent_by_itself(PatternTexture::Kind kind);
// Returns povray 3.7's own colours of a pattern that is given no map. `spotted` has other ones than `bozo`,
// and `mandel` its own with the exponent 2 alone.
std::vector<BlendEntry> default_entries(const Pattern& pattern);
// Returns those of a pattern that is a list of colours, as `checker`.
std::vector<BlendEntry> list_entries(Word pattern);

}  // namespace vitrail::pov
