// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/gate/mitsuba_sources.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <span>

#include "tests/conformance/gate/pairs.h"

namespace vitrail::test {

namespace {

// As Mitsuba's spectral variants take them: no raw bitmap of three channels is a colour to them, and no other
// one a number. `text` may have COLOR(name) and NUMBER(name) for parameters, BSDF for what an adapter is
// around, and EMITTER for what a shape gives off.
struct Value {
  const char *name, *text;
};

constexpr std::array bsdfs{
    Value{"diffuse", "<bsdf type='diffuse'>COLOR(reflectance)</bsdf>"},
    Value{"default diffuse", "<bsdf type='diffuse'/>"},
    Value{"dielectric", "<bsdf type='dielectric'/>"},
    Value{
        "water",
        "<bsdf type='dielectric'><string name='int_ior' value='water'/>COLOR(specular_transmittance)</bsdf>"},
    Value{"roughdielectric", "<bsdf type='roughdielectric'><float name='alpha' value='.3'/></bsdf>"},
    Value{"thindielectric", "<bsdf type='thindielectric'/>"},
    Value{"conductor", "<bsdf type='conductor'/>"},
    Value{"gold",
          "<bsdf type='conductor'><string name='material' value='Au'/>COLOR(specular_reflectance)</bsdf>"},
    Value{"roughconductor",
          "<bsdf type='roughconductor'><string name='material' value='Al'/><string name='distribution' "
          "value='ggx'/>NUMBER(alpha)</bsdf>"},
    Value{"brushed",
          "<bsdf type='roughconductor'><float name='alpha_u' value='.1'/><float name='alpha_v' "
          "value='.4'/></bsdf>"},
    Value{"plastic", "<bsdf type='plastic'>COLOR(diffuse_reflectance)</bsdf>"},
    Value{
        "roughplastic",
        "<bsdf type='roughplastic'>COLOR(diffuse_reflectance)<boolean name='nonlinear' value='true'/><float "
        "name='alpha' value='.2'/></bsdf>"},
    Value{"principled",
          "<bsdf type='principled'>COLOR(base_color)NUMBER(roughness)<float name='clearcoat' "
          "value='.6'/><float "
          "name='specular' value='.4'/></bsdf>"},
    Value{"principled metal",
          "<bsdf type='principled'>COLOR(base_color)NUMBER(metallic)<float name='roughness' "
          "value='.4'/></bsdf>"},
    Value{"principled glass",
          "<bsdf type='principled'>COLOR(base_color)<float name='spec_trans' value='.8'/><float "
          "name='roughness' "
          "value='.4'/></bsdf>"},
    Value{"principledthin",
          "<bsdf type='principledthin'>COLOR(base_color)<float name='diff_trans' value='.7'/><float "
          "name='roughness' value='.4'/></bsdf>"},
    Value{"null", "<bsdf type='null'/>"},
};

constexpr std::array adapters{
    Value{"bare", "BSDF"},
    Value{"twosided", "<bsdf type='twosided'>BSDF</bsdf>"},
    Value{"mask", "<bsdf type='mask'>NUMBER(opacity)BSDF</bsdf>"},
    Value{"default mask", "<bsdf type='mask'>BSDF</bsdf>"},
    Value{"blendbsdf",
          "<bsdf type='blendbsdf'>NUMBER(weight)BSDF<bsdf type='diffuse'><rgb name='reflectance' "
          "value='.1,.6,.2'/></bsdf></bsdf>"},
    Value{"blend with null",
          "<bsdf type='blendbsdf'><float name='weight' value='.4'/>BSDF<bsdf type='null'/></bsdf>"},
    Value{
        "mask in a blend",
        "<bsdf type='blendbsdf'><float name='weight' value='.4'/><bsdf type='mask'>NUMBER(opacity)BSDF</bsdf>"
        "<bsdf type='diffuse'/></bsdf>"},
    Value{"two different sides",
          "<bsdf type='twosided'><bsdf type='diffuse'><rgb name='reflectance' value='.1,.6,.2'/></bsdf><bsdf "
          "type='diffuse'>COLOR(reflectance)</bsdf></bsdf>"},
    Value{"bumpmap",
          "<bsdf type='bumpmap'><texture type='bitmap' name='arbitrary'><string name='filename' "
          "value='grey.exr'/><boolean name='raw' value='true'/></texture><float name='scale' "
          "value='.3'/>BSDF</bsdf>"},
    Value{"normalmap",
          "<bsdf type='normalmap'><texture type='bitmap' name='normalmap'><string name='filename' "
          "value='normal.png'/><boolean name='raw' value='true'/></texture>BSDF</bsdf>"},
    Value{"bumpmap on a mask",
          "<bsdf type='bumpmap'><texture type='bitmap'><string name='filename' value='grey.exr'/><boolean "
          "name='raw' value='true'/></texture><bsdf type='mask'><float name='opacity' "
          "value='.6'/>BSDF</bsdf></bsdf>"},
    Value{"bumpmap on a blend",
          "<bsdf type='bumpmap'><texture type='bitmap'><string name='filename' value='grey.exr'/><boolean "
          "name='raw' value='true'/></texture><bsdf type='blendbsdf'><float name='weight' "
          "value='.5'/>BSDF<bsdf "
          "type='diffuse'/></bsdf></bsdf>"},
};

constexpr std::array color_texts{
    Value{"rgb", "<rgb name='NAME' value='.7,.4,.2'/>"},
    Value{"grey", "<rgb name='NAME' value='.5'/>"},
    Value{"number", "<spectrum name='NAME' value='.6'/>"},
    Value{"spectrum", "<spectrum name='NAME' value='400:.2, 550:.8, 700:.3'/>"},
    Value{"bitmap", "<texture type='bitmap' name='NAME'><string name='filename' value='a.png'/></texture>"},
    Value{"linear bitmap",
          "<texture type='bitmap' name='NAME'><string name='filename' value='a.exr'/></texture>"},
    Value{"turned bitmap",
          "<texture type='bitmap' name='NAME'><string name='filename' value='b.png'/><transform "
          "name='to_uv'><rotate z='1' angle='30'/><scale x='2' y='3'/><translate x='.1' "
          "y='.2'/></transform><string name='wrap_mode' value='mirror'/></texture>"},
    Value{"clamped bitmap",
          "<texture type='bitmap' name='NAME'><string name='filename' value='b.png'/><transform "
          "name='to_uv'><scale value='2'/></transform><string name='wrap_mode' value='clamp'/><string "
          "name='filter_type' value='nearest'/></texture>"},
    Value{"checkerboard",
          "<texture type='checkerboard' name='NAME'><rgb name='color0' value='.8,.1,.1'/><transform "
          "name='to_uv'><scale x='3' y='2'/></transform></texture>"},
    Value{"board of bitmaps",
          "<texture type='checkerboard' name='NAME'><texture type='bitmap' name='color1'><string "
          "name='filename' "
          "value='a.png'/></texture></texture>"},
};

constexpr std::array number_texts{
    Value{"number", "<float name='NAME' value='.3'/>"},
    Value{"bitmap",
          "<texture type='bitmap' name='NAME'><string name='filename' value='grey.exr'/><boolean name='raw' "
          "value='true'/></texture>"},
    Value{"8-bit bitmap",
          "<texture type='bitmap' name='NAME'><string name='filename' value='grey.tga'/></texture>"},
    Value{"raw 8-bit bitmap",
          "<texture type='bitmap' name='NAME'><string name='filename' value='grey.tga'/><boolean name='raw' "
          "value='true'/></texture>"},
    Value{"raw colour bitmap",
          "<texture type='bitmap' name='NAME'><string name='filename' value='a.png'/><boolean name='raw' "
          "value='true'/></texture>"},
    Value{"board",
          "<texture type='checkerboard' name='NAME'><float name='color0' value='.8'/><float name='color1' "
          "value='.2'/><transform name='to_uv'><scale value='2'/></transform></texture>"},
};

constexpr const char* lamp_to_world =
    "<transform name='to_world'><scale value='.6'/><rotate y='1' angle='35'/><translate x='-1.2' y='.7' "
    "z='.6'/></transform>";

constexpr std::array emitters{
    Value{"point",
          "<emitter type='point'><point name='position' x='-1.5' y='2' z='3'/><rgb name='intensity' "
          "value='9,8,7'/></emitter>"},
    Value{"spectral point",
          "<emitter type='point'><transform name='to_world'><translate x='1.5' y='2' "
          "z='3'/></transform><spectrum "
          "name='intensity' value='400:2, 600:9, 700:5'/></emitter>"},
    Value{"flat point",
          "<emitter type='point'><point name='position' x='-1.5' y='2' z='3'/><spectrum name='intensity' "
          "value='6'/></emitter>"},
    Value{"number point",
          "<emitter type='point'><point name='position' x='-1.5' y='2' z='3'/><float name='intensity' "
          "value='6'/></emitter>"},
    Value{"spot",
          "<emitter type='spot'><transform name='to_world'><lookat origin='-1.5,2,3' target='0,0,0' "
          "up='0,1,0'/></transform><rgb name='intensity' value='20,18,15'/></emitter>"},
    Value{"textured spot",
          "<emitter type='spot'><transform name='to_world'><lookat origin='-1.5,2,3' target='0,0,0' "
          "up='0,1,0'/></transform><texture type='bitmap' name='texture'><string name='filename' "
          "value='b.png'/></texture><float name='cutoff_angle' value='25'/><float name='beam_width' "
          "value='22'/><rgb name='intensity' value='20,18,15'/></emitter>"},
    Value{
        "directional",
        "<emitter type='directional'><vector name='direction' x='.3' y='-.5' z='-1'/><rgb name='irradiance' "
        "value='2,2.2,2.5'/></emitter>"},
    Value{"constant", "<emitter type='constant'><rgb name='radiance' value='.6,.7,.9'/></emitter>"},
    Value{
        "envmap",
        "<emitter type='envmap'><string name='filename' value='sky.exr'/><transform name='to_world'><rotate "
        "x='1' y='.3' angle='40'/></transform><float name='scale' value='1.5'/></emitter>"},
    Value{"area",
          "<shape type='rectangle'>LAMP<bsdf type='diffuse'/><emitter type='area'><rgb name='radiance' "
          "value='6,5,4'/></emitter></shape>"},
    Value{"bitmap area",
          "<shape type='rectangle'>LAMP<bsdf type='diffuse'/><emitter type='area'><texture type='d65' "
          "name='radiance'><texture type='bitmap' name='nested'><string name='filename' "
          "value='a.png'/></texture><float name='scale' value='9'/></texture></emitter></shape>"},
    Value{"null area",
          "<shape type='rectangle'>LAMP<bsdf type='null'/><emitter type='area'><rgb name='radiance' "
          "value='6,5,4'/></emitter></shape>"},
    Value{"uniform area",
          "<shape type='rectangle'>LAMP<bsdf type='diffuse'/><emitter type='area'><spectrum type='uniform' "
          "name='radiance'><float name='value' value='4'/></spectrum></emitter></shape>"},
    Value{"d65 area",
          "<shape type='rectangle'>LAMP<bsdf type='diffuse'/><emitter type='area'><spectrum type='d65' "
          "name='radiance'><float name='scale' value='5'/></spectrum></emitter></shape>"},
    Value{"directionalarea",
          "<shape type='rectangle'>LAMP<bsdf type='diffuse'/><emitter type='directionalarea'><rgb "
          "name='radiance' "
          "value='6,5,4'/></emitter></shape>"},
    Value{"projector",
          "<emitter type='projector'><transform name='to_world'><lookat origin='-1.5,2,3' target='0,0,0' "
          "up='0,1,0'/></transform><texture type='d65' name='irradiance'><texture type='bitmap' "
          "name='nested'><string name='filename' value='b.png'/></texture></texture><float name='fov' "
          "value='40'/><float name='scale' value='8'/></emitter>"},
    Value{"object shines", ""},
};
constexpr const char* own_emitter = "<emitter type='area'><rgb name='radiance' value='1,.8,.5'/></emitter>";

constexpr const char* tilt = "<rotate x='1' angle='-20'/><rotate y='1' angle='25'/>";
constexpr std::array shape_texts{
    Value{"rectangle",
          "<shape type='rectangle'><transform name='to_world'>TILT</transform>BSDF EMITTER</shape>"},
    Value{"flipped rectangle",
          "<shape type='rectangle'><transform name='to_world'>TILT</transform><boolean name='flip_normals' "
          "value='true'/>BSDF EMITTER</shape>"},
    Value{"mirrored rectangle",
          "<shape type='rectangle'><transform name='to_world'><scale x='-1'/>TILT</transform>BSDF "
          "EMITTER</shape>"},
    Value{"cube",
          "<shape type='cube'><transform name='to_world'><scale value='.7'/>TILT</transform>BSDF "
          "EMITTER</shape>"},
    Value{"obj",
          "<shape type='obj'><string name='filename' value='square.obj'/><transform "
          "name='to_world'>TILT</transform>BSDF EMITTER</shape>"},
    Value{"obj without uv",
          "<shape type='obj'><string name='filename' value='bare.obj'/><transform "
          "name='to_world'>TILT</transform>BSDF EMITTER</shape>"},
    Value{"ply without uv",
          "<shape type='ply'><string name='filename' value='bare.ply'/><transform "
          "name='to_world'>TILT</transform>BSDF EMITTER</shape>"},
    Value{"ply with normals",
          "<shape type='ply'><string name='filename' value='bent.ply'/><transform "
          "name='to_world'>TILT</transform>BSDF EMITTER</shape>"},
    Value{"flat ply with normals",
          "<shape type='ply'><string name='filename' value='bent.ply'/><boolean name='face_normals' "
          "value='true'/><transform name='to_world'>TILT</transform>BSDF EMITTER</shape>"},
    Value{"mirrored ply with normals",
          "<shape type='ply'><string name='filename' value='bent.ply'/><transform name='to_world'><scale "
          "x='-1'/>TILT</transform>BSDF EMITTER</shape>"},
    Value{"instance",
          "<shape type='shapegroup' id='group'><shape type='rectangle'>BSDF</shape></shape><shape "
          "type='instance'><ref id='group'/><transform name='to_world'>TILT</transform></shape>"},
};

const std::array<std::span<const Value>, 6> dimensions{
    {bsdfs, adapters, color_texts, number_texts, emitters, shape_texts}};

void replace_all(std::string& text, std::string_view what, std::string_view with) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size())
    text.replace(at, what.size(), with);
}

// COLOR(name) becomes `parameter` of that name.
void replace_calls(std::string& text, std::string_view call, std::string_view parameter) {
  for (std::size_t at = 0; (at = text.find(call, at)) != std::string::npos;) {
    const std::size_t end = text.find(')', at);
    std::string made(parameter);
    replace_all(made, "NAME", text.substr(at + call.size(), end - at - call.size()));
    text.replace(at, end + 1 - at, made);
  }
}

// What Mitsuba allows no two sides of.
bool transmits(const std::string& bsdf) {
  for (const char* type : {"dielectric'", "null'", "principledthin'", "spec_trans"})
    if (bsdf.find(type) != std::string::npos) return true;
  return false;
}

bool lets_straight(const std::string& text) {
  for (const char* type : {"'thindielectric'", "'mask'", "'null'"})
    if (text.find(type) != std::string::npos) return true;
  return false;
}

constexpr const char* frame =
    "<scene version='3.0.0'>\n<integrator type='INTEGRATOR'><integer name='max_depth' "
    "value='5'/></integrator>\n"
    "<sensor type='perspective'><float name='fov' value='48.5'/><transform name='to_world'><lookat "
    "origin='.2,.4,5' target='0,0,0' up='0,1,0'/></transform><film type='hdrfilm'><integer name='width' "
    "value='32'/><integer name='height' value='32'/><rfilter type='box'/></film></sensor>\n"
    "<emitter type='point'><point name='position' x='.5' y='.5' z='4'/><rgb name='intensity' "
    "value='3'/></emitter>\n"
    "<shape type='rectangle'><transform name='to_world'><scale value='4'/><translate "
    "z='-1.5'/></transform><bsdf "
    "type='diffuse'><rgb name='reflectance' value='.3,.5,.7'/></bsdf></shape>\n"
    "<shape type='rectangle'><transform name='to_world'><scale value='4'/><rotate x='1' "
    "angle='-90'/><translate "
    "y='-1.4'/></transform><bsdf type='diffuse'><rgb name='reflectance' value='.6,.6,.4'/></bsdf></shape>\n"
    "LIGHT\nSHAPE\n</scene>\n";

void write_meshes(const std::filesystem::path& folder) {
  constexpr const char* corners = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n";
  std::ofstream(folder / "square.obj") << corners << "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
  std::ofstream(folder / "bare.obj") << corners << "f 1 2 3\nf 1 3 4\n";
  constexpr const char* head =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float "
      "y\nproperty float z\n";
  constexpr const char* faces = "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
  std::ofstream(folder / "bare.ply") << head << faces << "-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n3 0 1 2\n3 0 2 3\n";
  std::ofstream(folder / "bent.ply")
      << head
      << "property float nx\nproperty float ny\nproperty float nz\nproperty float u\nproperty float v\n"
      << faces << "-1 -1 0 -.3 -.3 .9 0 0\n1 -1 0 .3 -.3 .9 1 0\n1 1 0 .3 .3 .9 1 1\n-1 1 0 -.3 .3 .9 0 1\n"
      << "3 0 1 2\n3 0 2 3\n";
}

// Mitsuba refuses to make a number of a picture of three channels, which ours of 8 bits are.
void write_grey_picture(const std::filesystem::path& file) {
  constexpr int side = 8;
  std::string bytes(18, '\0');  // an uncompressed TGA of one channel, from the top
  bytes[2] = 3, bytes[12] = bytes[14] = side, bytes[16] = 8, bytes[17] = 0x20;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) bytes += static_cast<char>(20 * x + 9 * y + 10);
  bytes += std::string(8, '\0') + "TRUEVISION-XFILE." + '\0';  // by which Mitsuba knows it
  std::ofstream(file, std::ios::binary) << bytes;
}

std::vector<std::size_t> value_counts() {
  std::vector<std::size_t> result;
  for (const auto& values : dimensions) result.push_back(values.size());
  return result;
}

}  // namespace

MitsubaSources::MitsubaSources(const std::filesystem::path& folder) {
  write_meshes(folder);
  write_grey_picture(folder / "grey.tga");
}

std::vector<MitsubaSources::Row> MitsubaSources::rows() const { return rows_of_all_pairs(value_counts()); }

std::string MitsubaSources::name(const Row& row) const {
  std::string text = "file:";
  for (std::size_t d = 0; d < dimensions.size(); ++d)
    text += fmt::format("{}{}", d ? " / " : " ", dimensions[d][row[d]].name);
  return text;
}

void MitsubaSources::write(const Row& row, const std::filesystem::path& file) const {
  const auto value = [&](std::size_t d) { return std::string(dimensions[d][row[d]].text); };
  std::string bsdf = value(1), light = value(4), shape = value(5), text = frame;
  if (bsdf.starts_with("<bsdf type='twosided'>BSDF") && transmits(value(0))) bsdf = "BSDF";
  replace_all(bsdf, "BSDF", value(0));
  replace_calls(bsdf, "COLOR(", value(2));
  replace_calls(bsdf, "NUMBER(", value(3));
  replace_all(shape, "BSDF", bsdf);
  replace_all(shape, "TILT", tilt);
  replace_all(shape, "EMITTER", light.empty() ? own_emitter : "");
  replace_all(light, "LAMP", lamp_to_world);
  replace_all(text, "LIGHT", light);
  replace_all(text, "SHAPE", shape);
  // As in cross_product.cpp.
  replace_all(text, "INTEGRATOR", lets_straight(bsdf + light) ? "volpath" : "path");
  std::ofstream(file) << text;
}

}  // namespace vitrail::test
