// SPDX-License-Identifier: Apache-2.0
#include "bundle/read_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "scene/diagnostics.h"
#include "scene/input_files.h"

namespace vitrail {

std::vector<std::byte> read_file(const std::filesystem::path& file) {
  note_input(file);
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in) throw MachineError(fmt::format("cannot open {}: {}", file.string(), std::strerror(errno)));
  const std::streamoff size = in.tellg();
  if (size < 0) throw MachineError(fmt::format("cannot read {}", file.string()));
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  in.seekg(0);
  in.read(reinterpret_cast<char*>(bytes.data()), size);
  if (!in) throw MachineError(fmt::format("cannot read {}", file.string()));
  return bytes;
}

}  // namespace vitrail
