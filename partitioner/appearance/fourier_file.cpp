// SPDX-License-Identifier: Apache-2.0
// pbrt-v3's files (Pharr, Jakob, Humphreys, "Physically Based Rendering", 3rd ed., 8.6): a header of 64
// bytes, nodes, integrals over them, (first, orders) of each pair, coefficients.
#include "partitioner/appearance/table_bytes.h"
#include "partitioner/appearance/table_files.h"

namespace vitrail {

FourierTable read_fourier_table(const std::filesystem::path& file) {
  const TableBytes bytes(file);
  if (!bytes.starts_with("SCATFUN\x01")) bytes.fail("not a table of Fourier coefficients");
  constexpr std::uint64_t header_bytes = 64;
  const auto count_at = [&](std::uint64_t offset) {
    const auto value = bytes.at<std::int32_t>(offset);
    if (value < 0) bytes.fail("the header of the table has a negative count");
    return static_cast<std::uint64_t>(value);
  };
  const std::uint64_t flags = count_at(8), nodes = count_at(12), coefficients = count_at(16),
                      orders = count_at(20), channels = count_at(24), bases = count_at(28);
  if (flags != 1 || bases != 1 || (channels != 1 && channels != 3))
    bytes.fail(
        "tables that textures interpolate, or of other colours than luminance and RGB, cannot be read");
  if (nodes > 65536) bytes.fail("the table has more nodes than its file");
  if (orders > max_fourier_orders) bytes.fail("the table has more than 4096 orders");

  FourierTable t;
  t.eta = bytes.at<float>(44);
  t.channels = static_cast<std::uint8_t>(channels);
  std::uint64_t at = header_bytes;
  t.mu = bytes.list<float>(at, nodes);
  const std::uint64_t pairs = nodes * nodes;
  at += 4 * nodes + 4 * pairs;  // its integrals are computed anew
  const auto places = bytes.list<std::uint32_t>(at, 2 * pairs);
  at += 8 * pairs;
  t.coefficients = bytes.list<float>(at, coefficients);
  for (std::size_t i = 0; i < pairs; ++i)
    t.first.push_back(places[2 * i]), t.orders.push_back(places[2 * i + 1]);
  if (const char* fault = fault_of(t)) bytes.fail(fault);
  return t;
}

}  // namespace vitrail
