// SPDX-License-Identifier: Apache-2.0
// Small inputs that fuzzing starts from: fuzz_seeds FOLDER writes FOLDER/FORMAT/*. Scenes are those of
// docs/reference/formats.md: every plugin and parameter.
#include <bit>
#include <cstdint>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>

#include "tests/conformance/formats/feature_cases.h"
#include "tests/fuzz/bundle_seeds.h"
#include "tests/glazing/glazing_files.h"
#include "tests/images/ptex_bytes.h"

namespace vitrail::test {
namespace {

class Seeds {
 public:
  explicit Seeds(std::filesystem::path folder) : folder_(std::move(folder)) {}
  void add(const std::string& format, const std::string& bytes) {
    std::filesystem::create_directories(folder_ / format);
    std::ofstream(folder_ / format / ("own-" + std::to_string(count_[format]++)), std::ios::binary) << bytes;
  }

 private:
  std::filesystem::path folder_;
  std::map<std::string, int> count_;
};

template <class... T>
std::string bytes_of(T... values) {
  std::string bytes;
  (bytes.append(reinterpret_cast<const char*>(&values), sizeof values), ...);
  return bytes;
}

void add_scenes(Seeds& seeds) {
  const std::filesystem::path lists = VITRAIL_FORMATS_DIR;
  const auto add = [&](const char* format, SceneFormat scenes, const char* list) {
    for (const PluginCase& plugin : read_cases(lists / list)) {
      seeds.add(format, host_scene(scenes, plugin, ""));
      for (const std::string& parameter : plugin.parameters)
        seeds.add(format, host_scene(scenes, plugin, parameter));
    }
  };
  add("pbrt", SceneFormat::pbrt_v3, "pbrt-v3.txt");
  add("pbrt", SceneFormat::pbrt_v4, "pbrt-v4.txt");
  add("mitsuba", SceneFormat::mitsuba_06, "mitsuba-0.6.txt");
  add("mitsuba", SceneFormat::mitsuba_3, "mitsuba-3.txt");
  add("gltf", SceneFormat::gltf, "gltf.txt");
  add("obj", SceneFormat::obj, "obj.txt");
}

void add_meshes(Seeds& seeds) {
  seeds.add(
      "obj",
      "mtllib none.mtl\no a\ng b\nv 0 0 0 1\nv 1 0 0 .5 .5 .5\nv 0 1 0\nv 1 1 .1\nvt 0 0\nvt 1 0 0\nvn 0 0 "
      "1\n"
      "usemtl m\ns 1\nf 1/1/1 2/2/1 3/1/1\ns off\nf 1 2 4 3\nf -4// -3// -1//\nf 1//1 2//1 4//1 \\\n 3//1\n");
  seeds.add("obj",
            "v 0 0 0\nv 1 0 0\nv 2 0 1\nv 3 0 1\nvp .1 .2\ncstype bspline\ndeg 3\ncurv 0 1 1 2 3 4\n"
            "parm u 0 0 0 0 1 1 1 1\nend\nl 1 2 3\np 1 2\n");
  seeds.add("obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n");
  seeds.add(
      "mtl",
      "newmtl a\nKa .1 .1 .1\nKd .5 .4 .3\nKs spectral file.rfl 1\nKe 1 1 1\nTf xyz .1 .2 .3\nNs 30\nNi "
      "1.5\nd .5\n"
      "Tr .3\nillum 2\nsharpness 60\nmap_Kd -s 2 2 1 -o .1 .2 -t 0 0 -mm 0 1 -clamp on -blendu off a.png\n"
      "map_Bump -bm .5 -imfchan r b.png\nnorm n.png\ndisp d.png\nrefl -type sphere e.png\nmap_d o.png\n"
      "newmtl b\nPr .3\nPm 1\nPs .2\nPc .5\nPcr .1\naniso .3\nanisor .1\nmap_Pr r.png\nmap_Ke e.png\n");
  const std::string header =
      "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
      "property uchar green\nproperty uchar blue\nelement face 1\nproperty list uchar int vertex_indices\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n";
  std::string rows;
  for (const float i : {0.F, 1.F, 2.F, 3.F})
    rows += bytes_of(i, i * i, 0.F, std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{3});
  rows += bytes_of(std::uint8_t{4}, 0, 1, 2, 3, 5, 0, 1, 2, -1, 3);
  seeds.add("ply", "ply\nformat binary_little_endian 1.0\n" + header + rows);
  seeds.add("ply", "ply\nformat binary_big_endian 1.0\n" + header + rows);
  seeds.add("ply", "ply\nformat ascii 1.0\ncomment a\nobj_info b\n" + header +
                       "0 0 0 1 2 3\n1 0 0 1 2 3\n0 1 0 1 2 3\n1 1 .5 1 2 3\n4 0 1 2 3\n5 0 1 2 -1 3\n");
  seeds.add(
      "ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
      "property float nx\nproperty float ny\nproperty float nz\nproperty float u\nproperty float v\n"
      "property float face_area\nelement face 1\nproperty list uint8 uint32 vertex_index\n"
      "property ushort face_id\nend_header\n0 0 0 0 0 1 0 0 .1\n1 0 0 0 0 1 1 0 .2\n0 1 0 0 0 1 0 1 .3\n3 0 "
      "1 2 7\n");
  seeds.add(
      "ply",
      "\xef\xbb\xbfply\nformat ascii 1.0\ncomment TextureFile a.png\nelement vertex 4\nproperty float x\n"
      "property float y\nproperty float z\nelement face 2\nproperty list uchar int vertex_indices\n"
      "property list uchar float texcoord\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
      "3 0 1 2 6 0 0 .5 0 nan 1\n4 0 1 2 3 2 0 0\n");
  seeds.add("obj",
            "v 0 0 0 1 0 0\nv 1 0 0 .5 0 0 2\nv 0 1 0\nv 1 1 1\nvn 0 -1.#IND 1\ns 1\nf 1//1 2//1 3//1\ns "
            "2\nf 2 3 4\n");
  seeds.add("stl",
            "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
            "endloop\nendfacet\nendsolid a\n");
  const std::string corners = bytes_of(0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F),
                    triangle = bytes_of(0, 1, 2);
  seeds.add("stl", std::string(80, ' ') + bytes_of(std::uint32_t{1}, 0.F, 0.F, 1.F) + corners +
                       bytes_of(std::uint16_t{0}));
  const std::string counts = bytes_of(std::uint64_t{3}, std::uint64_t{1});
  seeds.add("serialized", "\3" + bytes_of(0x1000) + counts + corners + triangle);
  seeds.add("serialized", "\4" + bytes_of(0x101B) + std::string("name\0", 5) + counts + corners + corners +
                              std::string(24, '\0') + corners + triangle);
  seeds.add("serialized",
            "\4" + bytes_of(0x2000) + std::string("n\0", 2) + counts + std::string(72, '\0') + triangle);
}

// Something of each part of the language, and of each kind of object.
void add_povray(Seeds& seeds) {
  seeds.add("povray", R"pov(#version 3.7; global_settings { assumed_gamma 1 max_trace_level 5 }
#declare A = array[2][2] {{1,2},{3,4}}; #local S = seed(1);
#macro M(P, Q) #ifdef (Q) #declare Q = P + rand(S); #else P*<1,2,3> #end #end
#for (I, 1, 3) #switch (I) #case (1) sphere { I*x, 0.5 } #break #range (2,3) box { 0, I } #break #else #error "e" #end #end
#declare N = 0; #while (N < 3) #declare N = N + 1; #if (N = 2 & !0 | 1 > 2) #break #elseif (N) #warning "w" #end #end
#fopen F "t.inc" write #write (F, "sphere{", str(1.5,0,2), ",", vstr(3, x, ",", 0, 1), "}") #fclose F
#ifndef (Z) M(2, N) #declare Z = M(2, Q_); #undef Z #end
#declare T = spline { natural_spline 0,<0,0,0> 1,<1,2,3> 2,<5,5,5> }
#declare V = vaxis_rotate(vnormalize(T(0.5)), y, 30) + vcross(x, y)*vlength(z) + (A[1][0] ? 1 : 2);
#declare W = concat("a", chr(66), substr("abc", 1, 2), strupr("x")); #debug W)pov");
  seeds.add(
      "povray",
      R"pov(camera { orthographic location <0,1,-4> look_at 0 right x*image_width/image_height angle 40 }
light_source { <1,2,3>, rgb 2 spotlight radius 10 falloff 20 point_at z area_light x, y, 3, 3 fade_distance 2 fade_power 2 }
#declare P = function { pigment { gradient x color_map { [0 rgb 0] [1 rgbft <1,0,0,.1,.2>] } warp { black_hole x, 1 } } }
#declare G = function(a,b) { select(a, b, sin(a)*0, max(a,b,1)) + P(a,b,0).red }
#declare O = difference { box { -1, 1 } sphere { 0, 1.2 } plane { y, 0 inverse } clipped_by { sphere { 0, 3 } } }
#declare H = trace(O, -3*z, z, K); #if (inside(O, H)) object { O translate min_extent(O) } #end
union { cylinder { 0, y, .5 open } cone { 0, 1, y, .2 } disc { 0, z, 1, .5 } torus { 1, .2 } rotate 30*y
  texture { pigment { brick rgb 1, rgb x brick_size 2 mortar .1 turbulence .3 } normal { bumps .5 scale .1 }
  finish { phong 1 reflection { .1, .5 fresnel } ambient .2 } } interior { ior 1.5 fade_distance 1 fade_power 2 } })pov");
  seeds.add(
      "povray",
      R"pov(mesh2 { vertex_vectors { 3, 0, x, y } uv_vectors { 3, 0, u, v } face_indices { 1, <0,1,2> } uv_indices { 1, <0,1,2> } }
mesh { triangle { 0, x, y } smooth_triangle { 0, z, x, z, y, z } inside_vector y } polygon { 4, 0, x, x+y, y }
prism { 0, 1, 4, 0, x, y, 0 } lathe { cubic_spline 4, x, x+y, y, 2*y } sor { 4, x, x+y, 2*y+x, 3*y })pov");
  seeds.add(
      "povray",
      R"pov(blob { threshold .6 sphere { 0, 1, 1 } cylinder { 0, x, 1, 1 } } isosurface { function { x*x + y*y + z - .5 } contained_by { box { -1, 1 } } })pov");
  seeds.add(
      "povray",
      R"pov(bicubic_patch { type 1 flatness 0 u_steps 2 v_steps 2 0,x,2*x,3*x, y,x+y,2*x+y,3*x+y, 2*y,x+2*y,2*x+2*y,3*x+2*y, 3*y,x+3*y,2*x+3*y,3*x+3*y }
superellipsoid { <.5,.5> } quadric { <1,1,1>, 0, 0, -1 } ovus { 1, .5 })pov");
  seeds.add(
      "povray",
      R"pov(#declare F = function { f_torus(x, y, z, 1, .4) + f_noise3d(x, y, z)*pow(sin(x), 2) + select(y, atan2(x, z), mod(z, 2)) }
#declare R = function { transform { rotate 30*y } } #declare P = function { pattern { crackle solid } }
plane { y, 0 double_illuminate pigment { function { F(x, y, z) + P(x, y, z) } color_map { [0 rgb -.5] [1 rgbt <1,0,0,.5>] } }
  normal { average normal_map { [1 ripples .3 slope_map { [0 <0,1>] [1 <1,0>] }] [2 wrinkles .2 scale .3] } } }
sphere { 0, 1 hollow pigment { rgbt 1 } interior { media { absorption .1 emission .2 scattering { 3, .1 eccentricity .2 extinction .5 }
  density { spherical density_map { [0 rgb 0] [1 rgb 1] } } } } }
box { -1, 1 texture { slope { y, .2, .8 altitude y, 0, 2 } texture_map { [0 pigment { julia <.3,.4>, 20 interior 1,3 exterior 5,1 }]
  [1 pigment { object { sphere { 0, 1 } rgb 0, rgb 1 } }] } } }
fog { fog_type 2 distance 5 fog_offset 1 fog_alt 2 up z turbulence .2 turb_depth .5 rgbft <.5,.5,.6,.3,.2> })pov");
  seeds.add(
      "povray",
      R"pov(declare Q = 0; version 3.6; #default { pigment { square rgb 1 } finish { ambient 1 } } #declare L = array[1] {0};
#declare U = union { sphere { 0, 1 } box { 0, 1 pigment { triangular pigment { rgb x } } } pigment { pavement number_of_sides 3 form 0 } }
#while (Q < 3) #declare U = union { object { U finish { ambient .5 } } object { U translate -!+Q*x } } #declare L[0] = L; #declare Q = Q + 1; #end
union { object { U } texture { checker texture { pigment { wood turbulence .3 warp { turbulence .2 } } } } } #if (Q ? 1 : 0 ? 2 : 3) #debug concat(concat("a", "b"), "c") #end)pov");
  seeds.add(
      "povray",
      R"pov(height_field { function 4, 4 { pattern { bozo } } } sky_sphere { pigment { gradient y color_map { [0 rgb 1] [1 rgb z] } } } background { rgb 1 })pov");
}

// With something of all that is read, and a .glb around it.
void add_gltf(Seeds& seeds) {
  const std::string text = R"gltf({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1,2,3]}],
"extensionsUsed":["KHR_lights_punctual","EXT_mesh_gpu_instancing"],
"extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot","intensity":9,"color":[1,0.5,0],"range":3,"spot":{"innerConeAngle":0.1}}]}},
"nodes":[{"mesh":0,"translation":[1,2,3],"rotation":[0,0,0,1],"scale":[1,-1,1],"children":[4]},{"camera":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,9,1]},
{"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":0,"SCALE":0}}}},{"mesh":1,"skin":0,"weights":[0.5]},{"extensions":{"KHR_lights_punctual":{"light":0}}}],
"skins":[{"joints":[0,4]}],"animations":[],
"cameras":[{"type":"perspective","perspective":{"yfov":1,"aspectRatio":1.5,"znear":0.1}}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":1,"material":0}]},
{"primitives":[{"attributes":{"POSITION":0,"NORMAL":0,"COLOR_0":3,"JOINTS_0":4,"WEIGHTS_0":3},"mode":5,"targets":[{"POSITION":0}],"material":1}]}],
"images":[{"uri":"data:image/png;base64,iVBORw0KGgo="},{"bufferView":0,"mimeType":"image/png"}],"samplers":[{"wrapS":33071,"magFilter":9728}],
"textures":[{"source":0,"sampler":0},{"source":1}],
"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0.25,0.5],"metallicFactor":0.5,"roughnessFactor":0.3,"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":{"offset":[0,1],"rotation":1,"scale":[2,2]}}},"metallicRoughnessTexture":{"index":1,"texCoord":1}},
"normalTexture":{"index":0,"scale":2},"occlusionTexture":{"index":0},"emissiveTexture":{"index":1},"emissiveFactor":[1,1,1],"alphaMode":"MASK","alphaCutoff":0.3,"doubleSided":true},
{"alphaMode":"BLEND","extensions":{"KHR_materials_transmission":{"transmissionFactor":0.5,"transmissionTexture":{"index":0}},"KHR_materials_volume":{"thicknessFactor":1,"attenuationDistance":2,"attenuationColor":[1,0.5,0.2]},"KHR_materials_ior":{"ior":1.4},"KHR_materials_clearcoat":{"clearcoatFactor":1,"clearcoatRoughnessFactor":0.1},"KHR_materials_sheen":{"sheenColorFactor":[1,0,0]},"KHR_materials_specular":{"specularFactor":0.5},"KHR_materials_anisotropy":{"anisotropyStrength":0.5},"KHR_materials_dispersion":{"dispersion":1},"KHR_materials_emissive_strength":{"emissiveStrength":3},"KHR_materials_unlit":{}}}],
"buffers":[{"byteLength":92,"uri":"data:application/octet-stream;base64,AACAvwAAAAAAAIA/AACAPwAAAAAAAIA/AACAPwAAAAAAAIC/AACAvwAAAAAAAIC/AAABAAIAAAACAAMAAAAAAAAAgD8AAIA/AACAPwAAgD8AAAAAAAAAAAAAAAA="}],
"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12},{"buffer":0,"byteOffset":60,"byteLength":32},{"buffer":0,"byteLength":64}],
"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":4},{"bufferView":1,"componentType":5123,"type":"SCALAR","count":6},{"bufferView":2,"componentType":5126,"type":"VEC2","count":4},
{"bufferView":3,"componentType":5126,"type":"VEC4","count":4},{"componentType":5121,"type":"VEC4","count":4,"sparse":{"count":1,"indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":0}}}]})gltf";
  seeds.add("gltf", text);
  const auto length = static_cast<std::uint32_t>(text.size());
  seeds.add("gltf", "glTF" + bytes_of(std::uint32_t{2}, 20 + length, length) + "JSON" + text);
}

// A table of two nodes, and one of four and three channels.
std::string fourier(int nodes, int channels) {
  const int pairs = nodes * nodes;
  std::string bytes =
      "SCATFUN\1" + bytes_of(1, nodes, pairs * channels, 1, channels, 1, 0, 0, 0, 1.5F, 0, 0, 0, 0);
  for (int i = 0; i < nodes; ++i)
    bytes += bytes_of(-1 + 2.F * static_cast<float>(i) / static_cast<float>(nodes - 1));
  bytes.append(static_cast<std::size_t>(4 * pairs), '\0');
  for (int i = 0; i < pairs; ++i) bytes += bytes_of(i * channels, 1);
  for (int i = 0; i < pairs * channels; ++i) bytes += bytes_of(.1F);
  return bytes;
}

std::string tensors() {
  struct Field {
    std::string name;
    std::uint8_t type;
    std::vector<std::uint64_t> shape;
    std::string values;
  };
  const std::string four = bytes_of(1.F, 2.F, 3.F, 4.F);
  const std::vector<Field> fields{{"phi_i", 10, {1}, bytes_of(0.F)},
                                  {"theta_i", 10, {1}, bytes_of(0.F)},
                                  {"wavelengths", 10, {2}, bytes_of(400.F, 700.F)},
                                  {"ndf", 10, {2, 2}, four},
                                  {"sigma", 10, {2, 2}, four},
                                  {"vndf", 10, {1, 1, 2, 2}, four},
                                  {"luminance", 10, {1, 1, 2, 2}, four},
                                  {"spectra", 10, {1, 1, 2, 2, 2}, four + four},
                                  {"jacobian", 1, {1}, "\1"}};
  std::uint64_t at = 18;
  for (const Field& f : fields) at += 13 + f.name.size() + 8 * f.shape.size();
  std::string head =
                  std::string("tensor_file\0\1\0", 14) + bytes_of(static_cast<std::uint32_t>(fields.size())),
              body;
  for (const Field& f : fields) {
    head += bytes_of(static_cast<std::uint16_t>(f.name.size())) + f.name +
            bytes_of(static_cast<std::uint16_t>(f.shape.size())) + bytes_of(f.type) +
            bytes_of(at + body.size());
    for (const std::uint64_t n : f.shape) head += bytes_of(n);
    body += f.values;
  }
  return head + body;
}

std::string volume(int nx, int channels) {
  std::string bytes = "VOL\3" + bytes_of(1, nx, 2, 2, channels, 0.F, 0.F, 0.F, 1.F, 1.F, 1.F);
  for (int i = 0; i < 4 * nx * channels; ++i) bytes += bytes_of(static_cast<float>(i % 3) - .5F);
  return bytes;
}

void add_tables(Seeds& seeds) {
  seeds.add("fourier", fourier(2, 1));
  seeds.add("fourier", fourier(4, 3));
  seeds.add("tensors", tensors());
  seeds.add("ptex",
            test::ptex_bytes(test::PtexType::uint8, 3,
                             {{0, 0, "abc"},
                              {1, 0, "abc", test::PtexEncoding::zipped, test::zipped("aabbcc")},
                              {1, 0, "abc", test::PtexEncoding::differences, test::zipped("aabbcc")}}));
  seeds.add("volume", volume(2, 1));
  seeds.add("volume", volume(3, 3));
  seeds.add("curves", "c0 0 0 .1\n.3 .3 0 .1\n.6 .3 0 .1\n1 0 0 .1\n\n0 0 1 1\n0 1 1 1\n0 2 1 1\n0 3 1 0\n");
  seeds.add("curves", "h# hair\n0 0 0\n.3 .3 0\n.6 .3 0\n\n0 0 1\n0 1 1\n");
  seeds.add("curves",
            "hBINARY_HAIR" + bytes_of(4, 0.F, 0.F, 0.F, 0.F, 1.F, 0.F, std::numeric_limits<float>::infinity(),
                                      1.F, 0.F, 0.F, 1.F, 1.F, 0.F));
  seeds.add("lens", "29 2 1.6 20\n0 1 0 15\n-29 2 1 20\n");
  seeds.add("lens",
            "# a doublet\n85.5 11.6 1 76\n0 2 0 70.6 -42 11 1.67 58 185 1 1 58\n-185 6 1.5 53\n-42 3 1 53");
  seeds.add("spectrum", "# samples\n400 .1\n500, .2; 600 .3\n500 .25\n");
  seeds.add("spectrum",
            "wavelength_nm angle_deg R T\n700 0 .1 .8\n700 60 .2 .7\n400 0 .1 .95\n400 60 .2 .7 # last\n");
  for (const char* attributes :
       {"value='.5'", "n='1.5' kappa='2'", "n='1.5' k='2'", "k='.3' s='.5'", "x='.1' y='.2' z='.3'"})
    seeds.add("spectrum", std::string("<spectrum><entry wavelength='400' ") + attributes +
                              "/><entry wavelength='500' " + attributes + "/></spectrum>");
  for (const std::string& text : {igsdb_text, optics_text, table_text, index_text, idf_text, epjson_text})
    seeds.add("glazing", text);
  for (const char* foreign :
       {"IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 3 1 1 2 0.2 0.2 0\n1 1 100\n0 45 90\n0\n1000 707 0\n",
        "own\n1\n1\n1\n0\n3\n45\nreport\nlamp\n", "LOCATION,Own,-,-,own,0,48.86,2.35,1.0,40\n",
        "<?xml "
        "version=\"1.0\"?>\n<WindowElement><WindowElementType>System</WindowElementType></WindowElement>",
        "void glass pane\n0\n0\n3 .9 .9 .9\n"})
    seeds.add("glazing", foreign);
  seeds.add("glazing",
            R"({"name": "unit", "layers": [{"pane": "glazing.json", "flipped": true,
 "heat": {"thickness_mm": 6, "emissivity_back": 0.04}}, {"gap_mm": 12.7, "gas": {"argon": 0.9, "air": 0.1}},
 {"stack": [{"index": 1.46, "thickness_nm": 90}, {"index": 1.5, "thickness_mm": 4}]}]})");
}

// Hours of EPW, and of WEA behind a `w`.
void add_weather(Seeds& seeds) {
  const std::string head =
      "LOCATION,Own,-,-,own,0,48.86,2.35,1.0,40\nDESIGN CONDITIONS,0\n"
      "DATA PERIODS,1,1,Data,Sunday, 1/ 1,12/31\n";
  const std::string after = ",0,2,5,5,20,77777,9,999999999,10,0.1,0,88,0.2,0,0\n";
  const std::string before = ",60,?,10,5,70,101325,0,0,300,";
  seeds.add("weather", head + "2001,6,21,12" + before + "0,600,300,90000,60000,33000,9999" + after +
                           "2001,6,21,13" + before + "0,9999,210,999999,999999,999999,9999" + after +
                           "2001,6,21,14" + before + "0,10,210,999999,999999,999999,9999" + after);
  seeds.add("weather", head + "2001,6,21,13" + before + "0,0,20,999900,999900,999900,9999" + after);
  seeds.add("weather",
            "wplace own\nlatitude -33.9\nlongitude -18.4\ntime_zone -30\nsite_elevation 40.0\n"
            "weather_data_file_units 1\n6 21 11.500 600 300\n6 21 12.500 0 210\n6 21 13.500 9999 0\n");
}

// Behind the number of the format (fuzz_image.cpp).
void add_images(Seeds& seeds) {
  const auto byte = [](int value) { return std::string(1, static_cast<char>(value)); };
  seeds.add("image",
            byte(0) + "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\x10\x20\x30\x80\x10\x20\x30\x80");
  seeds.add("image", byte(2) + "GIF89a" +
                         bytes_of(std::uint16_t{1}, std::uint16_t{1}, std::uint8_t{0x80}, std::uint8_t{0},
                                  std::uint8_t{0}) +
                         std::string("\0\0\0\xff\xff\xff,\0\0\0\0\1\0\1\0\0\2\2D\1\0;", 22));
  seeds.add("image", byte(3) + "PF\n1 1\n-1\n" + bytes_of(0.1F, 0.2F, 0.3F));
  seeds.add("image", byte(5) + std::string("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\x18\0\1\2\3", 21));
}

}  // namespace
}  // namespace vitrail::test

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: fuzz_seeds FOLDER\n";
    return 2;
  }
  vitrail::test::Seeds seeds(argv[1]);
  vitrail::test::add_scenes(seeds);
  vitrail::test::add_meshes(seeds);
  vitrail::test::add_gltf(seeds);
  vitrail::test::add_povray(seeds);
  vitrail::test::add_tables(seeds);
  vitrail::test::add_weather(seeds);
  vitrail::test::add_images(seeds);
  vitrail::test::add_bundle_seeds(
      [&](const char* format, const std::string& bytes) { seeds.add(format, bytes); });
  return 0;
}
