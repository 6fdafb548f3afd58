// SPDX-License-Identifier: Apache-2.0
// One rule for images and tables that a scene names and nobody has: refused with their place, or replaced
// where the user asks for it. Every reader, every kind of record.
#include "importers/reading/missing_files.h"

#include <gmock/gmock.h>

#include "importers/import.h"
#include "importers/readers.h"
#include "tests/importers/temporary_folder.h"

namespace vitrail::missing_files_test {
namespace {

using testing::HasSubstr;

struct Case {
  std::string reader, file, text;
  std::string place;  // of the name of what is missing, "lost.png"
};

std::string pbrt(const std::string& directive) {
  return "Film \"rgb\" WorldBegin\n" + directive + " Shape \"sphere\"\n";
}
std::string mitsuba(const std::string& element) {
  return "<scene version=\"3.0.0\">\n" + element + "<shape type=\"sphere\"/></scene>";
}
std::string bitmap(const std::string& name) {
  return "<texture type=\"bitmap\" name=\"" + name +
         "\"><string name=\"filename\" value=\"lost.png\"/></texture>";
}
std::string gltf(const std::string& slot) {
  return R"({"asset":{"version":"2.0"},"images":[{"uri":"lost.png"}],"textures":[{"source":0}],
"materials":[{)" +
         slot + R"(}],"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)" +
         "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA" + R"("}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],"nodes":[{"mesh":0}],
"scenes":[{"nodes":[0]}],"scene":0})";
}
// COLLADA.
std::string collada(const std::string& image) {
  return R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<library_images><image id="i"><init_from>)" +
         image + R"(</init_from></image></library_images>
<library_effects><effect id="e"><profile_COMMON><newparam sid="s"><surface type="2D"><init_from>i</init_from></surface></newparam>
<newparam sid="u"><sampler2D><source>s</source></sampler2D></newparam><technique sid="t"><phong><diffuse><texture texture="u"
texcoord="UV"/></diffuse></phong></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a" count="9">0 0 0 1 0 0 0 1 0</float_array>
<technique_common><accessor source="#a" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/>
</vertices><triangles count="1" material="m"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh>
</geometry></library_geometries><library_visual_scenes><visual_scene id="w"><node><instance_geometry url="#g"><bind_material>
<technique_common><instance_material symbol="m" target="#m"/></technique_common></bind_material></instance_geometry></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#w"/></scene></COLLADA>)";
}
std::string povray(const std::string& pigment) {
  return "camera { location -3*z }\nsphere { 0 1 pigment {" + pigment + "} }\n";
}

std::vector<Case> cases() {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n",
                    diffuse = "<bsdf type=\"diffuse\" id=\"m\">" + bitmap("reflectance") + "</bsdf>",
                    texture = "Texture \"t\" \"spectrum\" ", file = " \"string filename\" \"lost.png\"";
  std::vector<Case> all{
      {"pbrt", "a.pbrt", pbrt(texture + "\"imagemap\"" + file), "a.pbrt:2:1"},
      {"pbrt", "b.pbrt", pbrt(texture + "\"ptex\"" + file), "b.pbrt:2:1"},
      {"pbrt", "c.pbrt", pbrt("LightSource \"infinite\"" + file), "c.pbrt:2:1"},
      {"pbrt", "d.pbrt", pbrt("LightSource \"goniometric\"" + file), "d.pbrt:2:1"},
      {"pbrt", "e.pbrt", pbrt("LightSource \"projection\"" + file), "e.pbrt:2:1"},
      {"pbrt", "f.pbrt", pbrt("Material \"diffuse\" \"string normalmap\" \"lost.png\""), "f.pbrt:2:1"},
      {"pbrt", "g.pbrt", pbrt("Material \"measured\"" + file), "g.pbrt:2:1"},
      {"pbrt", "h.pbrt",
       pbrt("MakeNamedMedium \"m\" \"string type\" \"nanovdb\"" + file + " MediumInterface \"m\" \"\""),
       "h.pbrt:2:1"},
      {"Mitsuba", "a.xml", mitsuba(diffuse), "a.xml:2:29"},
      {"Mitsuba", "b.xml",
       mitsuba("<emitter type=\"envmap\"><string name=\"filename\" value=\"lost.png\"/></emitter>"),
       "b.xml:2:"},
      {"Mitsuba", "c.xml", mitsuba("<emitter type=\"projector\">" + bitmap("irradiance") + "</emitter>"),
       "c.xml:2:"},
      {"Mitsuba", "d.xml",
       mitsuba("<medium type=\"heterogeneous\" id=\"m\"><volume type=\"gridvolume\" name=\"sigma_t\"><string "
               "name=\"filename\" value=\"lost.png\"/></volume></medium><shape type=\"cube\"><ref id=\"m\" "
               "name=\"interior\"/></shape>"),
       "d.xml:2:"},
      {"Mitsuba", "e.xml",
       mitsuba("<bsdf type=\"diffuse\" id=\"m\"><texture type=\"volume\" name=\"reflectance\"><volume "
               "type=\"gridvolume\" name=\"volume\"><string name=\"filename\" value=\"lost.png\"/></volume>"
               "</texture></bsdf>"),
       "e.xml:2:"},
      {"glTF", "a.gltf", gltf(R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0}})"), "a.gltf:2:"},
      {"glTF", "b.gltf", gltf(R"("normalTexture":{"index":0})"), "b.gltf:2:"},
      {"glTF", "c.gltf", gltf(R"("emissiveFactor":[1,1,1],"emissiveTexture":{"index":0})"), "c.gltf:2:"},
      {"POV-Ray", "a.pov", povray("image_map { png \"lost.png\" }"), "a.pov:2:"},
      {"POV-Ray", "b.pov", "camera { location -3*z }\nheight_field { png \"lost.png\" pigment { rgb 1 } }\n",
       "b.pov:2:"},
      {"FBX, COLLADA and 3DS", "a.dae", collada("lost.png"), "a.dae"},
      {"PLY", "a.ply",
       "ply\nformat ascii 1.0\ncomment TextureFile lost.png\nelement vertex 3\nproperty float x\nproperty "
       "float y\nproperty float z\nproperty float u\nproperty float v\nelement face 1\nproperty list uchar "
       "int vertex_indices\nend_header\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n",
       "a.ply"},
  };
  for (const char* keyword : {"map_Kd", "map_Ks", "map_Ke", "map_d", "map_Pr", "map_Bump", "disp", "norm"})
    all.push_back({"Wavefront OBJ", keyword + std::string(".obj"),
                   "newmtl m\n" + std::string(keyword) + " lost.png\n", keyword + std::string(".mtl:1:1")});
  return all;
}

TEST(MissingFiles, AreRefusedWithTheirPlaceOrReplacedInEveryReader) {
  const TemporaryFolder folder;
  std::set<std::string> readers_seen;
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.file);
    readers_seen.insert(c.reader);
    std::string text = c.text;
    if (c.file.ends_with(".obj")) {
      const std::string library = c.file.substr(0, c.file.size() - 3) + "mtl";
      folder.write(library, c.text);
      text = "mtllib " + library + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n";
    }
    const auto file = folder.write(c.file, text);
    const Reader& reader = reader_of(file);
    EXPECT_EQ(reader.name, c.reader);
    try {
      import_scene(file);
      EXPECT_TRUE(reader.goes_on_without_images) << "it is read";
    } catch (const Error& error) {
      const std::string said = to_string(error.location) + ": " + error.what();
      EXPECT_THAT(said,
                  testing::AllOf(HasSubstr(c.place), HasSubstr("lost.png"), HasSubstr("--missing=replace")));
    }
    const ImportedScene replaced =
        import_scene(file, MeshMemory{}, {}, {.definitions = {}, .replace_missing = true});
    int told = 0;
    for (const Diagnostic& d : replaced.diagnostics)
      if (d.message.find("lost.png") != std::string::npos) {
        EXPECT_EQ(d.fidelity, Fidelity::dropped) << d.message;
        EXPECT_THAT(d.message, HasSubstr("cannot find the file")) << "one wording";
        ++told;
      }
    EXPECT_EQ(told, 1);
    const bool kept_by_name =
        c.file == "h.pbrt" || c.file == "d.xml";  // a medium whose density is not there is nothing
    if (!kept_by_name) {
      EXPECT_NO_THROW(require_images(replaced.scene));
    }
  }
  for (const Reader& reader : readers())
    EXPECT_TRUE(reader.name == "STL" || readers_seen.contains(std::string(reader.name)))
        << reader.name << " names files, and is not tried";
}

TEST(MissingFiles, AreNamedOnceAndNotAllOfMany) {
  const TemporaryFolder folder;
  const auto message = [&](const std::vector<std::string>& images) {
    std::string text;
    for (std::size_t i = 0; i < images.size(); ++i)
      text += "Texture \"t" + std::to_string(i) + "\" \"spectrum\" \"imagemap\" \"string filename\" \"" +
              images[i] + "\"\nMaterial \"diffuse\" \"texture reflectance\" \"t" + std::to_string(i) +
              "\"\nShape \"sphere\"\n";
    try {
      import_scene(folder.write("a.pbrt", "Film \"rgb\" WorldBegin\n" + text));
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message({"a.png", "a.png", "a.png"}), testing::Not(HasSubstr("nor")));
  std::vector<std::string> many;
  for (int i = 0; i < 20; ++i) many.push_back("image" + std::to_string(i) + ".png");
  const std::string said = message(many);
  EXPECT_THAT(said, testing::AllOf(HasSubstr("image7.png"), HasSubstr("nor 12 others"),
                                   testing::Not(HasSubstr("image8.png"))));
}

}  // namespace
}  // namespace vitrail::missing_files_test
