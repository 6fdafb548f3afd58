// SPDX-License-Identifier: Apache-2.0
// A BucketSpill takes triangles to disk and back: a file for each part of the kd-tree that is
// to be in memory at once.
#pragma once

#include <filesystem>
#include <mutex>
#include <vector>

#include "partitioner/cutting/cut.h"

namespace vitrail {

// A LoadedCell has its own triangles: `cut` has the pieces of those that are not whole in it.
struct LoadedCell {
  NumberedTriangles triangles;
  CellContent cut;
};

// The files are private to this object: nobody else reads them, and the destructor removes them.
class BucketSpill {
 public:
  // Makes the directory. `buffer_bytes` are in memory for each bucket before they are written.
  BucketSpill(std::filesystem::path directory, std::size_t buckets, const PlacementRule& rule,
              std::uint64_t buffer_bytes);
  ~BucketSpill();
  BucketSpill(const BucketSpill&) = delete;
  BucketSpill& operator=(const BucketSpill&) = delete;

  // Adds what a block has in a bucket. Blocks do not overlap in their ids; in any order, from
  // any thread. Throws MachineError.
  void add(std::size_t bucket, const NumberedTriangles& block, const CellContent& content);
  void flush();
  // Returns a bucket, ascending by id. Its file is gone then. Throws MachineError.
  LoadedCell take(std::size_t bucket);

  std::uint64_t bytes() const { return bytes_; }

 private:
  // A Chunk is where a block's part is in the file.
  struct Chunk {
    std::uint64_t offset;
    std::uint32_t first_id, triangles, pieces, vertices;
  };
  struct Bucket {
    std::filesystem::path file;
    std::vector<std::byte> buffer;
    std::uint64_t written = 0;
    std::vector<Chunk> chunks;
    std::mutex mutex;
  };
  void write(Bucket& bucket);
  std::size_t bytes_of(const Chunk& chunk) const;

  std::filesystem::path directory_;
  PlacementRule rule_;
  std::uint64_t buffer_bytes_;
  std::vector<Bucket> buckets_;
  std::uint64_t bytes_ = 0;
};

}  // namespace vitrail
