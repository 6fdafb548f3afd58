// SPDX-License-Identifier: Apache-2.0
// The Interpreter executes the directives of a pbrt file, one after the other, on the graphics state and the
// scene.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "importers/pbrt/read/camera_film.h"
#include "importers/pbrt/read/graphics_state.h"
#include "importers/pbrt/read/materials.h"
#include "importers/pbrt/read/media.h"
#include "importers/pbrt/read/named_slots.h"
#include "importers/pbrt/read/shapes.h"
#include "importers/pbrt/read/textures.h"
#include "importers/pbrt/read/token_stream.h"
#include "scene/records/quadric_runs.h"
#include "scene/records/uv_uses.h"

namespace vitrail::pbrt {

class Interpreter {
 public:
  Interpreter(TokenStream& tokens, Context& context);

  // Reads everything.
  Scene run();

  // They describe the file that was read:
  bool had_world() const { return world_ != World::before; }
  bool had_camera() const { return view_.has_camera; }

 private:
  using Handler = void (Interpreter::*)(const Place&);
  static const std::map<std::string, Handler, std::less<>>& handlers();

  // It says which directive opened a saved state. A Saved also says where.
  enum class Block { attribute, transform, object, import };
  struct Saved {
    Block block;
    Place place;
    GraphicsState state;
    // They take back, in v3, the names that were defined in the block, the last first.
    std::vector<std::function<void()>> undo = {};
  };
  enum class World { before, inside, ended };

  void execute(const Token& directive);

  // These functions read arguments.
  std::string read_text(const char* what);
  std::vector<double> read_numbers(std::size_t count, const Place& directive);
  ParameterSet read_set(const std::string& directive, const std::string& kind, const Place& place,
                        const char* defaults = nullptr);
  Scope scope(const Place& place) {
    return {{context_, state_.color_space}, textures_, scene_.textures, origin(place)};
  }
  Origin origin(const Place& place);

  // These execute directives on transforms.
  void identity(const Place&);
  void translate(const Place&);
  void scale(const Place&);
  void rotate(const Place&);
  void look_at(const Place&);
  void transform(const Place&);
  void concat_transform(const Place&);
  void coordinate_system(const Place&);
  void coord_sys_transform(const Place&);
  void active_transform(const Place&);
  void transform_times(const Place&);
  template <class Changed>
  void change_active(const Place& place, Changed&& changed);
  void set_transform(const Transform& t, const Place& place);
  void apply_transform(const Transform& by, const Place& place);
  bool is_moving() const { return state_.ctm != state_.ctm_end; }
  Motion motion_between(const Transform& start, const Transform& end, const Place& place);
  void report_held(const char* what, const Place& place);
  // It holds the transform of what the current transforms place, when the shutter opens, and its motion.
  struct Placing {
    Transform at_open;
    std::optional<Id<Motion>> motion;
  };
  const Placing& placing(const Place& place);
  Id<Prototype> moving_prototype(const Placing& placing, const Place& place);
  Transform read_matrix(const Place& place);

  // These execute directives on blocks.
  void attribute_begin(const Place&);
  void attribute_end(const Place&);
  void transform_begin(const Place&);
  void transform_end(const Place&);
  void object_begin(const Place&);
  void object_end(const Place&);
  void world_begin(const Place&);
  void world_end(const Place&);
  void open(Block block, const Place& place);
  GraphicsState close(Block block, const char* directive, const char* opener, const Place& place);
  bool names_end_with_block() const { return context_.version == Version::v3 && !saved_.empty(); }
  template <class Table>
  void define_texture(Table& table, const std::string& name, typename Table::mapped_type value);

  // These execute directives on files.
  void include(const Place&);
  void import(const Place&);
  void end_import(const Place&);

  // These execute settings before the world.
  void camera(const Place&);
  void film(const Place&);
  void pixel_filter(const Place&);
  void sampler(const Place&);
  void integrator(const Place&);
  void report_integrator();  // once all is read
  void accelerator(const Place&);
  void option(const Place&);
  void color_space(const Place&);

  // These execute the directives of the world.
  void attribute(const Place&);
  void reverse_orientation(const Place&);
  void material(const Place&);
  void make_named_material(const Place&);
  void named_material(const Place&);
  void make_named_medium(const Place&);
  void medium_interface(const Place&);
  void texture(const Place&);
  void light_source(const Place&);
  void area_light_source(const Place&);
  void shape(const Place&);
  void object_instance(const Place&);

  void define_material(std::uint32_t slot, const std::string& kind, ParameterSet parameters,
                       const Place& place);
  Material made_material(const std::string& kind, ParameterSet& parameters, const Scope& scope);
  std::uint32_t new_material_slot();
  void set_material(std::uint32_t slot, Material material);
  void define_unknown_materials();
  std::uint32_t add_material(Material material);
  Id<Material> shape_material();
  std::optional<Id<Material>> overridden_material(ParameterSet& shape, const Place& place);
  FloatParameter shape_opacity(ParameterSet& parameters, const Place& place);
  void report_shining_alpha(const FloatParameter& alpha, const Place& place);
  bool uvs_show(const FloatParameter& opacity);
  std::vector<Id<Material>> with_parts(Id<Material> material) const;
  bool meets_hair(Id<Material> material) const;
  void add_shape(const ShapeGeometry& geometry, const FloatParameter& opacity, const Place& place);
  std::optional<Id<Medium>> medium_named(const std::string& name, const Place& place);
  // Returns the mean luminance of an image that shines; nothing where its light is not known.
  std::optional<double> mean_of_image(Id<Texture> texture);
  std::optional<Id<AreaLight>> shape_light(const ShapeGeometry& geometry, const Place& place);
  double area_per_part(const ShapeGeometry& geometry, const Place& place);

  // These complete the scene at the end.
  void check_blocks_are_closed();
  void resolve_materials();
  void resolve_deferred(bool all);
  void resolve_media();
  void drop_lights_of_interfaces();
  void resolve_instances();

  TokenStream& tokens_;
  Context& context_;
  Scene scene_;
  ViewSettings view_;
  Place integrator_place_;
  GraphicsState state_;
  std::vector<Saved> saved_;
  World world_ = World::before;
  Place world_place_;
  std::map<const std::string*, std::uint32_t> file_numbers_;
  struct TransformPair {
    Transform start, end;
  };
  std::map<std::string, TransformPair> coordinate_systems_;
  struct LastPlacing {
    TransformPair of;
    bool in_object = false;
    Placing placing;
    std::optional<Id<Prototype>> moved;  // by it: shapes that move together are one object
  };
  LastPlacing last_placing_;
  double transform_start_s_ = 0, transform_end_s_ = 1;  // TransformTimes
  TextureTable textures_;
  UvUses uv_uses_{scene_.textures};
  ShapeMaker shapes_;
  QuadricRuns quadric_runs_;
  std::map<std::uint32_t, std::optional<double>> image_means_;  // by the texture
  std::vector<Place> area_light_places_;                        // one for each of the scene's area lights

  // Materials have numbers; named ones may be used before they are defined.
  struct DeferredMaterial {
    std::uint32_t slot;
    std::string kind, color_space;
    ParameterSet parameters;
    Place place;
  };
  NamedSlots material_names_{"material"};
  std::map<std::uint32_t, std::optional<Id<Material>>>
      before_named_;  // where a name came before its definition
  std::vector<Material> materials_;
  std::vector<bool> material_is_made_;
  std::vector<DeferredMaterial> deferred_;
  struct GivenMaterial {
    std::string kind;
    std::vector<Parameter> parameters;
  };
  std::map<std::uint32_t, GivenMaterial> given_;  // by slot, in v3, whose shapes may change them
  std::map<std::uint32_t, std::string> named_slots_;
  std::optional<Id<Material>> default_material_;
  std::set<std::uint32_t> shares_of_v3_;  // textures that are a shape's "alpha" in a file of v3

  NamedSlots medium_names_{"medium"};
  std::vector<std::optional<Medium>> media_;

  NamedSlots object_names_{"object"};
  std::optional<std::uint32_t> current_object_;
};

}  // namespace vitrail::pbrt
