// SPDX-License-Identifier: Apache-2.0
#include "bundle/read_file.h"

#include <fmt/format.h>

#include <cstring>

#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"
#include "scene/system/underway.h"

namespace vitrail {

std::vector<std::byte> read_file(const std::filesystem::path& file) {
  note_input(file);
  const Underway underway("reading", file);
  const RegularFile in(file);
  if (!in.is_open())
    throw MachineError(fmt::format("cannot open {}: {}", file.string(), std::strerror(in.reason())));
  std::vector<std::byte> bytes(in.size());
  if (!in.read(bytes, 0)) throw MachineError(fmt::format("cannot read {}", file.string()));
  return bytes;
}

}  // namespace vitrail
