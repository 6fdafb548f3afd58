// SPDX-License-Identifier: Apache-2.0
#include "bundle/ray_profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>

#include "bundle/binary_records.h"
#include "bundle/checked_json.h"
#include "scene/system/atomic_file.h"
#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"

namespace vitrail {

namespace {

using Json = nlohmann::ordered_json;

RayProfile from_json(const Json& json) {
  if (json.at("format") != "vitrail ray profile" || json.at("version") != 4)
    throw Error("not a ray profile of version 4");
  RayProfile p;
  for (int axis = 0; axis < 3; ++axis) p.offset[axis] = number<double>(json.at("offset"), axis);
  for (const Json& node : json.at("kd_nodes"))
    p.kd_nodes.push_back({number<float>(node, 1), number<std::uint32_t>(node, 0),
                          number<std::uint32_t>(node, 2), number<std::uint32_t>(node, 3)});
  for (const Json& d : json.at("domains"))
    p.domains.push_back({number<std::uint64_t>(d, 0), number<std::uint64_t>(d, 1), number<double>(d, 2)});
  for (const Json& w : json.at("ways")) {
    const auto from = number<std::int64_t>(w, 0);
    const auto to = number<std::uint32_t>(w, 1);
    const auto domains = static_cast<std::int64_t>(p.domains.size());
    if (from < -1 || from >= domains || to >= p.domains.size())
      throw Error("a way between domains that are none");
    p.ways.push_back({from < 0 ? RayProfile::Way::camera : static_cast<std::uint32_t>(from), to,
                      number<std::uint64_t>(w, 2)});
  }
  const Json& cost = json.at("cost");
  p.cost = {number<std::uint64_t>(cost, "camera_rays"), number<double>(cost, "trace_s"),
            number<double>(cost, "camera_s"), number<double>(cost, "load_s"),
            number<std::uint64_t>(cost, "loads")};
  const auto is_duration = [](double s) { return s >= 0; };
  if (!std::ranges::all_of(p.domains, is_duration, &RayProfile::Domain::seconds) ||
      !std::ranges::all_of(std::array{p.cost.trace_s, p.cost.camera_s, p.cost.load_s}, is_duration))
    throw Error("something took less than no time");
  if (const char* fault = fault_of_kd_tree(p.kd_nodes, p.domains.size())) throw Error(fault);
  return p;
}

}  // namespace

RayProfile::RayProfile(const Manifest& m, const std::vector<std::uint64_t>& rays,
                       const std::vector<double>& seconds, std::vector<Way> the_ways, Cost the_cost)
    : offset(m.offset), kd_nodes(m.kd_nodes), ways(std::move(the_ways)), cost(the_cost) {
  for (std::size_t i = 0; i < m.domains.size(); ++i) {
    const DomainInfo& d = m.domains[i];
    domains.push_back({rays[i], d.triangles + d.instances, seconds[i]});
  }
}

void RayProfile::require_of(const Manifest& manifest) const {
  if (domains.size() != manifest.domains.size() || kd_nodes != manifest.kd_nodes)
    throw Error("the profile is of a bundle with other domains; render this one with --profile");
}

std::uint32_t RayProfile::domain_at(Point3d world) const {
  std::uint32_t at = kd_nodes.empty() ? KdNode::leaf_bit : 0;
  while (!(at & KdNode::leaf_bit)) {
    const KdNode& n = kd_nodes[at];
    const int axis = static_cast<int>(n.axis);
    if (n.axis == KdNode::no_axis)
      at = n.below;
    else
      at = world[axis] - offset[axis] <= static_cast<double>(n.split) ? n.below : n.above;
  }
  return at & ~KdNode::leaf_bit;
}

namespace {

// JSON, a part at a time: a tree of all of it would take ten times its text.
class ProfileWriter {
 public:
  explicit ProfileWriter(const std::filesystem::path& file) : out_(file) {}

  void add(std::string_view text) {
    constexpr std::size_t worth_writing_bytes = 64 << 10;
    text_ += text;
    if (text_.size() > worth_writing_bytes) write();
  }
  template <class T>
  void add_list(const char* name, const std::vector<T>& list, const auto& to_json) {
    add(fmt::format(",\"{}\":[", name));
    for (const T& item : list) {
      if (&item != list.data()) add(",");
      add(to_json(item).dump());
    }
    add("]");
  }
  void commit() {
    write();
    out_.commit();
  }

 private:
  void write() {
    out_.write(std::as_bytes(std::span(text_)));
    text_.clear();
  }

  AtomicFile out_;
  std::string text_;
};

}  // namespace

void write_ray_profile(const std::filesystem::path& file, const RayProfile& p) {
  ProfileWriter out(file);
  const Json offset{p.offset.x, p.offset.y, p.offset.z};
  out.add("{\"format\":\"vitrail ray profile\",\"version\":4,\"offset\":" + offset.dump());
  out.add_list("kd_nodes", p.kd_nodes, [](const KdNode& n) {
    return Json{n.axis, n.split, n.below, n.above};
  });
  out.add_list("domains", p.domains, [](const RayProfile::Domain& d) {
    return Json{d.rays, d.items, d.seconds};
  });
  // From −1: the camera.
  out.add_list("ways", p.ways, [](const RayProfile::Way& w) {
    return Json{w.from == RayProfile::Way::camera ? std::int64_t{-1} : std::int64_t{w.from}, w.to, w.rays};
  });
  const Json cost{{"camera_rays", p.cost.camera_rays},
                  {"trace_s", p.cost.trace_s},
                  {"camera_s", p.cost.camera_s},
                  {"load_s", p.cost.load_s},
                  {"loads", p.cost.loads}};
  out.add(",\"cost\":" + cost.dump() + "}\n");
  out.commit();
}

RayProfile read_ray_profile(const std::filesystem::path& file) {
  note_input(file);
  std::ifstream in = open_regular(file);
  if (!in) throw Error("cannot be read", {file.string()});
  try {
    return from_json(Json::parse(in));
  } catch (const Json::exception& e) {
    throw Error(fmt::format("not a ray profile: {}", e.what()), {file.string()});
  } catch (const Error& e) {
    throw Error(e.what(), {file.string()});
  }
}

}  // namespace vitrail
