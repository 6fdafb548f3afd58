// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "tests/conformance/formats/feature_cases.h"

namespace vitrail::test {

namespace {

// The word that says where a plugin stands: "Material" of Material "mix", "bsdf" of bsdf mask.
std::string first_word(const std::string& name) { return name.substr(0, name.find(' ')); }

std::string pbrt_scene(bool v3, const PluginCase& plugin, const std::string& parameters) {
  const std::string text = plugin.name + " " + plugin.needs + " " + parameters + "\n";
  const std::string word = first_word(plugin.name);
  const auto unless = [&](const char* what, const char* standard) {
    return word == what ? text : std::string(standard) + "\n";
  };
  const bool in_world = word == "Material" || word == "Texture" || word == "LightSource" ||
                        word == "AreaLightSource" || word == "Shape" || word == "MakeNamedMedium";
  std::string scene = "LookAt 0 0 5 0 0 0 0 1 0\n";
  if (!in_world && !plugin.name.empty()) scene += text;
  if (v3 && word == "MakeNamedMedium") scene += "Integrator \"volpath\"\n";
  if (word != "Camera") scene += "Camera \"perspective\"\n";
  scene += "WorldBegin\n" + unless("LightSource", "LightSource \"infinite\"");
  const char* named = v3 ? "matte" : "diffuse";
  for (const char* name : {"a", "b"})
    scene += fmt::format("MakeNamedMaterial \"{}\" \"string type\" \"{}\"\n", name, named);
  if (word == "MakeNamedMedium")
    scene +=
        text + "MediumInterface \"m\" \"\"\n" + (v3 ? "Material \"none\"\n" : "Material \"interface\"\n");
  else if (word == "Texture" && plugin.name.find("\"float\"") != std::string::npos)
    scene += text + (v3 ? "Material \"matte\" \"texture sigma\" \"t\"\n"
                        : "Material \"conductor\" \"texture roughness\" \"t\"\n");
  else if (word == "Texture")
    scene += text + (v3 ? "Material \"matte\" \"texture Kd\" \"t\"\n"
                        : "Material \"diffuse\" \"texture reflectance\" \"t\"\n");
  else
    scene += unless("Material", v3 ? "Material \"matte\" \"rgb Kd\" [.7 .5 .3]"
                                   : "Material \"diffuse\" \"rgb reflectance\" [.7 .5 .3]");
  if (word == "AreaLightSource") scene += text;
  scene += unless("Shape", "Shape \"sphere\"");
  return v3 ? scene + "WorldEnd\n" : scene;
}

std::string mitsuba_scene(const char* version, const PluginCase& plugin, const std::string& parameters) {
  const std::string word = first_word(plugin.name);
  const std::string type = plugin.name.empty() ? "" : plugin.name.substr(word.size() + 1);
  const auto element = [&](const std::string& name) {
    return fmt::format("<{0} type='{1}'{2}>{3}{4}</{0}>", word, type,
                       name.empty() ? "" : " name='" + name + "'", parameters, plugin.needs);
  };
  const auto unless = [&](const char* what, const std::string& standard) {
    return word == what ? element("") : standard;
  };
  const bool of_shape = word == "emitter" && type.find("area") != std::string::npos;
  const std::string film =
      word == "film" ? element("")
                     : "<film type='hdrfilm'>" + unless("rfilter", "<rfilter type='box'/>") + "</film>";
  const std::string in_sensor =
      std::string(version[0] == '0' ? "<float name='shutterClose' value='1'/>" : "") +
      "<transform name='to_world'><lookat origin='0,0,5' target='0,0,0' up='0,1,0'/></transform>" + film +
      unless("sampler", "<sampler type='independent'/>");
  std::string scene = fmt::format("<scene version='{}'>\n", version);
  scene += unless("integrator", "<integrator type='volpath'/>") + "\n";
  if (word == "sensor")
    scene += fmt::format("<sensor type='{}'>{}{}{}</sensor>\n", type, in_sensor, parameters, plugin.needs);
  else
    scene += "<sensor type='perspective'>" + in_sensor + "</sensor>\n";
  scene += (word == "emitter" && !of_shape ? element("") : "<emitter type='constant'/>") + "\n";
  std::string inside = "<bsdf type='diffuse'><rgb name='reflectance' value='.7,.5,.3'/></bsdf>";
  if (word == "bsdf") inside = element("");
  if (word == "texture") inside = "<bsdf type='diffuse'>" + element("reflectance") + "</bsdf>";
  const auto filled = [](const std::string& medium) { return "<bsdf type='null'/>" + medium; };
  if (word == "medium") inside = filled(element("interior"));
  if (word == "phase")
    inside = filled("<medium type='homogeneous' name='interior'><rgb name='albedo' value='.7'/>" +
                    element("") + "</medium>");
  if (word == "volume")
    inside = filled("<medium type='heterogeneous' name='interior'>" + element("sigma_t") + "</medium>");
  if (of_shape) inside += element("");
  if (word == "subsurface")
    inside = "<bsdf type='plastic'><spectrum name='diffuseReflectance' value='0'/></bsdf>" + element("");
  if (word == "shape")
    scene += fmt::format("<shape type='{}'>{}{}{}</shape>\n", type, parameters, plugin.needs, inside);
  else
    scene += "<shape type='sphere'>" + inside + "</shape>\n";
  return scene + "</scene>\n";
}

}  // namespace

std::string host_scene(SceneFormat format, const PluginCase& plugin, const std::string& parameters) {
  switch (format) {
    case SceneFormat::pbrt_v3:
      return pbrt_scene(true, plugin, parameters);
    case SceneFormat::pbrt_v4:
      return pbrt_scene(false, plugin, parameters);
    case SceneFormat::mitsuba_06:
      return mitsuba_scene("0.6.0", plugin, parameters);
    case SceneFormat::mitsuba_3:
      return mitsuba_scene("3.0.0", plugin, parameters);
    case SceneFormat::gltf:
      return gltf_scene(plugin, parameters);
    case SceneFormat::obj:
      return obj_scene(plugin, parameters);
  }
  return "";
}

}  // namespace vitrail::test
