// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "glazing/foreign_file.h"
#include "glazing/json_node.h"
#include "glazing/product_formats.h"
#include "glazing/text_file.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

std::vector<Product> products_of(const std::string& text, const std::string& file) {
  if (const std::string kind = foreign_kind(text, file); !kind.empty())
    throw Error(
        fmt::format("this is {}: glazing is read from WINDOW, the IGSDB, EnergyPlus and tables", kind),
        {file});
  if (is_optics(text)) return optics_products(text, file);
  const std::string_view start = trimmed(text);
  if (start.starts_with("{") || start.starts_with("[")) {
    const JsonNode root = JsonNode::parse(text, file);
    return is_igsdb(root) ? igsdb_products(root) : epjson_products(root, file);
  }
  if (is_idf(text)) return idf_products(text, file);
  return table_products(text, file);
}

std::string names_of(const std::vector<Product>& products) {
  std::string names;
  for (std::size_t i = 0; i < products.size() && i < 20; ++i)
    names += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", products[i].name);
  return products.size() > 20 ? names + ", …" : names;
}

Product readable(Product product) {
  if (product.refused) throw *product.refused;
  return product;
}

}  // namespace

OpticalRows checked_rows(OpticalRows rows, std::vector<std::string>& notes, const std::string& file,
                         const std::string& where) {
  for (const OpticalRow& row : rows) {
    if (!(row.nm > 0)) throw Error(where + "a wavelength has to be above 0", {file});
    // Noise leaves [0, 1] by a little, and reflectances are at times nonsense where all is absorbed.
    const auto is_fraction = [](double v) { return v > -0.5 && v < 2; };
    if (!is_fraction(row.at.t) || !is_fraction(row.at.rf) || !is_fraction(row.at.rb))
      throw Error(fmt::format("{}at {} nm T, Rf, Rb are {}, {}, {}, and have to be fractions from 0 to 1",
                              where, row.nm, row.at.t, row.at.rf, row.at.rb),
                  {file});
  }
  return tidy(std::move(rows), notes);
}

void take_scattering(Product& product, const std::vector<ScatteringRow>& rows, const std::string& file) {
  OpticalRows sums, scattered;
  double one_sided = 0;
  for (const ScatteringRow& row : rows) {
    const PaneValues &a = row.direct, &b = row.scattered;
    sums.push_back({row.nm, {a.t + b.t, a.rf + b.rf, a.rb + b.rb}});
    scattered.push_back({row.nm, b});
    one_sided = std::max(one_sided, std::abs(a.t + b.t - row.direct_tb - row.scattered_tb));
  }
  product.rows = checked_rows(std::move(sums), product.notes, file, "");
  std::vector<std::string> told_of_the_sums;
  product.scattered = checked_rows(std::move(scattered), told_of_the_sums, file, "scattered, ");
  for (std::size_t i = 0; i < product.rows.size(); ++i) {
    const PaneValues& whole = product.rows[i].at;
    PaneValues& part = product.scattered[i].at;
    part = {std::min(part.t, whole.t), std::min(part.rf, whole.rf), std::min(part.rb, whole.rb)};
  }
  product.kind = PaneKind::coated;
  // Light that scatters may pass more easily from one side; a system's T is the same from both.
  constexpr double rounding = 0.005;
  if (one_sided > rounding)
    product.notes.push_back(fmt::format(
        "T from the back differs by up to {:.3f}; that from the front counts for both sides", one_sided));
}

std::vector<Product> read_products(const std::filesystem::path& file) {
  const std::string name = file.string();
  std::vector<Product> products = products_of(read_text(file), name);
  if (products.empty()) throw Error("there is no glazing in it", {name});
  if (std::ranges::all_of(products, [](const Product& p) { return p.refused.has_value(); }))
    throw *products.front().refused;
  for (Product& product : products)
    if (product.name.empty()) product.name = file.stem().string();
  return products;
}

Product read_product(const std::filesystem::path& file, const std::string& name) {
  std::vector<Product> products = read_products(file);
  if (name.empty()) {
    if (products.size() == 1) return readable(std::move(products.front()));
    throw Error(fmt::format("has {} products; say which as \"{}#NAME\": {}", products.size(), file.string(),
                            names_of(products)),
                {file.string()});
  }
  for (Product& product : products)
    if (same_word(product.name, name)) return readable(std::move(product));
  throw Error(fmt::format("has no product \"{}\", but {}", name, names_of(products)), {file.string()});
}

Product read_named_product(const std::string& text) {
  std::error_code ignored;
  const std::size_t hash = text.rfind('#');
  if (hash == text.npos || std::filesystem::exists(text, ignored)) return read_product(text);
  return read_product(text.substr(0, hash), text.substr(hash + 1));
}

}  // namespace vitrail
