// SPDX-License-Identifier: Apache-2.0
// polygon, triangle, smooth_triangle, mesh and mesh2.
#include <fmt/format.h>
#include <optional>
#include <utility>

#include <cmath>
#include <map>

#include "importers/povray/read/contours.h"
#include "importers/povray/read/objects.h"
#include "importers/povray/read/reader.h"
#include "importers/shapes/polygon.h"

namespace vitrail::pov {

namespace {

Point3f single(Reader& reader, Point3d p) {
  const Point3f result = cast<float>(p);
  if (!is_finite(result)) reader.fail("a vertex is too far away", reader.here());
  return result;
}

Normal3f normal_of(Vector3d v) { return to_normal(cast<float>(normalize(v))); }

// Triangles as `mesh` lists them: each with its own corners.
struct Listed {
  TriangleMesh mesh;
  bool smooth = false;

  void add(Reader& reader, const std::array<Point3d, 3>& p, const std::array<Vector3d, 3>* n,
           const std::array<Point2d, 3>* uv) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const Vector3d flat = cross(p[1] - p[0], p[2] - p[0]);
    if (!(length(flat) > 0)) return;
    mesh.triangles.push_back({first, first + 1, first + 2});
    for (std::size_t i = 0; i < 3; ++i) {
      mesh.positions.push_back(single(reader, p[i]));
      mesh.normals.push_back(normal_of(n ? (*n)[i] : flat));
      mesh.uvs.push_back(uv ? Point2f{static_cast<float>((*uv)[i].x), static_cast<float>((*uv)[i].y)}
                            : Point2f{0, 0});
    }
    smooth = smooth || n;
  }
};

// The corners of a triangle, with normals where it is smooth.
void read_corners(Reader& reader, bool smooth, std::array<Point3d, 3>& p, std::array<Vector3d, 3>& n) {
  for (std::size_t i = 0; i < 3; ++i) {
    p[i] = reader.point("a corner of a triangle");
    reader.comma();
    if (smooth) n[i] = reader.vector("a normal"), reader.comma();
  }
}

MeshShape::Part part_of(Listed listed, Shared<Texture> texture) {
  if (!listed.smooth) listed.mesh.normals.clear();
  return {std::move(texture), std::make_shared<TriangleMesh>(std::move(listed.mesh))};
}

}  // namespace

void read_triangle(Reader& reader, Object& object, bool smooth) {
  std::array<Point3d, 3> p;
  std::array<Vector3d, 3> n;
  read_corners(reader, smooth, p, n);
  Listed listed;
  listed.add(reader, p, smooth ? &n : nullptr, nullptr);
  // Of one that is smooth the normals say where its outside is.
  const bool clockwise = !smooth || dot(cross(p[1] - p[0], p[2] - p[0]), n[0] + n[1] + n[2]) <= 0;
  object.shape = MeshShape{{part_of(std::move(listed), nullptr)}, false, clockwise, false};
}

void read_polygon(Reader& reader, Object& object) {
  const int count = reader.integer("the number of points of a polygon");
  std::vector<Point3d> points;
  for (int i = 0; i < count; ++i) {
    reader.comma();
    points.push_back(reader.point("a point of a polygon"));
  }
  // A contour ends where its first point comes again; without that, it is closed.
  std::vector<std::vector<Point3d>> contours(1);
  for (const Point3d& p : points) {
    auto& contour = contours.back();
    if (!contour.empty() && length(p - contour.front()) < 1e-9) {
      contours.emplace_back();
      continue;
    }
    contour.push_back(p);
  }
  std::erase_if(contours, [](const auto& contour) { return contour.size() < 3; });
  Listed listed;
  if (contours.empty())
    reader.notes.dropped("a polygon of fewer than three points", reader.location(object.place));
  for (const auto& corners : joined_contours(contours)) {
    std::vector<CornerTriple> triples;
    triangulate_polygon(corners, triples);
    for (const CornerTriple& t : triples)
      listed.add(reader, {corners[t[0]], corners[t[1]], corners[t[2]]}, nullptr, nullptr);
  }
  object.shape = MeshShape{{part_of(std::move(listed), nullptr)}, false, false, false};
}

void read_mesh(Reader& reader, Object& object) {
  std::map<const Texture*, std::pair<Shared<Texture>, Listed>> parts;
  MeshShape shape;
  shape.clockwise = true;
  for (;;) {
    reader.comma();
    const bool flat = reader.accept(Word::triangle_), smooth = !flat && reader.accept(Word::smooth_triangle_);
    if (!flat && !smooth) break;
    reader.expect('{', "behind triangle");
    std::array<Point3d, 3> p;
    std::array<Vector3d, 3> n;
    read_corners(reader, smooth, p, n);
    Shared<Texture> texture;
    std::optional<std::array<Point2d, 3>> uv;
    while (!reader.accept('}')) {
      if (reader.accept(Word::texture_)) {
        texture = read_texture_block(reader);
      } else if (reader.accept(Word::uv_vectors_)) {
        uv.emplace();
        for (Point2d& at : *uv) at = reader.point2("uv_vectors"), reader.comma();
      } else if (reader.accept(Word::texture_list_)) {
        reader.expect('{', "behind texture_list");
        while (!reader.accept('}')) {
          reader.comma();
          reader.accept(Word::texture_);
          Shared<Texture> one = read_texture_block(reader);
          if (!texture) texture = one;
        }
        reader.notes.approximated("textures of a triangle's corners: that of the first",
                                  reader.location(reader.here()));
      } else if (!reader.accept(',')) {
        reader.unexpected(reader.next(), "a part of triangle");
      }
    }
    auto& [held, listed] = parts[texture.get()];
    held = texture;
    listed.add(reader, p, smooth ? &n : nullptr, uv ? &*uv : nullptr);
  }
  if (reader.accept(Word::inside_vector_)) reader.vector("inside_vector"), shape.closed = true;
  for (auto& [key, part] : parts) shape.parts.push_back(part_of(std::move(part.second), part.first));
  object.shape = std::move(shape);
}

namespace {

// "{ count, …": calls `one` for each of the items, up to the brace.
template <class One>
std::size_t read_items(Reader& reader, const char* what, One&& one) {
  reader.expect('{', "behind a list");
  const int count = reader.integer(what);
  if (count < 0) reader.fail(fmt::format("{} is {}", what, count), reader.here());
  for (int i = 0; i < count; ++i) {
    reader.comma();
    one();
  }
  reader.comma();
  reader.expect('}', "at the end of a list");
  return static_cast<std::size_t>(count);
}

using Triple = std::array<std::uint32_t, 3>;

Triple triple_of(Reader& reader, const Numbers& n, std::size_t count, const char* what) {
  Triple t;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(n.v[i] >= 0 && n.v[i] < static_cast<double>(count)))
      reader.fail(fmt::format("there is no {} {}: there are {}", what, n.v[i], count), reader.here());
    t[i] = static_cast<std::uint32_t>(n.v[i]);
  }
  return t;
}

Triple triple(Reader& reader, std::size_t count, const char* what) {
  return triple_of(reader, reader.numbers(), count, what);
}

struct Lists {
  std::vector<Point3f> vertices;
  std::vector<Normal3f> normals;
  std::vector<Point2f> uvs;
  std::vector<Shared<Texture>> textures;
  std::vector<Triple> faces, normal_faces, uv_faces;
  std::optional<Numbers> next_face;  // an expression that was not the number of a texture
  std::vector<int> face_textures;    // −1: the object's
};

void read_face(Reader& reader, Lists& lists) {
  const Numbers corners = lists.next_face ? *std::exchange(lists.next_face, std::nullopt) : reader.numbers();
  lists.faces.push_back(triple_of(reader, corners, lists.vertices.size(), "vertex"));
  int texture = -1;
  for (int i = 0; i < 3; ++i) {  // one of the face, or one for each corner
    const Token comma = reader.next();
    const Token token = comma.is(',') ? reader.peek() : comma;
    if (!comma.is(',')) {
      reader.put_back(comma);
      break;
    }
    if (token.is('<') || token.is('}')) {
      reader.put_back(comma);
      break;
    }
    const Numbers given = reader.numbers();
    if (given.terms > 1) {
      lists.next_face = given;
      break;
    }
    if (!(given.v[0] >= 0 && given.v[0] < static_cast<double>(lists.textures.size())))
      reader.fail(fmt::format("there is no texture {}", given.v[0]), reader.here());
    if (i == 0) texture = static_cast<int>(given.v[0]);
  }
  lists.face_textures.push_back(texture);
}

// One corner list for all three kinds of indices.
MeshShape shape_of(const Lists& l) {
  std::map<int, std::vector<std::size_t>> by_texture;
  for (std::size_t i = 0; i < l.faces.size(); ++i) by_texture[l.face_textures[i]].push_back(i);
  MeshShape shape;
  shape.clockwise = true;
  const auto& nf = l.normal_faces.empty() ? l.faces : l.normal_faces;
  const auto& uf = l.uv_faces.empty() ? l.faces : l.uv_faces;
  const bool normals = !l.normals.empty() && nf.size() == l.faces.size() &&
                       (!l.normal_faces.empty() || l.normals.size() == l.vertices.size());
  const bool uvs = !l.uvs.empty() && uf.size() == l.faces.size() &&
                   (!l.uv_faces.empty() || l.uvs.size() == l.vertices.size());
  const bool shared = l.normal_faces.empty() && l.uv_faces.empty();
  for (const auto& [texture, faces] : by_texture) {
    TriangleMesh mesh;
    if (shared && by_texture.size() == 1) {
      mesh.positions = l.vertices;
      if (normals) mesh.normals = l.normals;
      if (uvs) mesh.uvs = l.uvs;
      mesh.triangles = l.faces;
    } else {
      std::map<Triple, std::uint32_t> corners;
      for (const std::size_t face : faces) {
        Triple made;
        for (std::size_t i = 0; i < 3; ++i) {
          const Triple key{l.faces[face][i], normals ? nf[face][i] : 0, uvs ? uf[face][i] : 0};
          const auto [at, added] =
              corners.try_emplace(key, static_cast<std::uint32_t>(mesh.positions.size()));
          if (added) {
            mesh.positions.push_back(l.vertices[key[0]]);
            if (normals) mesh.normals.push_back(l.normals[key[1]]);
            if (uvs) mesh.uvs.push_back(l.uvs[key[2]]);
          }
          made[i] = at->second;
        }
        mesh.triangles.push_back(made);
      }
    }
    const Shared<Texture> held = texture < 0 ? nullptr : l.textures[static_cast<std::size_t>(texture)];
    shape.parts.push_back({held, std::make_shared<TriangleMesh>(std::move(mesh))});
  }
  return shape;
}

}  // namespace

void read_mesh2(Reader& reader, Object& object) {
  Lists lists;
  bool closed = false;
  for (;;) {
    reader.comma();
    const Token token = reader.next();
    if (token.is(Word::vertex_vectors_)) {
      read_items(reader, "the number of vertices",
                 [&] { lists.vertices.push_back(single(reader, reader.point("a vertex"))); });
    } else if (token.is(Word::normal_vectors_)) {
      read_items(reader, "the number of normals",
                 [&] { lists.normals.push_back(normal_of(reader.vector("a normal"))); });
    } else if (token.is(Word::uv_vectors_)) {
      read_items(reader, "the number of uv_vectors", [&] {
        const Point2d uv = reader.point2("a uv vector");
        lists.uvs.push_back({static_cast<float>(uv.x), static_cast<float>(uv.y)});
      });
    } else if (token.is(Word::texture_list_)) {
      read_items(reader, "the number of textures", [&] {
        reader.accept(Word::texture_);
        lists.textures.push_back(read_texture_block(reader));
      });
    } else if (token.is(Word::face_indices_)) {
      read_items(reader, "the number of faces", [&] { read_face(reader, lists); });
    } else if (token.is(Word::normal_indices_)) {
      read_items(reader, "the number of faces",
                 [&] { lists.normal_faces.push_back(triple(reader, lists.normals.size(), "normal")); });
    } else if (token.is(Word::uv_indices_)) {
      read_items(reader, "the number of faces",
                 [&] { lists.uv_faces.push_back(triple(reader, lists.uvs.size(), "uv vector")); });
    } else if (token.is(Word::inside_vector_)) {
      reader.vector("inside_vector");
      closed = true;
    } else {
      reader.put_back(token);
      break;
    }
  }
  MeshShape shape = shape_of(lists);
  shape.closed = closed;
  object.shape = std::move(shape);
}

}  // namespace vitrail::pov
