// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "glazing/energyplus.h"
#include "glazing/product_formats.h"
#include "glazing/text_file.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

// An object as it stands: its fields in order, the type first.
struct Statement {
  std::vector<std::string> fields;
  int line = 0;
};

struct Statements {
  std::vector<Statement> all;
  int includes = 0;  // EP-Macro's "##include FILE": what it names is not in this text
};

// "Type, field, field; ! comment", over as many lines as it likes.
Statements statements(const std::string& text, const std::string& file) {
  Statements result;
  Statement now;
  Lines lines(text);
  for (std::string_view line; lines.next(line);) {
    line = line.substr(0, line.find('!'));
    if (trimmed(line).starts_with("##include")) {
      ++result.includes;
      continue;
    }
    for (std::size_t end; (end = line.find_first_of(",;")) != line.npos; line.remove_prefix(end + 1)) {
      if (now.fields.empty()) now.line = lines.number();
      now.fields.emplace_back(trimmed(line.substr(0, end)));
      if (line[end] != ';') continue;
      result.all.push_back(std::move(now));
      now = {};
    }
    if (!trimmed(line).empty())
      throw Error("a field of an IDF has to end with a comma or a semicolon", {file, lines.number(), 0},
                  std::string(trimmed(line).substr(0, 80)));
  }
  if (!now.fields.empty()) throw Error("the last object of an IDF has no semicolon", {file, now.line, 0});
  return result;
}

// Groups of `width` fields from `first` on; an incomplete last one is kept for the reader to refuse.
void take_groups(const Statement& statement, std::size_t first, std::size_t width, EnergyPlusObject& object) {
  const auto& fields = statement.fields;
  std::size_t end = fields.size();
  while (end > first && fields[end - 1].empty()) --end;
  for (std::size_t i = first; i < end; i += width)
    object.rows.emplace_back(fields.begin() + static_cast<std::ptrdiff_t>(i),
                             fields.begin() + static_cast<std::ptrdiff_t>(std::min(i + width, end)));
}

}  // namespace

bool is_idf(std::string_view text) {
  const std::string all = lower(text);
  return all.find(glazing_type) != all.npos;
}

std::vector<Product> idf_products(const std::string& text, const std::string& file) {
  std::vector<EnergyPlusObject> objects;
  const Statements read = statements(text, file);
  for (const Statement& statement : read.all) {
    EnergyPlusObject object{.type = lower(statement.fields[0]), .line = statement.line};
    if (statement.fields.size() > 1) object.name = statement.fields[1];
    if (object.type == glazing_type)
      for (std::size_t i = 0; i < glazing_fields.size() && i + 2 < statement.fields.size(); ++i)
        object.fields[glazing_fields[i]] = statement.fields[i + 2];
    else if (object.type == spectral_data_type)
      take_groups(statement, 2, 4, object);
    else if (object.type == thermochromic_type)
      take_groups(statement, 2, 2, object);
    else
      continue;
    objects.push_back(std::move(object));
  }
  std::vector<Product> products = energyplus_products(objects, file);
  if (read.includes > 0)
    for (Product& product : products)
      product.notes.push_back(fmt::format("{} lines of ##include are passed over", read.includes));
  return products;
}

}  // namespace vitrail
