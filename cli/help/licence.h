// SPDX-License-Identifier: Apache-2.0
// This file has the licence of each program, which depends on the libraries that are linked into it.
#pragma once

#include <string>
#include <string_view>

namespace vitrail {

// The SPDX expression of a verb's program; of the front program where `verb` is no verb.
std::string_view licence_of(std::string_view verb);

// Returns two lines for --version: the version, and the licence of that program.
std::string version_text(std::string_view version, std::string_view verb);

}  // namespace vitrail
