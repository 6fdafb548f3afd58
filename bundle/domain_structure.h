// SPDX-License-Identifier: Apache-2.0
// These functions check what has to be right in a domain file besides its checksums.
#pragma once

#include <filesystem>
#include <string>

#include "bundle/domain_file.h"

namespace vitrail {

// Throws Error that says how the file is damaged.
[[noreturn]] void reject_domain(const std::filesystem::path& file, const std::string& what);

// Throws Error unless sections fit to each other, trees are trees that reach everything, and instances stand
// somewhere.
void check_structure(const DomainView& view, const std::filesystem::path& file);

}  // namespace vitrail
