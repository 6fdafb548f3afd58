// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/read/properties.h"

#include <fmt/format.h>

#include <filesystem>

#include "importers/reading/missing_files.h"

namespace vitrail::mitsuba {

namespace {

namespace fs = std::filesystem;

fs::path folder_of(const Builder& builder, std::uint32_t file) {
  const auto& files = builder.scene.files;
  return file < files.size() ? fs::path(files[file]).parent_path() : fs::path();
}

}  // namespace

Origin place_of(const Object& object, std::string_view name) {
  for (const Property& property : object.properties)
    if (property.name == name) return property.origin;
  return object.origin;
}

std::string existing_file(const Builder& builder, const Object& object, std::string_view name) {
  std::string text = object.text(name, "", builder.report);
  const Origin place = place_of(object, name);
  if (text.empty())
    builder.report.fail(fmt::format("{} \"{}\" needs a \"{}\"", object.tag, object.type, name), place);
  const std::uint32_t main_file = 0;
  for (const std::uint32_t file : {main_file, place.file}) {
    const fs::path path = folder_of(builder, file) / text;
    std::error_code error;
    if (fs::is_regular_file(path, error)) return fs::absolute(path, error).lexically_normal().string();
  }
  if (builder.replace_missing) return text;
  builder.report.fail(fmt::format("cannot find the file {}{}", text, how_to_replace_missing), place);
}

const Object* object_of(const Object& object, std::string_view name) {
  const Property* property = object.find(name);
  const ObjectPtr* nested = property ? std::get_if<ObjectPtr>(&property->value) : nullptr;
  return nested ? nested->get() : nullptr;
}

}  // namespace vitrail::mitsuba
