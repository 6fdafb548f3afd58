// SPDX-License-Identifier: Apache-2.0
#include "glazing/system_file.h"

#include <fmt/format.h>

#include <filesystem>

#include "glazing/json_node.h"
#include "glazing/product.h"
#include "glazing/text_file.h"
#include "scene/diagnostics.h"

namespace vitrail {

namespace {

namespace fs = std::filesystem;

class Reader {
 public:
  explicit Reader(ReadSystem& into) : into_(into) {}

  void add(const std::string& file) {
    if (const auto root = system_root(file))
      add_system(*root, fs::path(file).parent_path());
    else
      add_pane(file, 0);
  }

 private:
  // Of a JSON file with "layers".
  static std::optional<JsonNode> system_root(const std::string& file) {
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) return {};
    const std::string text = read_text(file);
    if (!trimmed(text).starts_with("{") || text.find("\"layers\"") == text.npos) return {};
    const JsonNode root = JsonNode::parse(text, file);
    if (!root.find("layers")) return {};
    return root;
  }

  void add_system(const JsonNode& root, const fs::path& folder) {
    root.only({"name", "layers"});
    if (into_.system.name.empty()) into_.system.name = root.text_or("name", "");
    const JsonNode layers = root.at("layers");
    bool any = false;
    for (const JsonNode& layer : layers.items()) {
      if (layer.find("gap_mm")) {
        add_gap(layer, any);
        continue;
      }
      any = true;
      if (layer.find("stack"))
        add_stack(layer, folder);
      else
        add_pane_of(layer, folder);
    }
    if (!any) layers.fail("needs a pane");
  }

  void add_gap(const JsonNode& layer, bool behind_pane) {
    layer.only({"gap_mm", "gas"});
    const double mm = layer.at("gap_mm").number();
    if (!(mm > 0)) layer.fail("a gap is wider than 0");
    if (!behind_pane) layer.fail("a gap lies between two panes");
    into_.system.layers.back().gap_behind_mm = mm;
  }

  void add_pane_of(const JsonNode& layer, const fs::path& folder) {
    layer.only({"pane", "product", "flipped", "thickness_mm"});
    std::string file = (folder / layer.at("pane").text()).string();
    if (const auto product = layer.find("product")) file = fmt::format("{}#{}", file, product->text());
    add_pane(file, positive_or_0(layer, "thickness_mm"));
    if (const auto flipped = layer.find("flipped")) into_.system.layers.back().flipped = flipped->boolean();
  }

  static double positive_or_0(const JsonNode& json, const char* key) {
    const auto value = json.find(key);
    if (!value) return 0;
    if (!(value->number() > 0)) value->fail("has to be above 0");
    return value->number();
  }

  Product product(const std::string& file) {
    Product result = read_named_product(file);
    for (const std::string& note : result.notes) into_.notes.push_back(fmt::format("{}: {}", file, note));
    return result;
  }

  void add_pane(const std::string& file, double thickness_mm) {
    const Product found = product(file);
    into_.system.layers.push_back({found.name, pane_of(found, thickness_mm)});
  }

  void add_stack(const JsonNode& layer, const fs::path& folder) {
    layer.only({"stack", "flipped", "name"});
    const JsonNode list = layer.at("stack");
    StackPane stack;
    stack.films.emplace_back();
    for (const JsonNode& part : list.items()) {
      part.only({"index", "pane", "thickness_mm", "thickness_nm"});
      const double nm = positive_or_0(part, "thickness_nm"), mm = positive_or_0(part, "thickness_mm");
      if (nm > 0) {
        stack.films.back().push_back({index_of(part, folder), nm});
      } else {
        stack.slabs.push_back(part.find("pane") ? slab_of_glass(part, folder)
                                                : Slab{index_of(part, folder), mm});
        if (!(stack.slabs.back().thickness_mm > 0))
          part.fail("needs \"thickness_mm\", or \"thickness_nm\" of a film");
        stack.films.emplace_back();
      }
    }
    if (stack.slabs.empty()) list.fail("needs a sheet: something with \"thickness_mm\"");
    GlazingLayer made{layer.text_or("name", "stack"), std::move(stack)};
    if (const auto flipped = layer.find("flipped")) made.flipped = flipped->boolean();
    into_.system.layers.push_back(std::move(made));
  }

  IndexRows index_of(const JsonNode& part, const fs::path& folder) {
    const JsonNode index = part.at("index");
    if (!index.is_text()) {  // a transparent medium: n alone
      if (!(index.number() > 0)) index.fail("an index of refraction is above 0");
      return {{550, index.number(), 0}};
    }
    Product found = product((folder / index.text()).string());
    if (found.index.empty()) index.fail("has to name a table of n and k");
    return std::move(found.index);
  }

  // Clear glass by its measured T and R, to be laminated or coated.
  Slab slab_of_glass(const JsonNode& part, const fs::path& folder) {
    const JsonNode pane = part.at("pane");
    const Product found = product((folder / pane.text()).string());
    if (found.kind != PaneKind::clear || found.rows.empty())
      pane.fail("only clear glass can be part of a stack; this is coated, or its kind is unknown");
    const double mm =
        positive_or_0(part, "thickness_mm") > 0 ? positive_or_0(part, "thickness_mm") : found.thickness_mm;
    if (!(found.thickness_mm > 0)) pane.fail("does not say how thick it was when it was measured");
    Slab slab{{}, mm};
    for (const OpticalRow& row : found.rows)
      slab.index.push_back(
          clear_glass_index(row.nm, row.at.t, (row.at.rf + row.at.rb) / 2, found.thickness_mm));
    return slab;
  }

  ReadSystem& into_;
};

}  // namespace

ReadSystem read_system(const std::vector<std::string>& files) {
  ReadSystem result;
  Reader reader(result);
  for (const std::string& file : files) reader.add(file);
  if (result.system.layers.empty()) throw Error("a glazing needs a pane");
  return result;
}

}  // namespace vitrail
