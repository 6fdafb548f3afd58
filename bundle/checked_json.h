// SPDX-License-Identifier: Apache-2.0
// These functions handle small JSON files whose first line is a checksum of the rest.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <concepts>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "scene/system/diagnostics.h"

namespace vitrail {

// Returns the number of a key or at a place, which has to be there and to fit T: whole where T is, and
// finite. Throws Error that names it. (get<T>() takes any number, and gives an arbitrary T for 1e300.)
template <class T, class Key>
T number(const nlohmann::ordered_json& json, const Key& key) {
  const nlohmann::ordered_json& j = json.at(key);
  if constexpr (std::floating_point<T>) {
    const double value = j.is_number() ? j.get<double>() : NAN;
    if (std::abs(value) <= static_cast<double>(std::numeric_limits<T>::max())) return static_cast<T>(value);
  } else {
    if (j.is_number_unsigned() && std::in_range<T>(j.get<std::uint64_t>()))
      return static_cast<T>(j.get<std::uint64_t>());
    if (j.is_number_integer() && !j.is_number_unsigned() && std::in_range<T>(j.get<std::int64_t>()))
      return static_cast<T>(j.get<std::int64_t>());
  }
  throw Error(
      fmt::format("{} is {}, which is not a number that can stand there", key,
                  j.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace).substr(0, 40)));
}

// Writes an object with at least one member. Throws MachineError.
void write_checked_json(const std::filesystem::path& file, const nlohmann::ordered_json& json);

// Throws Error where the checksum is wrong, saying that `what` is damaged; MachineError where the file cannot
// be read.
nlohmann::ordered_json read_checked_json(const std::filesystem::path& file, const char* what);

}  // namespace vitrail
