// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/gate/pbrt_grammar.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>

#include "images/image_files.h"
#include "scene/system/diagnostics.h"
#include "tests/conformance/gate/pbrt_table.h"
#include "tests/conformance/gate/pbrt_values.h"

namespace vitrail::test {

namespace {

using namespace pbrt;

struct Transforming {
  std::string_view name;
  std::size_t numbers;
  bool brackets;
};
constexpr std::array transforms{
    Transforming{"Identity", 0, false},        Transforming{"Translate", 3, false},
    Transforming{"Scale", 3, false},           Transforming{"Rotate", 4, false},
    Transforming{"LookAt", 9, false},          Transforming{"Transform", 16, true},
    Transforming{"ConcatTransform", 16, true}, Transforming{"TransformTimes", 2, false}};

class Checker {
 public:
  Checker(std::vector<Token> words, std::filesystem::path directory)
      : words_(std::move(words)), directory_(std::move(directory)) {}

  std::vector<std::string> run() {
    while (at_ < words_.size()) directive();
    if (!world_) complain(0, "the file ends before WorldBegin");
    if (!blocks_.empty()) complain(0, "a block does not end");
    for (const auto& [name, line] : used_media_)
      if (!media_.contains(name)) complain(line, fmt::format("no medium \"{}\"", name));
    for (const auto& [name, line] : used_materials_)
      if (!materials_.contains(name)) complain(line, fmt::format("no named material \"{}\"", name));
    return std::move(complaints_);
  }

 private:
  // ---- Reading
  const Token& next() {
    static const Token end{"end of file", false, 0};
    return at_ < words_.size() ? words_[at_++] : end;
  }
  std::string name(const std::string& of) {
    const Token& token = next();
    if (!token.quoted) complain(token.line, of + " needs a name in quotes");
    return token.text;
  }
  std::vector<Parameter> parameters() {
    std::vector<Parameter> list;
    while (at_ < words_.size() && words_[at_].quoted) {
      const Token& head = next();
      const std::size_t space = head.text.find(' ');
      Parameter p{head.text.substr(0, space),
                  space == std::string::npos ? "" : head.text.substr(space + 1),
                  {},
                  head.line};
      if (p.name.empty()) complain(head.line, fmt::format("\"{}\" is not a type and a name", head.text));
      if (at_ < words_.size() && words_[at_].text == "[" && !words_[at_].quoted) {
        ++at_;
        while (at_ < words_.size() && (words_[at_].quoted || words_[at_].text != "]"))
          p.values.push_back(next());
        ++at_;
      } else {
        p.values.push_back(next());
      }
      list.push_back(std::move(p));
    }
    return list;
  }
  void complain(int line, std::string what) { complaints_.push_back(fmt::format("line {}: {}", line, what)); }

  // ---- Directives
  void directive() {
    const Token word = next();
    line_ = word.line;
    const auto known = std::find_if(transforms.begin(), transforms.end(),
                                    [&](const Transforming& t) { return t.name == word.text; });
    if (known != transforms.end()) return transform(*known);
    if (word.text == "WorldBegin") return world_begin();
    if (const auto found = directives_.find(word.text); found != directives_.end() && !word.quoted)
      return found->second(*this);
    complain(word.line, fmt::format("\"{}\" is not a directive", word.text));
  }
  void transform(const Transforming& t) {
    if (t.brackets && next().text != "[") complain(line_, "a matrix needs brackets");
    for (std::size_t i = 0; i < t.numbers; ++i) {
      const auto value = number_of(next());
      if (!value || !std::isfinite(*value)) complain(line_, fmt::format("{} needs finite numbers", t.name));
    }
    if (t.brackets && next().text != "]") complain(line_, "a matrix needs brackets");
  }
  void active_transform() {
    const Token& which = next();
    if (which.quoted || (which.text != "All" && which.text != "StartTime" && which.text != "EndTime"))
      complain(which.line, "ActiveTransform is of All, StartTime or EndTime");
  }
  void world_begin() {
    if (world_) complain(line_, "a second WorldBegin");
    world_ = true;
  }
  void require_world(bool inside, const char* what) {
    if (world_ != inside)
      complain(line_, fmt::format("{} is {} the world", what, inside ? "outside of" : "inside of"));
  }
  void begin(char block) {
    require_world(true, "a block");
    if (block == 'o' && in_object()) complain(line_, "an object in an object");
    blocks_.push_back(block);
    saved_.push_back({area_light_, material_});
  }
  void end(char block) {
    if (blocks_.empty() || blocks_.back() != block) return complain(line_, "blocks do not nest");
    blocks_.pop_back();
    area_light_ = saved_.back().area_light;
    material_ = saved_.back().material;
    saved_.pop_back();
  }
  bool in_object() const { return std::find(blocks_.begin(), blocks_.end(), 'o') != blocks_.end(); }

  void define(std::set<std::string>& names, const std::string& name, const char* what) {
    if (!names.insert(name).second) complain(line_, fmt::format("{} \"{}\" is defined twice", what, name));
  }

  // Of the kind that the table knows.
  void check(std::string_view directive, const std::string& kind, const std::vector<Parameter>& list) {
    const auto known = std::find_if(kinds().begin(), kinds().end(), [&](const Kind& k) {
      return k.directive == directive && k.kind == kind;
    });
    if (known == kinds().end()) return complain(line_, fmt::format("no {} \"{}\"", directive, kind));
    std::set<std::string> seen;
    for (const Parameter& p : list) {
      const auto about = [&](std::string_view what) {
        complain(p.line, fmt::format("{} \"{}\": \"{} {}\" {}", directive, kind, p.type, p.name, what));
      };
      if (p.name == "type" && directive.starts_with("Make")) continue;
      if (p.name == "type" && directive == "Material") continue;
      if (!seen.insert(p.name).second) about("is given twice");
      const std::string_view type = type_of(known->parameters, p.name);
      if (type.empty()) {
        about("is not a parameter of it");
        continue;
      }
      if (const std::string wrong = wrong_value(p, type); !wrong.empty()) {
        about(wrong);
        continue;
      }
      if (p.type == "texture") {
        const auto& textures = type.front() == 'f' ? float_textures_ : spectrum_textures_;
        if (!textures.contains(p.values.front().text))
          about(fmt::format("names no texture of {} before it", type.front() == 'f' ? "numbers" : "colours"));
      }
    }
  }
  static const Parameter* find(const std::vector<Parameter>& list, std::string_view name) {
    for (const Parameter& p : list)
      if (p.name == name && !p.values.empty()) return &p;
    return nullptr;
  }
  static bool has(const std::vector<Parameter>& list, std::string_view name) { return find(list, name); }

  void option(const char* directive) {
    require_world(false, directive);
    const std::string kind = name(directive);
    check(directive, kind, parameters());
  }
  void medium() {
    const std::string medium = name("MakeNamedMedium");
    define(media_, medium, "medium");
    const std::vector<Parameter> list = parameters();
    const Parameter* type = find(list, "type");
    if (!type) return complain(line_, "a medium without a type");
    const std::string& kind = type->values.front().text;
    check("MakeNamedMedium", kind, list);
    const auto count = [&](const char* of) { return has(list, of) ? find(list, of)->values.size() : 0; };
    const auto size = [&](const char* of) {
      return has(list, of) ? static_cast<std::size_t>(number_of(find(list, of)->values.front()).value_or(0))
                           : 1;
    };
    const std::size_t cells = size("nx") * size("ny") * size("nz");
    if (kind == "uniformgrid") {
      for (const char* grid : {"density", "temperature", "Lescale"})
        if (has(list, grid) && count(grid) != cells)
          complain(line_, fmt::format("{} has {} values for {} cells", grid, count(grid), cells));
      if (!has(list, "density")) complain(line_, "a grid without a density");
      if (has(list, "Le") && has(list, "temperature")) complain(line_, "both Le and temperature");
    }
    if (kind == "rgbgrid") {
      for (const char* grid : {"sigma_a", "sigma_s", "Le"})
        if (has(list, grid) && count(grid) != 3 * cells)
          complain(line_, fmt::format("{} has {} numbers for {} cells", grid, count(grid), cells));
      if (has(list, "Le") && !has(list, "sigma_a")) complain(line_, "Le without sigma_a");
    }
  }
  void texture() {
    require_world(true, "Texture");
    const std::string texture = name("Texture"), type = name("Texture"), kind = name("Texture");
    const std::vector<Parameter> list = parameters();
    const bool is_float = type == "float";
    if (!is_float && type != "spectrum")
      return complain(line_, fmt::format("no texture of type \"{}\"", type));
    check(is_float ? "float Texture" : "spectrum Texture", kind, list);
    define(is_float ? float_textures_ : spectrum_textures_, texture, "texture");
    if (const Parameter* wrap = find(list, "wrap"))
      require_word(*wrap, {"repeat", "black", "clamp", "octahedralsphere"});
    if (const Parameter* filter = find(list, "filter"))
      require_word(*filter, {"point", "bilinear", "trilinear", "ewa", "EWA"});
    if (const Parameter* mapping = find(list, "mapping"))
      require_word(*mapping, {"uv", "spherical", "cylindrical", "planar"});
  }
  void require_word(const Parameter& p, std::initializer_list<std::string_view> words) {
    if (std::find(words.begin(), words.end(), p.values.front().text) == words.end())
      complain(p.line, fmt::format("\"{}\" is no {}", p.values.front().text, p.name));
  }
  void named_material() {
    const std::string material = name("MakeNamedMaterial");
    const std::vector<Parameter> list = parameters();
    const Parameter* type = find(list, "type");
    if (!type) return complain(line_, "a named material without a type");
    material_kind(type->values.front().text, list);
    if (materials_.contains(material))
      complain(line_, fmt::format("material \"{}\" is defined twice", material));
    materials_[material] = type->values.front().text;
  }
  void material_kind(const std::string& kind, const std::vector<Parameter>& list) {
    require_world(true, "a material");
    check("Material", kind, list);
    if (has(list, "reflectance") && (has(list, "eta") || has(list, "k")) && kind == "conductor")
      complain(line_, "a conductor with reflectance and eta or k");
    if (has(list, "reflectance") && (has(list, "conductor.eta") || has(list, "conductor.k")))
      complain(line_, "a coated conductor with reflectance and eta or k");
    if (kind == "subsurface" && has(list, "sigma_a") != has(list, "sigma_s"))
      complain(line_, "a subsurface material with one of sigma_a and sigma_s");
    if (kind != "mix") return;
    const Parameter* both = find(list, "materials");
    if (!both) return complain(line_, "a mix without materials");
    for (const Token& of : both->values) {
      if (!materials_.contains(of.text))
        complain(of.line, fmt::format("a mix of \"{}\", which is not defined before it", of.text));
      else if (materials_[of.text] == "interface")
        complain(of.line, "a mix with an interface");
    }
  }
  void light() {
    require_world(true, "LightSource");
    const std::string kind = name("LightSource");
    const std::vector<Parameter> list = parameters();
    check("LightSource", kind, list);
    if (has(list, "L") && has(list, "filename")) complain(line_, "a light with both L and filename");
    if (has(list, "portal") && !has(list, "filename")) complain(line_, "a portal without an image");
    if (kind == "projection" && !has(list, "filename")) complain(line_, "a projection without an image");
    if (const Parameter* file = find(list, "filename"))
      require_image(*file, kind != "goniometric", kind != "projection");
  }
  // Of an image that is there.
  void require_image(const Parameter& file, bool color, bool square) {
    try {
      const ImageLayout layout = read_image_layout(directory_ / file.values.front().text);
      if (color && layout.channels != 3) complain(file.line, "an image of a light without R, G and B");
      if (square && layout.width != layout.height)
        complain(file.line, "an equal-area map that is not square");
    } catch (const Error&) {
    }
  }
  void area_light() {
    require_world(true, "AreaLightSource");
    const std::string kind = name("AreaLightSource");
    const std::vector<Parameter> list = parameters();
    check("AreaLightSource", kind, list);
    if (has(list, "L") && has(list, "filename")) complain(line_, "an area light with both L and filename");
    if (const Parameter* file = find(list, "filename")) require_image(*file, true, false);
    area_light_ = true;
  }
  void shape() {
    require_world(true, "Shape");
    const std::string kind = name("Shape");
    const std::vector<Parameter> list = parameters();
    check("Shape", kind, list);
    if (area_light_ && in_object()) complain(line_, "pbrt leaves out area lights in objects");
    if (area_light_ && materials_[material_] == "interface")
      complain(line_, "pbrt leaves out area lights on interfaces");
    if (kind != "trianglemesh") return;
    const auto count = [&](const char* of) { return has(list, of) ? find(list, of)->values.size() : 0; };
    if (count("indices") % 3 != 0) complain(line_, "indices that are not of triangles");
    if (has(list, "N") && count("N") != count("P"))
      complain(line_, "another number of normals than of points");
    if (has(list, "uv") && 3 * count("uv") != 2 * count("P"))
      complain(line_, "another number of uvs than of points");
  }
  void use_material() {
    material_ = name("NamedMaterial");
    used_materials_.emplace(material_, line_);
  }
  void interface() {
    for (int i = 0; i < 2; ++i)
      if (const std::string medium = name("MediumInterface"); !medium.empty())
        used_media_.emplace(medium, line_);
  }
  void object_begin() {
    begin('o');
    define(objects_, name("ObjectBegin"), "object");
  }
  void object_instance() {
    require_world(true, "ObjectInstance");
    if (in_object()) complain(line_, "an instance in an object");
    if (const std::string object = name("ObjectInstance"); !objects_.contains(object))
      complain(line_, fmt::format("no object \"{}\"", object));
  }
  // What is in the file stands here.
  void include() {
    const std::filesystem::path file = directory_ / name("Include");
    std::ifstream in(file, std::ios::binary);
    if (!in) return complain(line_, fmt::format("cannot open {}", file.string()));
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::vector<Token> words = tokens(text);
    words_.insert(words_.begin() + static_cast<std::ptrdiff_t>(at_), words.begin(), words.end());
  }
  void reverse() { require_world(true, "ReverseOrientation"); }

  static const std::map<std::string, std::function<void(Checker&)>, std::less<>> directives_;

  std::vector<Token> words_;
  std::filesystem::path directory_;
  std::size_t at_ = 0;
  int line_ = 0;
  bool world_ = false, area_light_ = false;
  std::string material_;
  std::vector<char> blocks_;
  struct State {
    bool area_light;
    std::string material;
  };
  std::vector<State> saved_;
  std::set<std::string> media_, float_textures_, spectrum_textures_, objects_;
  std::map<std::string, std::string> materials_;            // the kind of each
  std::map<std::string, int> used_media_, used_materials_;  // the line of each
  std::vector<std::string> complaints_;
};

const std::map<std::string, std::function<void(Checker&)>, std::less<>> Checker::directives_{
    {"Camera", [](Checker& c) { c.option("Camera"); }},
    {"Film", [](Checker& c) { c.option("Film"); }},
    {"PixelFilter", [](Checker& c) { c.option("PixelFilter"); }},
    {"Sampler", [](Checker& c) { c.option("Sampler"); }},
    {"Integrator", [](Checker& c) { c.option("Integrator"); }},
    {"MakeNamedMedium", &Checker::medium},
    {"MediumInterface", &Checker::interface},
    {"ActiveTransform", &Checker::active_transform},
    {"Texture", &Checker::texture},
    {"MakeNamedMaterial", &Checker::named_material},
    {"NamedMaterial", &Checker::use_material},
    {"LightSource", &Checker::light},
    {"AreaLightSource", &Checker::area_light},
    {"Shape", &Checker::shape},
    {"Include", &Checker::include},
    {"ReverseOrientation", &Checker::reverse},
    {"AttributeBegin", [](Checker& c) { c.begin('a'); }},
    {"AttributeEnd", [](Checker& c) { c.end('a'); }},
    {"ObjectBegin", &Checker::object_begin},
    {"ObjectEnd", [](Checker& c) { c.end('o'); }},
    {"ObjectInstance", &Checker::object_instance}};

}  // namespace

std::vector<std::string> pbrt_complaints(const std::string& text, const std::filesystem::path& directory) {
  try {
    return Checker(tokens(text), directory).run();
  } catch (const std::runtime_error& error) {
    return {error.what()};
  }
}

std::vector<std::string> pbrt_complaints(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  return pbrt_complaints(text, file.parent_path());
}

}  // namespace vitrail::test
