// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "bundle/checksum.h"
#include "bundle/domain_file.h"
#include "bundle/domain_layout.h"
#include "bundle/domain_structure.h"
#include "bundle/features.h"
#include "bundle/piece_code.h"
#include "bundle/watched_files.h"
#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"

namespace vitrail {

namespace {

constexpr std::uint32_t known_features = required_feature::normals | required_feature::uvs |
                                         required_feature::attributes | required_feature::instances;

constexpr std::array<std::size_t, 7> traced_sections{
    layout::nodes,      layout::clusters,  layout::normals,       layout::uvs,
    layout::attributes, layout::instances, layout::instance_nodes};
constexpr std::array<std::size_t, 3> piece_sections{layout::pieces, layout::piece_corners,
                                                    layout::cut_vertices};

// Bytes from the begin of the system's page, which is where a mapping begins.
std::size_t in_page(std::uint64_t place) { return place % static_cast<std::size_t>(::getpagesize()); }
std::size_t in_page(const std::byte* data) { return in_page(reinterpret_cast<std::uintptr_t>(data)); }

std::span<const std::byte> map(const RegularFile& in, const Stored& stored) {
  if (!in.is_open())
    throw MachineError(fmt::format("cannot open {}: {}", stored.file.string(), std::strerror(in.reason())));
  watch(stored.file, in.status());
  if (in.size() == 0) reject_domain(stored.file, "it is empty");
  const std::uint64_t bytes = stored.bytes.value_or(in.size());
  if (stored.offset > in.size() || bytes > in.size() - stored.offset)
    reject_domain(stored.name(),
                  fmt::format("it has {} bytes, and its pack ends at byte {}", bytes, in.size()));
  const std::size_t lead = in_page(stored.offset);
  void* const data = ::mmap(nullptr, bytes + lead, PROT_READ, MAP_PRIVATE, in.descriptor(),
                            static_cast<off_t>(stored.offset - lead));
  if (data == MAP_FAILED)
    throw MachineError(fmt::format("cannot map {}: {}", stored.name().string(), std::strerror(errno)));
  return {static_cast<const std::byte*>(data) + lead, bytes};
}

void unmap(const std::byte* data, std::uint64_t bytes) {
  const std::size_t lead = in_page(data);
  ::munmap(const_cast<std::byte*>(data) - lead, bytes + lead);
}

const layout::DomainHeader& header_of(const std::byte* data) {
  return *reinterpret_cast<const layout::DomainHeader*>(data);
}

std::span<const layout::Section> table_of(const std::byte* data) {
  return {reinterpret_cast<const layout::Section*>(data + sizeof(layout::DomainHeader)),
          header_of(data).sections};
}

template <class T>
std::span<const T> elements(const std::byte* data, layout::SectionIndex index) {
  const layout::Section& s = table_of(data)[index];
  return {reinterpret_cast<const T*>(data + s.offset), s.count};
}

// Reads what is mapped there: where the disk fails, touching it would be a signal.
void fault_in(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  if (bytes.empty()) return;
  const std::size_t lead = in_page(bytes.data());
  if (::madvise(const_cast<std::byte*>(bytes.data()) - lead, bytes.size() + lead, MADV_POPULATE_READ) == 0 ||
      (errno != EFAULT && errno != EHWPOISON))
    return;
  require_unchanged_files();  // it may have been cut since it was opened
  throw MachineError(fmt::format("cannot read {}: {}", file.string(), std::strerror(EIO)));
}

// The sections known here come first and in order, others of ascending kinds may follow; none leaves a gap.
void check_table(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  const std::span<const layout::Section> table = table_of(bytes.data());
  std::uint64_t expected = layout::header_bytes(table.size());
  for (std::size_t i = 0; i < table.size(); ++i) {
    const layout::Section& s = table[i];
    const bool known = i < layout::section_count;
    const bool right_kind = known ? s.kind == i && s.element_size == layout::element_size[i]
                                  : s.kind > table[i - 1].kind && s.element_size > 0;
    if (!right_kind || s.offset != expected || s.count > bytes.size() / s.element_size)
      reject_domain(file, fmt::format("section {} has a wrong size or place", i));
    expected += layout::padded_bytes(s.count, s.element_size);
  }
  if (expected != bytes.size()) reject_domain(file, "its sections do not fill it");
}

void check_header(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  fault_in(file, bytes.first(1));
  const layout::DomainHeader& header = header_of(bytes.data());
  if (bytes.size() < 16 || header.magic != layout::domain_magic)
    throw Error("not a domain file", {file.string()});
  if (header.version != layout::domain_version)
    throw Error(fmt::format("domain file of version {}; this program reads version {}", header.version,
                            layout::domain_version),
                {file.string()});
  if (header.sections < layout::section_count || header.sections > layout::most_sections)
    reject_domain(file, fmt::format("it cannot have {} sections", header.sections));
  const std::uint64_t header_bytes = layout::header_bytes(header.sections);
  if (bytes.size() < header_bytes) reject_domain(file, "its header is cut short");
  fault_in(file, bytes.first(header_bytes));
  if (header.header_checksum !=
      layout::checksum_of(header, bytes.subspan(sizeof(header), header_bytes - sizeof(header))))
    reject_domain(file, "the checksum of its header is wrong");
  if (header.file_bytes != bytes.size())
    reject_domain(file, fmt::format("it has {} bytes and should have {}", bytes.size(), header.file_bytes));
  check_table(file, bytes);
  const Features own = layout::features_of(table_of(bytes.data()));
  refuse_unknown(header.features.required, known_features, file);
  if (header.features.required != own.required || (own.optional & ~header.features.optional) != 0)
    reject_domain(file, "its features are not those of its sections");
}

std::string describe(const layout::Section& s) {
  const std::string name =
      s.kind < layout::section_count ? layout::section_name[s.kind] : fmt::format("kind {}", s.kind);
  return fmt::format("{} (bytes {} to {})", name, s.offset,
                     s.offset + layout::padded_bytes(s.count, s.element_size));
}

void check_sections(const std::filesystem::path& file, const std::byte* data,
                    std::span<const std::size_t> indices) {
  std::string wrong;
  for (const std::size_t i : indices) {
    const layout::Section& s = table_of(data)[i];
    const std::span bytes(data + s.offset, layout::padded_bytes(s.count, s.element_size));
    fault_in(file, bytes);
    if (checksum(bytes) != s.checksum) wrong += (wrong.empty() ? "" : ", ") + describe(s);
  }
  if (!wrong.empty()) reject_domain(file, "wrong checksum of " + wrong);
}

}  // namespace

std::filesystem::path Stored::name() const {
  if (!bytes) return file;
  std::filesystem::path part = file;
  return part += fmt::format(" at byte {}", offset);
}

MappedDomain::MappedDomain(const Stored& stored, std::optional<std::uint64_t> checked)
    : MappedDomain(RegularFile(stored.file), stored, checked) {}

MappedDomain::MappedDomain(const RegularFile& open, const Stored& stored,
                           std::optional<std::uint64_t> checked)
    : file_(stored.name()) {
  const std::span<const std::byte> bytes = map(open, stored);
  data_ = bytes.data();
  bytes_ = bytes.size();
  try {
    check_header(file_, bytes);
    check_sections(file_, data_, traced_sections);
    view_ = {elements<BvhNode>(data_, layout::nodes),
             elements<Cluster>(data_, layout::clusters),
             elements<ClusterNormals>(data_, layout::normals),
             elements<ClusterUvs>(data_, layout::uvs),
             elements<ClusterAttributes>(data_, layout::attributes),
             elements<InstanceRef>(data_, layout::instances),
             elements<BvhNode>(data_, layout::instance_nodes),
             {}};
    if (checked != hash()) check_structure(view_, file_);
    view_.reach = reach_of(view_);
  } catch (...) {
    unmap(data_, bytes_);
    throw;
  }
}

MappedDomain::~MappedDomain() { unmap(data_, bytes_); }

const layout::DomainHeader& MappedDomain::header() const { return header_of(data_); }
std::span<const layout::Section> MappedDomain::sections() const { return table_of(data_); }
std::uint64_t MappedDomain::hash() const { return header().header_checksum; }

void MappedDomain::check_cold() const {
  std::vector<std::size_t> cold(piece_sections.begin(), piece_sections.end());
  for (std::size_t i = layout::section_count; i < sections().size(); ++i) cold.push_back(i);
  check_sections(file_, data_, cold);
}

PieceList MappedDomain::pieces() const {
  check_sections(file_, data_, piece_sections);
  return decode_pieces(view_.clusters, elements<std::uint32_t>(data_, layout::pieces),
                       elements<PieceCorner>(data_, layout::piece_corners),
                       elements<Point3d>(data_, layout::cut_vertices), file_);
}

std::vector<InstanceRef> read_instances(const Stored& stored) {
  const std::filesystem::path file = stored.name();
  const std::span<const std::byte> bytes = map(RegularFile(stored.file), stored);
  const auto release = [&](const std::byte* data) { unmap(data, bytes.size()); };
  const std::unique_ptr<const std::byte, decltype(release)> mapped(bytes.data(), release);
  check_header(file, bytes);
  check_sections(file, bytes.data(), std::array{std::size_t{layout::instances}});
  const auto instances = elements<InstanceRef>(bytes.data(), layout::instances);
  return {instances.begin(), instances.end()};
}

}  // namespace vitrail
