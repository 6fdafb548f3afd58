// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace vitrail::mitsuba {

// Returns the text in UTF-8, where it is in another encoding: UTF-16 that begins with its byte order mark, or
// ISO 8859-1 (Windows-1252) by the declaration of an XML file. Half a surrogate pair becomes U+FFFD.
std::optional<std::string> in_utf8(std::string_view text);

}  // namespace vitrail::mitsuba
