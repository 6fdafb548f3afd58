// SPDX-License-Identifier: Apache-2.0
// TableBytes are the bytes of a file of tables, little-endian; every access is within them.
#pragma once

#include <bit>
#include <cstring>
#include <string>
#include <vector>

#include "bundle/read_file.h"
#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"

namespace vitrail {

static_assert(std::endian::native == std::endian::little);

class TableBytes {
 public:
  explicit TableBytes(const std::filesystem::path& file) : file_(file) {
    if (!std::filesystem::is_regular_file(file))
      throw Error("cannot find the table of a material; --missing=replace continues without it",
                  {file.string()});
    check_input(file);
    bytes_ = read_file(file);
  }

  bool starts_with(std::string_view magic) const {
    return bytes_.size() >= magic.size() && std::memcmp(bytes_.data(), magic.data(), magic.size()) == 0;
  }
  template <class T>
  T at(std::uint64_t offset) const {
    T value;
    std::memcpy(&value, within(offset, 1, sizeof(T)), sizeof(T));
    return value;
  }
  template <class T>
  std::vector<T> list(std::uint64_t offset, std::uint64_t count) const {
    const std::byte* first = within(offset, count, sizeof(T));
    std::vector<T> values(static_cast<std::size_t>(count));
    if (count > 0) std::memcpy(values.data(), first, values.size() * sizeof(T));
    return values;
  }
  [[noreturn]] void fail(const std::string& what) const { throw Error(what, {file_.string()}); }

 private:
  const std::byte* within(std::uint64_t offset, std::uint64_t count, std::size_t size) const {
    if (offset > bytes_.size() || count > (bytes_.size() - offset) / size)
      fail("the table's file ends before what its header announces");
    return bytes_.data() + offset;
  }
  std::filesystem::path file_;
  std::vector<std::byte> bytes_;
};

}  // namespace vitrail
