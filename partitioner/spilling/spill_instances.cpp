// SPDX-License-Identifier: Apache-2.0
#include "partitioner/spilling/spill_instances.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "partitioner/writing/write_objects.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

[[noreturn]] void fail(const char* what, const std::filesystem::path& file) {
  throw MachineError(fmt::format("cannot {} {}: {}", what, file.string(), std::strerror(errno)));
}

bool meet(const Bounds3f& a, const Bounds3f& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(a.lower[axis] <= b.upper[axis] && a.upper[axis] >= b.lower[axis])) return false;
  return true;
}

}  // namespace

InstanceSpill::InstanceSpill(const std::filesystem::path& directory, const std::vector<Bounds3f>& cells,
                             const Bounds3f& root, std::uint64_t buffer_bytes)
    : parts_(cells.size()) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    Part& part = parts_[i];
    part.cell = opened(cells[i], root);
    part.file = directory / fmt::format("{:06}.instances", i);
    part.stream.reset(std::fopen(part.file.c_str(), "w+b"));
    if (!part.stream) fail("open", part.file);
    std::setvbuf(part.stream.get(), nullptr, _IOFBF, std::max<std::uint64_t>(buffer_bytes, 4096));
  }
}

void InstanceSpill::add(const InstanceRef& instance) {
  const Bounds3f box = padded_box(instance);
  for (Part& part : parts_) {
    if (!meet(part.cell, box)) continue;
    if (std::fwrite(&instance, sizeof instance, 1, part.stream.get()) != 1) fail("write", part.file);
    ++part.count;
    bytes_ += sizeof instance;
  }
}

std::vector<InstanceRef> InstanceSpill::take(std::size_t index) {
  Part& part = parts_[index];
  std::vector<InstanceRef> instances(part.count);
  if (std::fflush(part.stream.get()) != 0) fail("write", part.file);
  std::rewind(part.stream.get());
  if (std::fread(instances.data(), sizeof(InstanceRef), part.count, part.stream.get()) != part.count)
    fail("read", part.file);
  part.stream.reset();
  std::error_code ignored;
  std::filesystem::remove(part.file, ignored);
  return instances;
}

}  // namespace vitrail
