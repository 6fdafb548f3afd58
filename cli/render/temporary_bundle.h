// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "farm/transport/transport.h"

namespace vitrail {

// Of a scene, made by `vitrail partition` on rank 0 and removed at the end. To be made by all ranks together.
class TemporaryBundle {
 public:
  TemporaryBundle(Transport& transport, const std::filesystem::path& scene, std::filesystem::path bundle,
                  const std::vector<std::string>& options);
  ~TemporaryBundle();
  TemporaryBundle(const TemporaryBundle&) = delete;
  TemporaryBundle& operator=(const TemporaryBundle&) = delete;

 private:
  Transport& transport_;
  std::filesystem::path bundle_;
};

}  // namespace vitrail
