// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace vitrail::gltf {

// "a%20b.png" as the file "a b.png" in a folder.
std::filesystem::path file_from_uri(const std::string& uri, const std::filesystem::path& folder);
// And back, of a relative name.
std::string uri_of(const std::string& name);

}  // namespace vitrail::gltf
