// SPDX-License-Identifier: Apache-2.0
// This class reads meshes before they are asked for, on the threads of the current arena.
#pragma once

#include <tbb/task_group.h>

#include <atomic>
#include <cstdint>
#include <deque>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <string>

#include "importers/ply/read/ply.h"
#include "scene/records/scene.h"

namespace vitrail {

// The reader of a scene gets the same, at the same time, as if it read each mesh itself when it asks for it.
// That holds for errors too.
class MeshReadAhead {
 public:
  struct Result {
    PbrtPly ply;
    Diagnostics diagnostics;
  };
  using Reader = std::function<Result(const std::filesystem::path&)>;  // from any thread

  // Reads at most so many bytes of files that are not asked for yet.
  MeshReadAhead(Reader reader, std::uint64_t most_bytes)
      : reader_(std::move(reader)), most_bytes_(most_bytes) {}
  ~MeshReadAhead();

  bool has_room() const { return bytes_ < most_bytes_; }
  // Says that this file may be asked for next but for those expected before. Returns false where there is no
  // room.
  bool expect(const std::filesystem::path& file);
  // Throws what the reader throws. Files that were expected before this one are forgotten.
  Result take(const std::filesystem::path& file);

 private:
  struct Entry {
    std::filesystem::path file;
    std::uint64_t bytes = 0;
    std::atomic<bool> claimed{false};
    Result result;
    std::exception_ptr error;
    tbb::task_group task;
  };
  void drop_first();

  Reader reader_;
  std::uint64_t most_bytes_, bytes_ = 0;
  std::deque<std::unique_ptr<Entry>> entries_;
  std::set<std::string> expected_;  // ever
};

}  // namespace vitrail
