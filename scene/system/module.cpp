// SPDX-License-Identifier: Apache-2.0
#include "scene/system/module.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>

#include "scene/system/diagnostics.h"

namespace vitrail {

void* module_symbol(const std::string& module, const char* symbol, const char* what_for) {
  const auto beside = std::filesystem::read_symlink("/proc/self/exe").parent_path() / module;
  const auto installed = std::filesystem::path(VITRAIL_PROGRAM_FOLDER) / module;
  std::error_code unknown;
  const bool is_installed = std::filesystem::exists(installed, unknown);
  if (!std::filesystem::exists(beside, unknown) && !is_installed)
    throw MachineError(
        fmt::format("{} is missing, which {}: the package vitrail-images has it", beside.string(), what_for));
  const auto& file = std::filesystem::exists(beside, unknown) ? beside : installed;
  void* loaded = ::dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
  void* found = loaded ? ::dlsym(loaded, symbol) : nullptr;
  if (!found) throw MachineError(fmt::format("cannot load what {}: {}", what_for, ::dlerror()));
  return found;
}

}  // namespace vitrail
