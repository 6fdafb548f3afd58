// SPDX-License-Identifier: Apache-2.0
// Small JSON files whose first line is a checksum of the rest.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace vitrail {

// An object with at least one member. Throws MachineError.
void write_checked_json(const std::filesystem::path& file, const nlohmann::ordered_json& json);

// Throws Error where the checksum is wrong, saying that `what` is damaged; MachineError where the file cannot
// be read.
nlohmann::ordered_json read_checked_json(const std::filesystem::path& file, const char* what);

}  // namespace vitrail
