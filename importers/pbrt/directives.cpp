// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/directives.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "scene/color.h"

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

Interpreter::Interpreter(TokenStream& tokens, Context& context)
    : tokens_(tokens), context_(context), view_(default_view(context.version)), shapes_(context, scene_.meshes) {}

Scene Interpreter::run() {
  for (Token token = tokens_.next(); token.kind != TokenKind::end; token = tokens_.next()) {
    if (world_ == World::ended) {
      context_.report.dropped("what follows WorldEnd is another scene and is not read", token.place);
      break;
    }
    execute(token);
    tokens_.release();
  }
  check_blocks_are_closed();
  if (world_ == World::inside && context_.version == Version::v3)
    context_.report.approximated("there is no WorldEnd: the file may be incomplete", {});
  resolve_materials();
  drop_lights_of_interfaces();
  resolve_instances();
  apply(view_, context_.version, scene_);
  return std::move(scene_);
}

void Interpreter::execute(const Token& directive) {
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

// ---- Reading arguments ----------------------------------------------------------------------------------------

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
    if (const auto found = state_.defaults->find(defaults); found != state_.defaults->end()) known = &found->second;
  return {fmt::format("{} \"{}\"", directive, kind), place, read_parameters(tokens_, context_.report), known};
}

// ---- Transforms -----------------------------------------------------------------------------------------------

void Interpreter::set_ctm(const Transform& ctm, const Place& place) {
  if (!state_.transform_start || !state_.transform_end)
    context_.report.approximated("motion: the transform at the start of the shutter holds for the whole picture",
                                 place);
  if (!state_.transform_start) return;
  if (!is_invertible(ctm)) fail("the transform becomes singular here: it has no inverse", place);
  state_.ctm = ctm;
}

void Interpreter::identity(const Place& place) { set_ctm({}, place); }

void Interpreter::translate(const Place& place) {
  const auto v = read_numbers(3, place);
  apply_transform(vitrail::translate({v[0], v[1], v[2]}), place);
}

void Interpreter::scale(const Place& place) {
  const auto v = read_numbers(3, place);
  apply_transform(vitrail::scale({v[0], v[1], v[2]}), place);
}

void Interpreter::rotate(const Place& place) {
  constexpr double radians = 0.017453292519943295;
  const auto v = read_numbers(4, place);
  const Vector3d axis{v[1], v[2], v[3]};
  if (!(length(axis) > 0)) fail("the axis of the rotation is zero", place);
  apply_transform(vitrail::rotate(v[0] * radians, axis), place);
}

void Interpreter::look_at(const Place& place) {
  const auto v = read_numbers(9, place);
  const Transform camera_to_world =
      vitrail::look_at({v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]});
  if (!is_invertible(camera_to_world))
    fail("LookAt has no direction: eye and target coincide, or up is along the view", place);
  apply_transform(inverse(camera_to_world), place);
}

// Files list matrices by columns.
Transform Interpreter::read_matrix(const Place& place) {
  const auto v = read_numbers(16, place);
  Transform t;
  for (std::size_t i = 0; i < 16; ++i) t.m[i % 4][i / 4] = v[i];
  return t;
}

void Interpreter::transform(const Place& place) { set_ctm(read_matrix(place), place); }

void Interpreter::concat_transform(const Place& place) { apply_transform(read_matrix(place), place); }

void Interpreter::coordinate_system(const Place&) {
  coordinate_systems_[read_text("the name of a coordinate system")] = state_.ctm;
}

void Interpreter::coord_sys_transform(const Place& place) {
  const std::string name = read_text("the name of a coordinate system");
  const auto found = coordinate_systems_.find(name);
  if (found != coordinate_systems_.end()) return set_ctm(found->second, place);
  std::vector<std::string> known;
  for (const auto& entry : coordinate_systems_) known.push_back(entry.first);
  const std::string closest = closest_word(name, known);
  context_.report.dropped(fmt::format("coordinate system \"{}\" is not defined: CoordSysTransform has no effect{}",
                                      name, closest.empty() ? "" : fmt::format("; did you mean \"{}\"?", closest)),
                          place);
}

void Interpreter::active_transform(const Place& place) {
  const Token token = tokens_.next();
  const bool all = token.text == "All", start = token.text == "StartTime", end = token.text == "EndTime";
  if (token.kind != TokenKind::word || !(all || start || end))
    fail(fmt::format("expected All, StartTime or EndTime, found {}", describe(token)),
         token.kind == TokenKind::end ? place : token.place);
  state_.transform_start = all || start;
  state_.transform_end = all || end;
}

void Interpreter::transform_times(const Place& place) { read_numbers(2, place); }

// ---- Blocks ---------------------------------------------------------------------------------------------------

void Interpreter::open(Block block, const Place& place) {
  constexpr std::size_t depth_limit = 100'000;
  if (saved_.size() >= depth_limit) fail("blocks are nested too deeply", place);
  saved_.push_back({block, place, state_});
}

GraphicsState Interpreter::close(Block block, const char* directive, const char* opener, const Place& place) {
  if (saved_.empty() || saved_.back().block != block)
    fail(fmt::format("{} without {}{}", directive, opener,
                     saved_.empty() ? "" : fmt::format(" in the block that begins at {}",
                                                       to_string(location(saved_.back().place)))),
         place);
  GraphicsState state = std::move(saved_.back().state);
  saved_.pop_back();
  return state;
}

void Interpreter::attribute_begin(const Place& place) { open(Block::attribute, place); }

void Interpreter::attribute_end(const Place& place) {
  state_ = close(Block::attribute, "AttributeEnd", "AttributeBegin", place);
}

void Interpreter::transform_begin(const Place& place) { open(Block::transform, place); }

// v3 restores the transform only.
void Interpreter::transform_end(const Place& place) {
  GraphicsState before = close(Block::transform, "TransformEnd", "TransformBegin", place);
  if (context_.version == Version::v4) state_ = std::move(before);
  else state_.ctm = before.ctm;
}

void Interpreter::object_begin(const Place& place) {
  const std::string name = read_text("the name of an object");
  if (current_object_) fail("ObjectBegin inside of another object", place);
  open(Block::object, place);
  const auto next = static_cast<std::uint32_t>(scene_.prototypes.size());
  const auto [slot, redefined] = object_names_.define(name, place, next);
  if (slot == next) scene_.prototypes.push_back({});
  scene_.prototypes[slot].name = name;
  if (redefined)
    context_.report.approximated(fmt::format("object \"{}\" is defined again, for the instances after it", name),
                                 place);
  current_object_ = slot;
}

void Interpreter::object_end(const Place& place) {
  state_ = close(Block::object, "ObjectEnd", "ObjectBegin", place);
  current_object_.reset();
}

void Interpreter::world_begin(const Place& place) {
  if (world_ != World::before) fail("WorldBegin comes a second time", place);
  world_ = World::inside;
  state_.ctm = {};
  state_.transform_start = state_.transform_end = true;
  coordinate_systems_["world"] = {};
}

void Interpreter::world_end(const Place& place) {
  if (world_ != World::inside) fail("WorldEnd without WorldBegin", place);
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

// ---- Files ----------------------------------------------------------------------------------------------------

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

// ---- Settings -------------------------------------------------------------------------------------------------

void Interpreter::camera(const Place& place) {
  const std::string kind = read_text("a kind of camera");
  ParameterSet parameters = read_set("Camera", kind, place);
  read_camera(kind, parameters, state_.ctm, context_, view_);
  coordinate_systems_["camera"] = view_.camera_to_world;
}

void Interpreter::film(const Place& place) {
  const std::string kind = read_text("a kind of film");
  ParameterSet parameters = read_set("Film", kind, place);
  read_film(kind, parameters, context_, view_);
  if (state_.color_space != "srgb")
    context_.report.approximated(fmt::format("the film's colour space \"{}\" becomes \"srgb\"", state_.color_space),
                                 place);
}

void Interpreter::pixel_filter(const Place& place) {
  const std::string kind = read_text("a kind of filter");
  ParameterSet parameters = read_set("PixelFilter", kind, place);
  read_filter(kind, parameters, context_, view_);
}

void Interpreter::sampler(const Place& place) {
  const std::string kind = read_text("a kind of sampler");
  ParameterSet parameters = read_set("Sampler", kind, place);
  read_sampler(kind, parameters, context_, view_);
}

void Interpreter::integrator(const Place& place) {
  const std::string kind = read_text("a kind of integrator");
  ParameterSet parameters = read_set("Integrator", kind, place);
  read_integrator(kind, parameters, context_, view_);
}

// No accelerator changes the picture.
void Interpreter::accelerator(const Place& place) {
  const std::string kind = read_text("a kind of accelerator");
  read_set("Accelerator", kind, place);
}

void Interpreter::option(const Place& place) {
  for (const Parameter& parameter : read_parameters(tokens_, context_.report))
    for (const char* name : {"disablepixeljitter", "disablewavelengthjitter", "disabletexturefiltering",
                             "forcediffuse", "pixelstats", "msereferenceimage"})
      if (parameter.name == name && parameter.numbers != std::vector<double>{0})
        context_.report.dropped(fmt::format("option \"{}\" has no effect", name), place);
}

void Interpreter::color_space(const Place& place) {
  std::string name = read_text("the name of a colour space");
  try {
    to_srgb({}, name.c_str());
  } catch (const Error& error) {
    fail(error.what(), place);
  }
  state_.color_space = std::move(name);
}

void Interpreter::attribute(const Place& place) {
  const std::string target = read_text("what the attribute is for");
  std::vector<Parameter> parameters = read_parameters(tokens_, context_.report);
  constexpr std::array<const char*, 5> targets{"shape", "light", "material", "medium", "texture"};
  if (std::find(targets.begin(), targets.end(), target) == targets.end())
    fail(fmt::format("expected shape, light, material, medium or texture, found \"{}\"", target), place);
  std::map<std::string, std::vector<Parameter>> defaults;
  if (state_.defaults) defaults = *state_.defaults;
  for (Parameter& parameter : parameters) {
    parameter.from_attribute = true;
    defaults[target].push_back(std::move(parameter));
  }
  state_.defaults = std::make_shared<const std::map<std::string, std::vector<Parameter>>>(std::move(defaults));
}

}  // namespace vitrail::pbrt
