// SPDX-License-Identifier: Apache-2.0
#include "partitioner/spilling/spill_instances.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

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

struct Closer {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using Stream = std::unique_ptr<std::FILE, Closer>;

}  // namespace

InstanceSpill::InstanceSpill(const std::filesystem::path& directory, const std::vector<Bounds3f>& cells,
                             const Bounds3f& root, std::uint64_t buffer_bytes)
    : most_waiting_(std::max<std::uint64_t>(buffer_bytes, 4096) / sizeof(InstanceRef)), parts_(cells.size()) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    parts_[i].cell = opened(cells[i], root);
    parts_[i].file = directory / fmt::format("{:06}.instances", i);
  }
}

void InstanceSpill::add(const InstanceRef& instance) {
  const Bounds3f box = padded_box(instance);
  for (Part& part : parts_) {
    if (!meet(part.cell, box)) continue;
    part.waiting.reserve(most_waiting_);
    part.waiting.push_back(instance);
    bytes_ += sizeof instance;
    if (part.waiting.size() >= most_waiting_) write(part);
  }
}

void InstanceSpill::write(Part& part) {
  const Stream out(std::fopen(part.file.c_str(), "ab"));
  if (!out) fail("open", part.file);
  if (std::fwrite(part.waiting.data(), sizeof(InstanceRef), part.waiting.size(), out.get()) !=
          part.waiting.size() ||
      std::fflush(out.get()) != 0)
    fail("write", part.file);
  part.in_file += part.waiting.size();
  part.waiting.clear();
}

void InstanceSpill::flush() {
  for (Part& part : parts_) {
    if (!part.waiting.empty()) write(part);
    part.waiting = {};
  }
}

std::vector<InstanceRef> InstanceSpill::take(std::size_t index) {
  Part& part = parts_[index];
  std::vector<InstanceRef> instances(part.in_file);
  if (part.in_file > 0) {
    const Stream in(std::fopen(part.file.c_str(), "rb"));
    if (!in) fail("open", part.file);
    if (std::fread(instances.data(), sizeof(InstanceRef), part.in_file, in.get()) != part.in_file)
      fail("read", part.file);
  }
  instances.insert(instances.end(), part.waiting.begin(), part.waiting.end());
  std::error_code ignored;
  std::filesystem::remove(part.file, ignored);
  part.waiting = {};
  part.in_file = 0;
  return instances;
}

}  // namespace vitrail
