// SPDX-License-Identifier: Apache-2.0
#include "importers/gltf/read/accessors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace vitrail::gltf {

namespace {

constexpr const char* accessors = "accessors";
constexpr std::size_t most_without_data = std::size_t{1} << 26;  // elements that no buffer vouches for

// Rows of elements within a buffer.
struct Rows {
  const unsigned char* begin = nullptr;
  std::size_t stride = 0;
};

// `size` bytes an element, `count` of them from `offset` in the view on; fails where the view or its buffer
// end before.
Rows rows_of(const Document& document, int accessor, int view_index, std::size_t offset, std::size_t size,
             std::size_t count, bool tight) {
  const tinygltf::Model& model = document.model();
  const auto& view = document.element(model.bufferViews, view_index, "bufferViews", accessors, accessor);
  const auto& buffer = document.element(model.buffers, view.buffer, "buffers", "bufferViews", view_index);
  if (view.byteOffset > buffer.data.size() || view.byteLength > buffer.data.size() - view.byteOffset)
    document.fail(
        "bufferViews", view_index,
        fmt::format("ends behind buffers[{}], which has {} bytes", view.buffer, buffer.data.size()));
  const std::size_t stride = view.byteStride == 0 || tight ? size : view.byteStride;
  if (stride < size)
    document.fail("bufferViews", view_index, fmt::format("its stride of {} is less than an element", stride));
  if (count > 0 && (offset > view.byteLength || size > view.byteLength - offset ||
                    (count - 1) > (view.byteLength - offset - size) / stride))
    document.fail(accessors, accessor,
                  fmt::format("{} elements of {} bytes end behind bufferViews[{}], which has {} bytes", count,
                              size, view_index, view.byteLength));
  return {buffer.data.data() + view.byteOffset + offset, stride};
}

template <class T>
T load(const unsigned char* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

int size_of(int component_type) {
  switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

float number_at(const unsigned char* from, int type, bool normalized) {
  const auto of = [&](auto value, float greatest) {
    const auto v = static_cast<float>(value);
    return normalized ? std::max(v / greatest, -1.0f) : v;
  };
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return of(load<std::int8_t>(from), 127);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return of(load<std::uint8_t>(from), 255);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return of(load<std::int16_t>(from), 32767);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return of(load<std::uint16_t>(from), 65535);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return static_cast<float>(load<std::uint32_t>(from));
    default:
      return load<float>(from);
  }
}

std::uint32_t integer(const unsigned char* from, int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load<std::uint8_t>(from);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(from);
    default:
      return load<std::uint32_t>(from);
  }
}

bool is_unsigned(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

const tinygltf::Accessor& accessor_of(const Document& document, int index) {
  const auto& all = document.model().accessors;
  if (index < 0 || static_cast<std::size_t>(index) >= all.size())
    throw Error(fmt::format("there is no accessors[{}]: there are {}", index, all.size()),
                {document.file().string()});
  return all[static_cast<std::size_t>(index)];
}

// Gives `put(element, component, from)` every number that the accessor has.
template <class Put>
void visit(const Document& document, int index, int components, Put put) {
  const tinygltf::Accessor& a = accessor_of(document, index);
  const int each = size_of(a.componentType);
  if (each == 0)
    document.fail(accessors, index, fmt::format("its componentType {} is none of glTF's", a.componentType));
  if (components_of(document, index) != components)
    document.fail(accessors, index,
                  fmt::format("has {} numbers an element where {} are meant", components_of(document, index),
                              components));
  const auto width = static_cast<std::size_t>(each), size = width * static_cast<std::size_t>(components);
  const auto put_element = [&](std::size_t element, const unsigned char* from) {
    for (int c = 0; c < components; ++c) put(element, c, from + static_cast<std::size_t>(c) * width);
  };
  if (a.bufferView >= 0) {
    const Rows rows = rows_of(document, index, a.bufferView, a.byteOffset, size, a.count, false);
    for (std::size_t i = 0; i < a.count; ++i) put_element(i, rows.begin + i * rows.stride);
  }
  if (!a.sparse.isSparse) return;
  const auto& indices = a.sparse.indices;
  const auto& values = a.sparse.values;
  if (a.sparse.count < 0 || indices.byteOffset < 0 || values.byteOffset < 0 ||
      !is_unsigned(indices.componentType))
    document.fail(accessors, index, "its sparse part has a negative number, or indices of a wrong type");
  const auto count = static_cast<std::size_t>(a.sparse.count);
  const auto index_size = static_cast<std::size_t>(size_of(indices.componentType));
  const Rows at = rows_of(document, index, indices.bufferView, static_cast<std::size_t>(indices.byteOffset),
                          index_size, count, true);
  const Rows from = rows_of(document, index, values.bufferView, static_cast<std::size_t>(values.byteOffset),
                            size, count, true);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t element = integer(at.begin + i * at.stride, indices.componentType);
    if (element >= a.count)
      document.fail(accessors, index,
                    fmt::format("its sparse index {} is beyond its {} elements", element, a.count));
    put_element(element, from.begin + i * from.stride);
  }
}

}  // namespace

std::size_t count_of(const Document& document, int index) {
  const tinygltf::Accessor& a = accessor_of(document, index);
  if (a.bufferView < 0 && a.count > most_without_data)
    document.fail(accessors, index, fmt::format("{} elements without data", a.count));
  if (a.bufferView >= 0) {  // no more than its bytes: else room would be made for what is not there
    const auto& view =
        document.element(document.model().bufferViews, a.bufferView, "bufferViews", accessors, index);
    if (a.count > view.byteLength)
      document.fail(
          accessors, index,
          fmt::format("{} elements are more than its bufferViews[{}] has bytes", a.count, a.bufferView));
    const auto& buffer =
        document.element(document.model().buffers, view.buffer, "buffers", "bufferViews", a.bufferView);
    if (a.count > buffer.data.size())
      document.fail(accessors, index,
                    fmt::format("{} elements are more than buffers[{}] has bytes", a.count, view.buffer));
  }
  return a.count;
}

int components_of(const Document& document, int index) {
  switch (accessor_of(document, index).type) {
    case TINYGLTF_TYPE_SCALAR:
      return 1;
    case TINYGLTF_TYPE_VEC2:
      return 2;
    case TINYGLTF_TYPE_VEC3:
      return 3;
    case TINYGLTF_TYPE_VEC4:
      return 4;
    case TINYGLTF_TYPE_MAT4:
      return 16;
    default:
      return 0;
  }
}

std::vector<float> read_floats(const Document& document, int index, int components) {
  const tinygltf::Accessor& a = accessor_of(document, index);
  const bool normalized = a.normalized;
  std::vector<float> values(count_of(document, index) * static_cast<std::size_t>(components));
  visit(document, index, components, [&](std::size_t element, int component, const unsigned char* from) {
    values[element * static_cast<std::size_t>(components) + static_cast<std::size_t>(component)] =
        number_at(from, a.componentType, normalized);
  });
  return values;
}

std::vector<std::uint32_t> read_integers(const Document& document, int index, int components) {
  const tinygltf::Accessor& a = accessor_of(document, index);
  if (!is_unsigned(a.componentType)) document.fail(accessors, index, "unsigned integers are meant here");
  std::vector<std::uint32_t> values(count_of(document, index) * static_cast<std::size_t>(components));
  visit(document, index, components, [&](std::size_t element, int component, const unsigned char* from) {
    values[element * static_cast<std::size_t>(components) + static_cast<std::size_t>(component)] =
        integer(from, a.componentType);
  });
  return values;
}

std::vector<std::uint32_t> read_indices(const Document& document, int index) {
  return read_integers(document, index, 1);
}

}  // namespace vitrail::gltf
