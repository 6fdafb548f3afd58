// SPDX-License-Identifier: Apache-2.0
// What the pictures of --frames are of: a picture, unlike a film, does not tell it itself.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "farm/run/work_words.h"

namespace vitrail {

// A JSON file beside the pictures: what each was asked to be, by its name.
class FrameRecord {
 public:
  // Reads the file, if it is there. Throws Error where it is no such file.
  explicit FrameRecord(std::filesystem::path file);

  // In what the picture is other work than what is asked for; "" where it is the same.
  std::string differences(const std::filesystem::path& picture, const WorkWords& asked) const;

  // Both write the file. They throw MachineError.
  void put(const std::filesystem::path& picture, const WorkWords& work);
  void remove(const std::filesystem::path& picture);

 private:
  void write() const;

  std::filesystem::path file_;
  nlohmann::ordered_json pictures_ = nlohmann::ordered_json::object();
};

}  // namespace vitrail
