// SPDX-License-Identifier: Apache-2.0
// These functions put glass into another state than the bundle was made with: the sheets of some materials
// are replaced before anything is traced.
#pragma once

#include <span>
#include <vector>

#include "bundle/kept_glazing.h"
#include "bundle/manifest.h"
#include "farm/transport/transport.h"

namespace vitrail {

// Gives every rank the sheets of rank 0: they come of exponentials, whose last digit depends on the machine.
void share_from_root(Transport& transport, std::vector<SetSheet>& sheets);

// Replaces the sheets. Where that changes one, the scene is another: so is its hash. Throws Error (in the
// manifest's name, `bundle`) where a material is no sheet.
void set_sheets(std::span<const SetSheet> sheets, const std::filesystem::path& bundle, Manifest& manifest);

}  // namespace vitrail
