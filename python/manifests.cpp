// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/string.h>

#include "bundle/manifest.h"
#include "python/arrays.h"
#include "python/parts.h"

namespace nb = nanobind;

namespace vitrail::python {

namespace {

// A member of each record, without copies: `first` is that of the first record.
template <class T, class Record>
Array<T> column(const Manifest& self, const std::vector<Record>& records, const T Record::*member) {
  static_assert(sizeof(Record) % sizeof(T) == 0);
  const T* first = records.empty() ? nullptr : &(records.front().*member);
  return view(first, {records.size()}, nb::find(self),
              {static_cast<std::int64_t>(sizeof(Record) / sizeof(T))});
}

static_assert(sizeof(Bounds3f) == 6 * sizeof(float));

Array<float> bounds_of(const Manifest& self) { return view(&self.bounds.lower.x, {2, 3}, nb::find(self)); }

Array<float> domain_bounds_of(const Manifest& self) {
  const float* first = self.domains.empty() ? nullptr : &self.domains.front().tight_bounds.lower.x;
  return view(first, {self.domains.size(), 2, 3}, nb::find(self),
              {static_cast<std::int64_t>(sizeof(DomainInfo) / sizeof(float)), 3, 1});
}

}  // namespace

void add_manifests(nb::module_& module) {
  nb::class_<Manifest>(module, "Manifest",
                       "What a bundle says of itself. Coordinates are the world's minus `offset`.")
      .def(
          "__init__",
          [](Manifest* self, const std::filesystem::path& bundle) {
            new (self) Manifest(read_manifest(bundle));
          },
          nb::arg("bundle"))
      .def_prop_ro("triangles", [](const Manifest& m) { return m.triangles; })
      .def_prop_ro("scene_hash", [](const Manifest& m) { return fmt::format("{:016x}", m.scene_hash); })
      .def_prop_ro(
          "offset", [](const Manifest& m) { return view(&m.offset.x, {3}, nb::find(m)); }, "float64, 3")
      .def_prop_ro("bounds", bounds_of, "float32, 2 × 3: the lower and the upper corner")
      .def_prop_ro("domain_triangles",
                   [](const Manifest& m) { return column(m, m.domains, &DomainInfo::triangles); })
      .def_prop_ro(
          "domain_pieces", [](const Manifest& m) { return column(m, m.domains, &DomainInfo::pieces); },
          "of the triangles, those that are cut")
      .def_prop_ro("domain_bytes", [](const Manifest& m) { return column(m, m.domains, &DomainInfo::bytes); })
      .def_prop_ro("domain_instances",
                   [](const Manifest& m) { return column(m, m.domains, &DomainInfo::instances); })
      .def_prop_ro("domain_bounds", domain_bounds_of, "float32, domains × 2 × 3; lower > upper where empty")
      .def_prop_ro("kd_splits", [](const Manifest& m) { return column(m, m.kd_nodes, &KdNode::split); })
      .def_prop_ro(
          "kd_axes", [](const Manifest& m) { return column(m, m.kd_nodes, &KdNode::axis); },
          "0, 1, 2; 3 where no plane parts the children, which share the cell")
      .def_prop_ro(
          "kd_below", [](const Manifest& m) { return column(m, m.kd_nodes, &KdNode::below); },
          "number of a node, or 2³¹ + that of a domain")
      .def_prop_ro("kd_above", [](const Manifest& m) { return column(m, m.kd_nodes, &KdNode::above); });
}

}  // namespace vitrail::python
