// SPDX-License-Identifier: Apache-2.0
#include "scene/system/temporary_folder.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "scene/system/diagnostics.h"
#include "scene/system/memory_guard.h"

namespace vitrail {

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "vitrail-XXXXXX").string();
  if (!::mkdtemp(name.data())) throw MachineError("cannot make " + name + ": " + std::strerror(errno));
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  const GrantedMemory in_any_case;
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace vitrail
