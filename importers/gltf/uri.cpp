// SPDX-License-Identifier: Apache-2.0
#include "importers/gltf/uri.h"
#include "importers/reading/named_file.h"

#include <fmt/format.h>

#include <charconv>
#include <string_view>

namespace vitrail::gltf {

std::filesystem::path file_from_uri(const std::string& uri, const std::filesystem::path& folder) {
  std::string name;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned char byte = 0;
    if (uri[i] == '%' && i + 2 < uri.size() &&
        std::from_chars(uri.data() + i + 1, uri.data() + i + 3, byte, 16).ptr == uri.data() + i + 3) {
      name += static_cast<char>(byte), i += 2;
    } else {
      name += uri[i];
    }
  }
  return named_file(name, folder);
}

std::string uri_of(const std::string& name) {
  constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
  std::string uri;
  for (const char c : name)
    uri += plain.find(c) != std::string_view::npos ? std::string(1, c)
                                                   : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return uri;
}

}  // namespace vitrail::gltf
