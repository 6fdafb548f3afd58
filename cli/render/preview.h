// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <filesystem>

namespace vitrail {

// A Preview makes pictures of a running render: a program of its own develops each checkpoint, beside the
// work. A checkpoint that comes while the last is still developed is left out. The picture is whole at any
// moment; a picture that cannot be made ends nothing.
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
