// SPDX-License-Identifier: Apache-2.0
// A SceneMaker makes a Scene of what was read.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "importers/povray/read/area_lamp.h"
#include "importers/povray/read/surfaces.h"
#include "importers/povray/read/world.h"
#include "scene/records/scene.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail::pov {

class SceneMaker {
 public:
  SceneMaker(Reader& reader, const World& world, MeshMemory& memory);

  Scene make();

 private:
  // It is a part of an object that has one texture, in the object's own space.
  struct Piece {
    Id<TriangleMesh> mesh;
    Transform to_object;
    std::optional<Look> look;  // of its own
    bool faces_out = true;
    bool has_uvs = false;  // as POV-Ray has them; else those are the world's x and y
  };
  // Shapes go to a Target: the scene, or a prototype.
  struct Target {
    std::vector<Shape>& shapes;
    std::vector<Instance>& instances;
  };

  // These make shapes (make_shapes.cpp).
  void add(const Object& object, const Transform& parent_to_world, Look look, Target target);
  // Fills the surface of a container: light goes through its clear parts, and meets what is within.
  void fill(Shape& shape, std::optional<Id<Medium>> medium);
  bool lets_light_in(const Shape& shape) const;
  void add_group(const Object& object, const Transform& to_world, const Look& look, Target target);
  void add_plane(const Object& object, const PlaneShape& plane, const Transform& to_world, const Look& look,
                 Target target);
  void add_piece(const Object& object, const Piece& piece, const Transform& to_world, const Look& look,
                 Target target);
  // Returns the same material for objects without shadow.
  Id<Material> shadowless(Id<Material> material);
  // Changes an object without shadow, for formats that have none. If it only glows, it becomes a clear sheet
  // that glows, so that light passes it.
  Surface without_shadow(Surface surface, bool of_lamp, const Object& object);
  Id<TriangleMesh> add_mesh(TriangleMesh mesh);
  Id<TriangleMesh> quadric_mesh(const Quadric& quadric);
  // Returns an object that many may refer to, as it is within something of this look, which is the same
  // wherever it is.
  std::optional<Id<Prototype>> prototype_of(const Shared<Object>& object, const Look& look);
  bool is_plain(const Object& object);
  // These make quadrics and meshes (make_pieces.cpp).
  std::vector<Piece> pieces_of(const Object& object);
  // Makes a mesh with these (u,v), if there are any and the scene has a use for them.
  Piece piece_with(TriangleMesh mesh, const SurfaceUvs& uvs);
  std::vector<Piece> round_pieces(const ConeShape& cone);
  // These make sets of points (make_csg.cpp).
  std::vector<Piece> set_pieces(const Object& object);
  std::vector<Piece> clipped_pieces(const Object& object);
  std::optional<solids::Csg> csg_of(const Object& object, const Transform& parent_to_set, const Look& look,
                                    std::vector<Look>& looks);
  std::optional<solids::Csg> shape_csg(const Object& object, std::uint32_t surface);
  std::vector<Piece> evaluated(const solids::Csg& csg, const std::vector<Look>& looks, const Object& object);

  // These make lights and surroundings (make_lights.cpp).
  void add_light(const Object& object, const LightShape& light, const Transform& to_world);
  void add_surroundings();
  // Returns whether it is a ball around the eye that the camera alone sees: that hides what is around.
  bool hides_surroundings(const Object& object) const;
  // Returns whether the shape that comes next is one: with no_image only if it glows, as it lights the scene.
  bool is_there(const Look& look, bool glows, const Object& object, const Target& target);
  // Hides emitters where the camera sees nothing that shines. Else drops the shapes with no_image.
  void hide_lamps();
  // Adds lamps that are rectangles (area_lamp.h), once all shapes are there.
  void add_lamps();
  // These add fog (make_fog.cpp).
  void add_fog();
  std::optional<Id<Medium>> fog_between(double low, double high);
  void add_layers(const Fog& fog);
  void add_fog_face(const FogEdge& edge, double height, std::optional<Id<Medium>> below,
                    std::optional<Id<Medium>> above);
  void add_fog_side(const FogEdge& edge, double low, double high, Id<Medium> medium);
  void add_fog_filter(const Fog& fog);
  void add_fog_shape(const Fog& fog, Id<TriangleMesh> mesh, const Transform& to_world,
                     std::optional<Id<Medium>> interior, std::optional<Id<Medium>> exterior);
  // These make media {} (make_media.cpp), of an object under this transform, and of what is around.
  std::optional<Id<Medium>> media_of(const Object& object, const Interior& interior,
                                     const Transform& to_world);
  std::optional<Id<Medium>> fade_of(const Object& object, const Interior& interior,
                                    const Transform& to_world);
  std::optional<Id<Medium>> medium_of(const std::vector<Shared<MediaBlock>>& blocks,
                                      const Transform& to_world, const Bounds3d& box);
  void add_atmosphere();
  // Sets the medium around the eye. Objects that are not hollow hold no fog and no atmosphere.
  void set_eye_medium();
  // These set the view (make_view.cpp).
  void set_view();

  Point3d eye() const { return world_.camera ? Point3d{} + world_.camera->location : Point3d{}; }
  Origin origin(const Place& place) const { return {place.file, place.line, place.column}; }

  Reader& reader_;
  const World& world_;
  MeshMemory& memory_;
  Scene scene_;
  Surfaces surfaces_;
  std::map<const Object*, std::vector<Piece>> pieces_;
  // It has an object, and of a look all that shapes take from it: texture, interior_texture, by_uv,
  // no_shadow, no_image, hollow, double_illuminate.
  using Worn =
      std::tuple<const Object*, const pov::Texture*, const pov::Texture*, bool, bool, bool, bool, bool>;
  std::map<Worn, std::optional<Id<Prototype>>> prototypes_;
  Shared<pov::Texture> default_texture_;  // of the object that is added
  std::map<const Object*, bool> plain_;
  std::vector<std::pair<Quadric, Id<TriangleMesh>>> quadrics_;
  std::optional<Id<Material>> clear_sheet_;
  std::map<std::uint32_t, Id<Material>> shadowless_;
  std::vector<AreaLamp> lamps_;
  std::vector<std::pair<std::size_t, Place>> unseen_;  // shapes that glow and have no_image, from where
  bool sees_glow_ = false, sees_around_ = true;
  std::vector<Shared<Fog>> fogs_;         // that are there
  std::optional<Id<Medium>> atmosphere_;  // or fog, where there is no object
  std::optional<Id<Medium>> eye_medium_;  // of an object that the eye is in
  double reach_ = 1;                      // beyond all that is finite
};

}  // namespace vitrail::pov
