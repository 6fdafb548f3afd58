// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

namespace vitrail {

// It is room on a disk that others cannot take: a file without a name, which goes with the process however
// that ends. Where the file system cannot reserve (NFS before 4.2, some FUSE), it is only looked whether
// there is room now; writing zeros instead would send a film's bytes over the network for nothing.
class ReservedSpace {
 public:
  // Reserves room in the folder of `beside`. Throws MachineError where there is no room.
  ReservedSpace(std::filesystem::path beside, std::uint64_t bytes);
  ~ReservedSpace();
  ReservedSpace(const ReservedSpace&) = delete;
  ReservedSpace& operator=(const ReservedSpace&) = delete;

  void release();
  // Returns false where there is no room any more.
  bool renew();
  // Returns the time that a file of so many bytes takes on this disk, by a part of it that is written there
  // and synced.
  double time_to_write_s() const;

 private:
  std::filesystem::path beside_;
  std::uint64_t bytes_;
  int descriptor_ = -1;
};

}  // namespace vitrail
