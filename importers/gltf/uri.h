// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace vitrail::gltf {

// Returns the file "a b.png" in a folder for "a%20b.png".
std::filesystem::path file_from_uri(const std::string& uri, const std::filesystem::path& folder);
// Turns a relative name into a URI.
std::string uri_of(const std::string& name);

}  // namespace vitrail::gltf
