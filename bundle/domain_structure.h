// SPDX-License-Identifier: Apache-2.0
// What has to be right in a domain file besides its bytes.
#pragma once

#include <filesystem>
#include <string>

#include "bundle/domain_file.h"

namespace vitrail {

// Throws Error: the file is damaged, and how.
[[noreturn]] void reject_domain(const std::filesystem::path& file, const std::string& what);

// Sections fit to each other, trees are trees that reach everything, instances stand somewhere.
void check_structure(const DomainView& view, const std::filesystem::path& file);

}  // namespace vitrail
