// SPDX-License-Identifier: Apache-2.0
// Files of the material database of EPFL's Realistic Graphics Lab: named tensors. "tensor_file\0", a version
// of two bytes (1, 0), the number of fields (u32); a field: the length of its name (u16), the name, the
// number of dimensions (u16), the type (u8; 1: uint8, 10: float32), where its values are (u64), the
// dimensions (u64).
#include <map>

#include "partitioner/appearance/table_bytes.h"
#include "partitioner/appearance/table_files.h"

namespace vitrail {

namespace {

constexpr std::uint8_t type_byte = 1, type_float = 10;

struct Field {
  std::uint8_t type = 0;
  std::uint64_t offset = 0;
  std::vector<std::uint64_t> shape;
};

std::map<std::string, Field> fields_of(const TableBytes& bytes) {
  if (!bytes.starts_with(std::string_view("tensor_file\0", 12)))
    bytes.fail("not a table of measurements: it is no tensor file");
  if (bytes.at<std::uint8_t>(12) != 1) bytes.fail("a tensor file of a version that is not known");
  std::map<std::string, Field> fields;
  std::uint64_t at = 18;
  for (auto left = bytes.at<std::uint32_t>(14); left > 0; --left) {
    const auto name = bytes.list<char>(at + 2, bytes.at<std::uint16_t>(at));
    at += 2 + name.size();
    Field field{bytes.at<std::uint8_t>(at + 2), bytes.at<std::uint64_t>(at + 3), {}};
    field.shape = bytes.list<std::uint64_t>(at + 11, bytes.at<std::uint16_t>(at));
    at += 11 + 8 * field.shape.size();
    fields.emplace(std::string(name.begin(), name.end()), std::move(field));
  }
  return fields;
}

class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : bytes_(file), fields_(fields_of(bytes_)) {}

  std::vector<float> list(const char* name) const { return floats(field(name, 1, type_float)); }
  SquareTable square(const char* name, std::size_t dimensions) const {
    const Field& f = field(name, dimensions, type_float);
    const std::uint64_t rows = f.shape[dimensions - 2], columns = f.shape[dimensions - 1];
    if (rows > 65536 || columns > 65536) bytes_.fail("a tensor is larger than its file");
    return {static_cast<std::uint32_t>(rows), static_cast<std::uint32_t>(columns), floats(f)};
  }
  bool flag(const char* name) const { return bytes_.at<std::uint8_t>(field(name, 1, type_byte).offset) != 0; }
  void check(const AdaptiveTable& table) const {
    if (const char* fault = fault_of(table)) bytes_.fail(fault);
    if (table.luminance.rows != table.spectra.rows || table.luminance.columns != table.spectra.columns)
      bytes_.fail("spectra and luminance of the table are of different sizes");
  }

 private:
  const Field& field(const char* name, std::size_t dimensions, std::uint8_t type) const {
    const auto found = fields_.find(name);
    if (found == fields_.end()) bytes_.fail(std::string("the table has no \"") + name + "\"");
    if (found->second.shape.size() != dimensions || found->second.type != type)
      bytes_.fail(std::string("\"") + name + "\" of the table is not what it should be");
    return found->second;
  }
  std::vector<float> floats(const Field& f) const {
    std::uint64_t count = 1;
    for (const std::uint64_t n : f.shape) {
      if (n == 0 || n > (std::uint64_t{1} << 40) / count) bytes_.fail("a tensor is larger than its file");
      count *= n;
    }
    return bytes_.list<float>(f.offset, count);
  }

  TableBytes bytes_;
  std::map<std::string, Field> fields_;
};

}  // namespace

AdaptiveTable read_adaptive_table(const std::filesystem::path& file) {
  const Reader in(file);
  AdaptiveTable t{.phi_i = in.list("phi_i"),
                  .theta_i = in.list("theta_i"),
                  .wavelengths_nm = in.list("wavelengths"),
                  .normals = in.square("ndf", 2),
                  .projected_area = in.square("sigma", 2),
                  .visible_normals = in.square("vndf", 4),
                  .luminance = in.square("luminance", 4),
                  .spectra = in.square("spectra", 5),
                  .normalised = in.flag("jacobian")};
  in.check(t);
  return t;
}

}  // namespace vitrail
