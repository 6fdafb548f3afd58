// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <filesystem>

namespace vitrail {

// Pictures of a render that goes on: each checkpoint is developed by a program of its own, beside the work.
// One that comes while the last is still developed is left out. The picture is whole at any moment; that it
// cannot be made ends nothing.
class Preview {
 public:
  explicit Preview(std::filesystem::path picture) : picture_(std::move(picture)) {}
  ~Preview() { finish(); }
  Preview(const Preview&) = delete;
  Preview& operator=(const Preview&) = delete;

  void develop(const std::filesystem::path& film);
  void finish();

 private:
  bool busy();

  std::filesystem::path picture_;
  pid_t developing_ = 0;  // 0: none is
};

}  // namespace vitrail
