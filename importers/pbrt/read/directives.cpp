// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/read/directives.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "scene/records/nesting_limits.h"

namespace vitrail::pbrt {

const std::map<std::string, Interpreter::Handler, std::less<>>& Interpreter::handlers() {
  static const std::map<std::string, Handler, std::less<>> table{
      {"Accelerator", &Interpreter::accelerator},
      {"ActiveTransform", &Interpreter::active_transform},
      {"AreaLightSource", &Interpreter::area_light_source},
      {"Attribute", &Interpreter::attribute},
      {"AttributeBegin", &Interpreter::attribute_begin},
      {"AttributeEnd", &Interpreter::attribute_end},
      {"Camera", &Interpreter::camera},
      {"ColorSpace", &Interpreter::color_space},
      {"ConcatTransform", &Interpreter::concat_transform},
      {"CoordSysTransform", &Interpreter::coord_sys_transform},
      {"CoordinateSystem", &Interpreter::coordinate_system},
      {"Film", &Interpreter::film},
      {"Identity", &Interpreter::identity},
      {"Import", &Interpreter::import},
      {"Include", &Interpreter::include},
      {"Integrator", &Interpreter::integrator},
      {"LightSource", &Interpreter::light_source},
      {"LookAt", &Interpreter::look_at},
      {"MakeNamedMaterial", &Interpreter::make_named_material},
      {"MakeNamedMedium", &Interpreter::make_named_medium},
      {"Material", &Interpreter::material},
      {"MediumInterface", &Interpreter::medium_interface},
      {"NamedMaterial", &Interpreter::named_material},
      {"ObjectBegin", &Interpreter::object_begin},
      {"ObjectEnd", &Interpreter::object_end},
      {"ObjectInstance", &Interpreter::object_instance},
      {"Option", &Interpreter::option},
      {"PixelFilter", &Interpreter::pixel_filter},
      {"ReverseOrientation", &Interpreter::reverse_orientation},
      {"Rotate", &Interpreter::rotate},
      {"Sampler", &Interpreter::sampler},
      {"Scale", &Interpreter::scale},
      {"Shape", &Interpreter::shape},
      {"SurfaceIntegrator", &Interpreter::integrator},
      {"Texture", &Interpreter::texture},
      {"Transform", &Interpreter::transform},
      {"TransformBegin", &Interpreter::transform_begin},
      {"TransformEnd", &Interpreter::transform_end},
      {"TransformTimes", &Interpreter::transform_times},
      {"Translate", &Interpreter::translate},
      {"WorldBegin", &Interpreter::world_begin},
      {"WorldEnd", &Interpreter::world_end}};
  return table;
}

// What a directive makes a record of.
static RecordKind kind_of_record(std::string_view directive) {
  static const std::map<std::string_view, RecordKind> kinds{{"AreaLightSource", RecordKind::area_light},
                                                            {"Camera", RecordKind::camera},
                                                            {"Film", RecordKind::film},
                                                            {"Integrator", RecordKind::integrator},
                                                            {"LightSource", RecordKind::light},
                                                            {"MakeNamedMaterial", RecordKind::material},
                                                            {"MakeNamedMedium", RecordKind::medium},
                                                            {"Material", RecordKind::material},
                                                            {"ObjectBegin", RecordKind::object},
                                                            {"ObjectInstance", RecordKind::instance},
                                                            {"Sampler", RecordKind::sampler},
                                                            {"Shape", RecordKind::shape},
                                                            {"SurfaceIntegrator", RecordKind::integrator},
                                                            {"Texture", RecordKind::texture}};
  const auto found = kinds.find(directive);
  return found == kinds.end() ? RecordKind::any : found->second;
}

Interpreter::Interpreter(TokenStream& tokens, Context& context)
    : tokens_(tokens),
      context_(context),
      view_(default_view(context.version)),
      shapes_(context, scene_.meshes),
      quadric_runs_(context.mesh_memory.limit_bytes() / 4) {
  context_.upcoming = [this](std::size_t bytes) { return tokens_.upcoming(bytes); };
}

Scene Interpreter::run() {
  for (Token token = tokens_.next(); token.kind != TokenKind::end; token = tokens_.next()) {
    if (world_ == World::ended) {
      context_.report.dropped("what follows WorldEnd is another scene and is not read", token.place);
      break;
    }
    execute(token);
    tokens_.release();
    if (context_.progress) context_.progress(tokens_.fraction_read());
  }
  check_blocks_are_closed();
  context_.report.begin_item({});
  if (world_ == World::inside && context_.version == Version::v3)
    context_.report.approximated("there is no WorldEnd: the file may be incomplete", world_place_);
  resolve_materials();
  resolve_media();
  drop_lights_of_interfaces();
  resolve_instances();
  apply(view_, scene_);
  report_integrator();
  return std::move(scene_);
}

Origin Interpreter::origin(const Place& place) {
  const auto [number, is_new] =
      file_numbers_.try_emplace(place.file, static_cast<std::uint32_t>(scene_.files.size()));
  if (is_new) scene_.files.push_back(*place.file);
  return {number->second, static_cast<std::uint32_t>(place.line), static_cast<std::uint32_t>(place.column)};
}

void Interpreter::execute(const Token& directive) {
  context_.report.begin_item(directive.place, kind_of_record(directive.text));
  if (directive.kind == TokenKind::end_of_import) return end_import(directive.place);
  const auto handler = handlers().find(directive.text);
  if (directive.kind == TokenKind::word && handler != handlers().end())
    return (this->*handler->second)(directive.place);
  if (directive.kind != TokenKind::word)
    fail(fmt::format("expected a directive, found {}", describe(directive)), directive.place);
  std::vector<std::string> known;
  for (const auto& entry : handlers()) known.push_back(entry.first);
  const std::string closest = closest_word(std::string(directive.text), known);
  fail(fmt::format("unknown directive {}{}", describe(directive),
                   closest.empty() ? "" : fmt::format("; did you mean {}?", closest)),
       directive.place);
}

// ---- Reading arguments --------------------------------------------------------------------------

std::string Interpreter::read_text(const char* what) {
  const Token token = tokens_.next();
  if (token.kind != TokenKind::text)
    fail(fmt::format("expected {} in quotes, found {}", what, describe(token)), token.place);
  return std::string(token.text);
}

// `count` numbers, in brackets or bare.
std::vector<double> Interpreter::read_numbers(std::size_t count, const Place& directive) {
  std::vector<double> numbers;
  double number = 0;
  const auto read = [&] {
    while (numbers.size() < count && tokens_.next_number(number)) numbers.push_back(number);
  };
  read();
  const bool bracket = numbers.empty();
  Token token{TokenKind::close, {}, directive};
  if (bracket) {
    token = tokens_.next();
    if (token.kind == TokenKind::open) {
      read();
      if (numbers.size() == count) token = tokens_.next();
    }
  }
  if (numbers.size() < count) {
    if (!bracket || token.kind == TokenKind::open) token = tokens_.next();
    fail(fmt::format("expected {} numbers, found {} and then {}", count, numbers.size(), describe(token)),
         token.place);
  }
  if (token.kind != TokenKind::close)
    fail(fmt::format("expected ']' after {} numbers, found {}", count, describe(token)), token.place);
  return numbers;
}

ParameterSet Interpreter::read_set(const std::string& directive, const std::string& kind, const Place& place,
                                   const char* defaults) {
  const std::vector<Parameter>* known = nullptr;
  if (defaults && state_.defaults)
    if (const auto found = state_.defaults->find(defaults); found != state_.defaults->end())
      known = &found->second;
  return {fmt::format("{} \"{}\"", directive, kind), place, read_parameters(tokens_, context_.report), known};
}

// ---- Blocks -------------------------------------------------------------------------------------

void Interpreter::open(Block block, const Place& place) {
  if (saved_.size() >= most_open_blocks) fail("blocks are nested too deeply", place);
  saved_.push_back({block, place, state_, {}});
}

GraphicsState Interpreter::close(Block block, const char* directive, const char* opener, const Place& place) {
  if (saved_.empty() || saved_.back().block != block)
    fail(fmt::format("{} without {}{}", directive, opener,
                     saved_.empty() ? ""
                                    : fmt::format(" in the block that begins at {}",
                                                  to_string(location(saved_.back().place)))),
         place);
  Saved saved = std::move(saved_.back());
  saved_.pop_back();
  // v3's TransformEnd leaves all but the transform as it is.
  if (block != Block::transform) {
    if (!saved.undo.empty()) resolve_deferred(false);
    for (; !saved.undo.empty(); saved.undo.pop_back()) saved.undo.back()();
  } else if (!saved_.empty()) {
    std::ranges::move(saved.undo, std::back_inserter(saved_.back().undo));
  }
  return std::move(saved.state);
}

void Interpreter::attribute_begin(const Place& place) { open(Block::attribute, place); }

void Interpreter::attribute_end(const Place& place) {
  state_ = close(Block::attribute, "AttributeEnd", "AttributeBegin", place);
}

void Interpreter::transform_begin(const Place& place) { open(Block::transform, place); }

// v3 restores the transform only.
void Interpreter::transform_end(const Place& place) {
  GraphicsState before = close(Block::transform, "TransformEnd", "TransformBegin", place);
  if (context_.version == Version::v4)
    state_ = std::move(before);
  else
    state_.ctm = before.ctm, state_.ctm_end = before.ctm_end;
}

void Interpreter::object_begin(const Place& place) {
  const std::string name = read_text("the name of an object");
  if (current_object_) fail("ObjectBegin inside of another object", place);
  open(Block::object, place);
  const auto next = static_cast<std::uint32_t>(scene_.prototypes.size());
  const auto [slot, redefined] = object_names_.define(name, place, next);
  if (slot == next) scene_.prototypes.push_back({});
  scene_.prototypes[slot].name = name;
  scene_.prototypes[slot].origin = origin(place);
  if (redefined)
    context_.report.approximated(
        fmt::format("object \"{}\" is defined again, for the instances after it", name), place);
  current_object_ = slot;
}

void Interpreter::object_end(const Place& place) {
  state_ = close(Block::object, "ObjectEnd", "ObjectBegin", place);
  current_object_.reset();
}

void Interpreter::world_begin(const Place& place) {
  if (world_ != World::before) fail("WorldBegin comes a second time", place);
  world_ = World::inside;
  world_place_ = place;
  state_.ctm = state_.ctm_end = {};
  state_.transform_start = state_.transform_end = true;
  coordinate_systems_["world"] = {};
}

void Interpreter::world_end(const Place& place) {
  if (world_ != World::inside) fail("WorldEnd without WorldBegin", place);
  if (context_.version == Version::v4)
    context_.report.approximated("WorldEnd is pbrt-v3's, but the file is read as v4 by an earlier word",
                                 place);
  if (!saved_.empty() && saved_.back().block != Block::import) {
    context_.report.approximated("a block is not closed before WorldEnd", saved_.back().place);
    saved_.clear();
  }
  world_ = World::ended;
}

void Interpreter::check_blocks_are_closed() {
  if (world_ == World::ended || saved_.empty()) return;
  fail("the file ends before this block is closed", saved_.back().place);
}

// ---- Files --------------------------------------------------------------------------------------

void Interpreter::include(const Place& place) {
  const std::string name = read_text("the name of a file");
  tokens_.include(context_.resolve(name), false, place);
}

void Interpreter::import(const Place& place) {
  const std::string name = read_text("the name of a file");
  tokens_.include(context_.resolve(name), true, place);
  open(Block::import, place);
}

void Interpreter::end_import(const Place& place) {
  if (saved_.back().block != Block::import)
    fail("the imported file ends before this block is closed", saved_.back().place);
  state_ = close(Block::import, "the end of the file", "Import", place);
}

}  // namespace vitrail::pbrt
