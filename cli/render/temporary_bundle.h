// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "farm/transport/transport.h"

namespace vitrail {

// `vitrail partition` makes it of a scene on rank 0. All ranks construct it; its end removes the bundle.
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
