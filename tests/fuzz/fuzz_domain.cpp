// SPDX-License-Identifier: Apache-2.0
// A domain file whose checksums are put right, as far as its table says where its sections are.
#include <cstring>
#include <vector>

#include "bundle/checksum.h"
#include "bundle/domain_file.h"
#include "bundle/domain_layout.h"
#include "tests/fuzz/fuzz_reader.h"

namespace {

using namespace vitrail;

template <class T>
T at(const std::vector<std::byte>& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, &bytes[offset], sizeof value);
  return value;
}

void repair(std::vector<std::byte>& bytes) {
  if (bytes.size() < sizeof(layout::DomainHeader)) return;
  auto header = at<layout::DomainHeader>(bytes, 0);
  const std::uint64_t header_bytes = layout::header_bytes(header.sections);
  if (header.sections > layout::most_sections || header_bytes > bytes.size()) return;
  for (std::size_t i = 0; i < header.sections; ++i) {
    const std::size_t place = sizeof header + i * sizeof(layout::Section);
    auto section = at<layout::Section>(bytes, place);
    if (section.offset > bytes.size() || section.count > bytes.size() || section.element_size > 4096)
      continue;
    const std::uint64_t size = layout::padded_bytes(section.count, section.element_size);
    if (size > bytes.size() - section.offset) continue;
    section.checksum = checksum(std::span(bytes).subspan(section.offset, size));
    std::memcpy(&bytes[place], &section, sizeof section);
  }
  header.file_bytes = bytes.size();
  header.header_checksum =
      layout::checksum_of(header, std::span(bytes).subspan(sizeof header, header_bytes - sizeof header));
  std::memcpy(bytes.data(), &header, sizeof header);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::run([&] {
    const auto* first = reinterpret_cast<const std::byte*>(data);
    std::vector<std::byte> bytes(first, first + size);
    repair(bytes);
    const auto* repaired = reinterpret_cast<const std::uint8_t*>(bytes.data());
    const MappedDomain domain(fuzz::write("a.dom", repaired, bytes.size()));
    domain.check_cold();
    static_cast<void>(domain.pieces());
  });
}
