// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/nori_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <pugixml.hpp>
#include <sstream>
#include <stdexcept>

namespace vitrail::test {

namespace {

namespace fs = std::filesystem;

std::vector<double> numbers(std::string text) {
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream in(text);
  std::vector<double> result;
  for (double x; in >> x;) result.push_back(x);
  return result;
}

std::string value(const pugi::xml_node& node, const char* name, const char* otherwise) {
  const pugi::xml_node found = node.find_child_by_attribute("name", name);
  return found ? found.attribute("value").value() : otherwise;
}

std::string rgb(const char* name, const std::string& text, double scale = 1) {
  const std::vector<double> c = numbers(text);
  return fmt::format("<rgb name=\"{}\" value=\"{} {} {}\"/>", name, scale * c.at(0), scale * c.at(1),
                     scale * c.at(2));
}

// Nori's microfacet model is kd/π + ks·D·F·G/(4 cos cos), ks = 1 − max(kd), Beckmann: a blend by ks, whose
// second part is a conductor that absorbs nothing (k = 0), which reflects as a dielectric does.
std::string microfacet(const pugi::xml_node& bsdf) {
  const std::string kd = value(bsdf, "kd", "0.5 0.5 0.5");
  const std::vector<double> c = numbers(kd);
  const double ks = 1 - *std::max_element(c.begin(), c.end());
  return fmt::format(
      "<bsdf type=\"blendbsdf\"><float name=\"weight\" value=\"{}\"/><bsdf type=\"diffuse\">{}</bsdf>"
      "<bsdf type=\"roughconductor\"><string name=\"distribution\" value=\"beckmann\"/>"
      "<float name=\"alpha\" value=\"{}\"/><float name=\"eta\" value=\"{}\"/><float name=\"k\" value=\"0\"/>"
      "</bsdf></bsdf>",
      ks, rgb("reflectance", kd, 1 / (1 - ks)), value(bsdf, "alpha", "0.1"), 1.5046 / 1.000277);
}

std::string bsdf_of(const pugi::xml_node& bsdf) {
  const std::string type = bsdf.attribute("type").value();
  if (type == "microfacet") return microfacet(bsdf);
  if (!type.empty() && type != "diffuse") throw std::runtime_error("unknown BSDF of Nori: " + type);
  return "<bsdf type=\"diffuse\">" + rgb("reflectance", value(bsdf, "albedo", "0.5 0.5 0.5")) + "</bsdf>";
}

// The commands of a transform, which Mitsuba has too.
std::string transform_of(const pugi::xml_node& node) {
  std::string text;
  for (const pugi::xml_node command : node.find_child_by_attribute("name", "toWorld")) {
    std::ostringstream out;
    command.print(out, "", pugi::format_raw);
    text += out.str();
  }
  return "<transform name=\"to_world\">" + text + "</transform>";
}

bool has_normals(const fs::path& obj) {
  std::ifstream in(obj);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("vn ")) return true;
  return false;
}

std::string shape_of(const pugi::xml_node& mesh, const fs::path& folder) {
  const fs::path obj = fs::absolute(folder / value(mesh, "filename", ""));
  std::string text = fmt::format(
      "<shape type=\"obj\"><string name=\"filename\" value=\"{}\"/>"
      "<boolean name=\"face_normals\" value=\"{}\"/>{}{}",
      obj.string(), !has_normals(obj), transform_of(mesh), bsdf_of(mesh.child("bsdf")));
  if (const pugi::xml_node emitter = mesh.child("emitter"))
    text += "<emitter type=\"area\">" + rgb("radiance", value(emitter, "radiance", "1 1 1")) + "</emitter>";
  return text + "</shape>\n";
}

NoriScene convert(const pugi::xml_node& scene, const fs::path& folder) {
  NoriScene result;
  const pugi::xml_node camera = scene.child("camera");
  result.width = std::stoi(value(camera, "width", "1280"));
  result.height = std::stoi(value(camera, "height", "720"));
  const bool direct = std::string(scene.child("integrator").attribute("type").value()) == "whitted";
  result.mitsuba = fmt::format(
      "<scene version=\"3.0.0\"><integrator type=\"{}\"/>\n"
      "<sensor type=\"perspective\"><float name=\"fov\" value=\"{}\"/>{}<film type=\"hdrfilm\">"
      "<integer name=\"width\" value=\"{}\"/><integer name=\"height\" value=\"{}\"/>"
      "<rfilter type=\"gaussian\"/></film></sensor>\n",
      direct ? "direct" : "path", value(camera, "fov", "30"), transform_of(camera), result.width,
      result.height);
  for (const pugi::xml_node mesh : scene.children("mesh")) result.mitsuba += shape_of(mesh, folder);
  result.mitsuba += "</scene>\n";
  return result;
}

}  // namespace

std::vector<NoriScene> read_nori(const fs::path& file) {
  pugi::xml_document document;
  if (!document.load_file(file.c_str())) throw std::runtime_error("cannot read " + file.string());
  if (const pugi::xml_node scene = document.child("scene")) return {convert(scene, file.parent_path())};
  const pugi::xml_node test = document.child("test");
  const std::vector<double> references = numbers(value(test, "references", ""));
  std::vector<NoriScene> scenes;
  for (const pugi::xml_node scene : test.children("scene")) {
    scenes.push_back(convert(scene, file.parent_path()));
    scenes.back().reference = references.at(scenes.size() - 1);
  }
  return scenes;
}

}  // namespace vitrail::test
