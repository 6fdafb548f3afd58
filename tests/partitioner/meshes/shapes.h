// SPDX-License-Identifier: Apache-2.0
// Meshes for tests of what is done to meshes.
#pragma once

#include <functional>
#include <random>

#include "scene/shapes/mesh.h"

namespace vitrail::test {

// 8·4^levels triangles on a sphere, fronts outside.
TriangleMesh sphere(int levels, double radius = 1, Point3d center = {});

// 2·n·m triangles around z, fronts outside. With uvs: two seams, along which vertices are doubled.
TriangleMesh torus(int n, int m, double radius = 1, double tube = 0.3, bool with_uvs = false);

// 2·n² triangles over [0,1]² at height `z`, fronts up.
TriangleMesh grid(int n, const std::function<double(double, double)>& z);

void append(TriangleMesh& mesh, const TriangleMesh& other);

// Turns triangles at random: each with probability 1/2.
void turn_at_random(TriangleMesh& mesh, std::uint64_t seed);

TriangleMesh turned(TriangleMesh mesh);  // all of them

// Every corner a vertex of its own.
TriangleMesh as_soup(const TriangleMesh& mesh);

// Six times the signed volume.
double volume6(const TriangleMesh& mesh);

// Edges, by position, that so many triangles have in either direction: [0] unused, [1] borders, [2] inner,
// [3] more.
std::array<std::size_t, 4> edges_by_triangles(const TriangleMesh& mesh);

// Of points spread over `from` (its vertices and more in its triangles) to the nearest of `to`.
double greatest_distance(const TriangleMesh& from, const TriangleMesh& to);

}  // namespace vitrail::test
