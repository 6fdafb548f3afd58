// SPDX-License-Identifier: Apache-2.0
// A FrameRecord says what the pictures of --frames are of: a picture, unlike a film, does not tell it itself.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "farm/run/work_words.h"

namespace vitrail {

// A FileMark is that of a file as it was written.
struct FileMark {
  std::uint64_t bytes = 0, hash = 0;  // XXH3
  bool operator==(const FileMark&) const = default;
};

// Reads the file and returns its mark. Throws MachineError where it cannot be read.
FileMark mark_of(const std::filesystem::path& file);

// A FrameRecord is a JSON file beside the pictures: by its name, what each was asked to be, and its mark once
// it is written. Several processes may share one.
class FrameRecord {
 public:
  // Reads the file, if it is there. Throws Error where it is no such file.
  explicit FrameRecord(std::filesystem::path file);

  // Takes what others have written meanwhile.
  void read_again();

  // Returns in what the picture is other work than what is asked for; "" where it is the same.
  std::string differences(const std::filesystem::path& picture, const WorkWords& asked) const;

  // Returns nothing where no mark was kept, as by versions before.
  std::optional<FileMark> mark(const std::filesystem::path& picture) const;

  // Both read the file again and write it; meanwhile nobody else does. They throw MachineError.
  void put(const std::filesystem::path& picture, const WorkWords& work, const FileMark& mark);
  void remove(const std::filesystem::path& picture);

 private:
  void change(const std::function<bool(nlohmann::ordered_json& pictures)>& changed);
  void write() const;

  std::filesystem::path file_;
  nlohmann::ordered_json pictures_ = nlohmann::ordered_json::object();
};

}  // namespace vitrail
