// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/mesh/seeds.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include <fmt/format.h>

namespace ridgecraft::test {
namespace {

/// Buffer views one after the other, as text and as bytes.
struct Buffer {
  std::string bytes;
  std::string views;

  void add(const std::string& part) {
    views += fmt::format("{}{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{}}}", views.empty() ? "" : ",",
                         bytes.size(), part.size());
    bytes += part;
    bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
  }
};

Buffer rich_buffer() {
  Buffer buffer;
  buffer.add(float_bytes({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}));                      // 0: points
  buffer.add(bytes2(0) + bytes2(2) + bytes2(1) + bytes2(0) + bytes2(1) + bytes2(3) +  // 1: corners
             bytes2(1) + bytes2(2) + bytes2(3) + bytes2(0) + bytes2(3) + bytes2(2));
  buffer.add(std::string("\xff\0\0\xff\0\xff\0\xff\0\0\xff\xff\xff\xff\xff\xff", 16));  // 2: colours
  buffer.add(float_bytes({0, 0, 1, 0, 0, 1, 1, 1}));                          // 3: places in the picture
  buffer.add(std::string("\0\1\2\3", 4));                                     // 4: a strip
  buffer.add(tiny_png());                                                     // 5
  buffer.add(std::string("\1\0\0\0", 4));                                     // 6: a sparse place
  buffer.add(float_bytes({2, 0, 0}));                                         // 7: and its value
  buffer.add(std::string(16, '\0'));                                          // 8: joints
  buffer.add(float_bytes({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}));  // 9: their weights
  buffer.add(float_bytes({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}));  // 10: bind matrix
  return buffer;
}

std::string rich_json(const Buffer& buffer, const std::string& uri) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,3]}],
"nodes":[{"name":"left","mesh":0,"translation":[1,2,3],"rotation":[0,0,0.6,0.8],"scale":[2,2,2],"children":[1]},
{"name":"right","mesh":0,"matrix":[-1,0,0,0,0,1,0,0,0,0,1,0,5,0,0,1],"children":[2]},
{"mesh":1,"skin":0},{"name":"strip","mesh":2,"weights":[0.5]}],
"meshes":[{"name":"body","primitives":[{"attributes":{"POSITION":0,"COLOR_0":2},"indices":1,"material":0},
{"attributes":{"POSITION":0,"TEXCOORD_0":3},"indices":1,"material":1}]},
{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":6,"WEIGHTS_0":7},"indices":1}]},
{"weights":[0],"primitives":[{"attributes":{"POSITION":5},"indices":4,"mode":5,"targets":[{"POSITION":0}]},
{"attributes":{"POSITION":5},"indices":4,"mode":6},{"attributes":{"POSITION":0},"mode":0}]}],
"skins":[{"joints":[0],"inverseBindMatrices":8}],"animations":[{}],
"materials":[{"name":"red","pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0.5,1]}},
{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":
{"offset":[0.5,0],"rotation":0.5,"scale":[2,2]}}}}}],
"textures":[{"source":0}],"images":[{"bufferView":5,"mimeType":"image/png"}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"},
{"bufferView":2,"componentType":5121,"normalized":true,"count":4,"type":"VEC4"},
{"bufferView":3,"componentType":5126,"count":4,"type":"VEC2"},
{"bufferView":4,"componentType":5121,"count":4,"type":"SCALAR"},
{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","sparse":{"count":1,
"indices":{"bufferView":6,"componentType":5121},"values":{"bufferView":7}}},
{"bufferView":8,"componentType":5121,"count":4,"type":"VEC4"},
{"bufferView":9,"componentType":5126,"count":4,"type":"VEC4"},
{"bufferView":10,"componentType":5126,"count":1,"type":"MAT4"}],
"bufferViews":[)" +
         buffer.views +
         fmt::format("],\"buffers\":[{{\"byteLength\":{}{}}}]}}", buffer.bytes.size(),
                     uri.empty() ? "" : ",\"uri\":\"" + uri + "\"");
}

}  // namespace

std::string tiny_png() {
  return std::string("\x89PNG\r\n\x1a\n", 8) + std::string("\0\0\0\1IDATxcrcc", 13) +
         std::string("\0\0\0\0IENDcrcc", 12);
}

std::string rich_glb() {
  const Buffer buffer = rich_buffer();
  return glb(rich_json(buffer, {}), buffer.bytes);
}

std::string rich_gltf() {
  const Buffer buffer = rich_buffer();
  return rich_json(buffer, "data:application/octet-stream;base64," + base64(buffer.bytes));
}

std::string rich_model() {
  return R"(<?xml version="1.0" encoding="UTF-8"?>
<model unit="inch" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
 xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02"
 xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06" requiredextensions="m p">
<resources>
<basematerials id="1"><base name="red" displaycolor="#FF0000"/><base name="grey" displaycolor="#808080FF"/></basematerials>
<m:colorgroup id="2"><m:color color="#00FF00"/><m:color color="#0000FF"/></m:colorgroup>
<m:texture2d id="3" path="/3D/Textures/a.png" contenttype="image/png"/>
<m:texture2dgroup id="4" texid="3"><m:tex2coord u="0" v="0"/><m:tex2coord u="1" v="0"/><m:tex2coord u="0" v="1"/></m:texture2dgroup>
<m:compositematerials id="5" matid="1" matindices="0 1"><m:composite values="0.2 0.8"/></m:compositematerials>
<m:multiproperties id="6" pids="1 2"><m:multi pindices="0 1"/></m:multiproperties>
<object id="7" type="model" name="t" pid="1" pindex="1"><mesh><vertices>
<vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/><vertex x="0" y="0" z="1"/>
</vertices><triangles>
<triangle v1="0" v2="2" v3="1"/><triangle v1="0" v2="1" v3="3" pid="2" p1="0" p2="1" p3="1"/>
<triangle v1="1" v2="2" v3="3" pid="4" p1="0" p2="1" p3="2"/><triangle v1="0" v2="3" v3="2" pid="5" p1="0"/>
</triangles></mesh></object>
<object id="8"><components><component objectid="7"/><component objectid="7" transform="-1 0 0 0 1 0 0 0 1 5 0 0"/>
<component p:path="/3D/Objects/b.model" objectid="1"/></components></object>
</resources>
<build><item objectid="8" transform="2 0 0 0 2 0 0 0 2 1 1 1"/><item objectid="7"/></build>
</model>)";
}

ZipFiles rich_parts() {
  return {{"3D/Textures/a.png", tiny_png()},
          {"3D/Objects/b.model",
           "<model><resources><object id=\"1\" name=\"b\"><mesh><vertices>"
           "<vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/>"
           "<vertex x=\"0\" y=\"1\" z=\"0\"/></vertices><triangles>"
           "<triangle v1=\"0\" v2=\"1\" v3=\"2\"/></triangles></mesh></object></resources></model>"}};
}

std::string rich_3mf() {
  return threemf(rich_model(), rich_parts());
}

namespace {

void append(std::string& bytes, std::uint32_t value, int count) {
  for (int i = 0; i < count; ++i) {
    bytes += static_cast<char>(value >> (8 * i) & 0xffU);
  }
}

/// A part of a 3DS file: what it is, how long it is, what is in it.
std::string chunk(std::uint32_t id, const std::string& content) {
  std::string bytes;
  append(bytes, id, 2);
  append(bytes, static_cast<std::uint32_t>(6 + content.size()), 4);
  return bytes + content;
}

}  // namespace

std::string fbx_tower() {
  return R"fbx(; FBX 7.3.0 project file
FBXHeaderExtension:  {
	FBXHeaderVersion: 1003
	FBXVersion: 7300
}
GlobalSettings:  {
	Version: 1000
	Properties70:  {
		P: "UpAxis", "int", "Integer", "",2
		P: "UnitScaleFactor", "double", "Number", "",2.54
	}
}
Objects:  {
	Geometry: 10, "Geometry::", "Mesh" {
		Vertices: *24 {
			a: 0,0,0,2,0,0,2,1,0,0,1,0,0,0,3,2,0,3,2,1,3,0,1,3
		}
		PolygonVertexIndex: *24 {
			a: 0,3,2,-2,4,5,6,-8,0,1,5,-5,1,2,6,-6,2,3,7,-7,3,0,4,-8
		}
		GeometryVersion: 124
		LayerElementMaterial: 0 {
			Version: 101
			Name: ""
			MappingInformationType: "AllSame"
			ReferenceInformationType: "IndexToDirect"
			Materials: *1 {
				a: 0
			}
		}
		Layer: 0 {
			Version: 100
			LayerElement:  {
				Type: "LayerElementMaterial"
				TypedIndex: 0
			}
		}
	}
	Model: 20, "Model::tower", "Mesh" {
		Version: 232
	}
	Material: 30, "Material::stone", "" {
		Version: 102
		ShadingModel: "lambert"
		Properties70:  {
			P: "DiffuseColor", "Color", "", "A",1,0.5,0
		}
	}
}
Connections:  {
	C: "OO",20,0
	C: "OO",10,20
	C: "OO",30,20
}
)fbx";
}

std::string dae_tower() {
  return R"dae(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="centimeter" meter="0.01"/><up_axis>Z_UP</up_axis></asset>
<library_effects><effect id="e"><profile_COMMON><technique sid="c"><lambert><diffuse><color>  1 0.5 0 1 </color></diffuse></lambert></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m" name="stone"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g" name="box"><mesh>
<source id="p"><float_array id="pa" count="24">0 0 0 2 0 0 2 1 0 0 1 0 0 0 3 2 0 3 2 1 3 0 1 3</float_array><technique_common><accessor source="#pa" count="8" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<polylist material="s" count="6"><input semantic="VERTEX" source="#v" offset="0"/><vcount>4 4 4 4 4 4</vcount><p>0 3 2 1 4 5 6 7 0 1 5 4 1 2 6 5 2 3 7 6 3 0 4 7</p></polylist>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n" name="tower"><instance_geometry url="#g"><bind_material><technique_common><instance_material symbol="s" target="#m"/></technique_common></bind_material></instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
)dae";
}

std::string max3ds_tower() {
  constexpr std::array<std::array<float, 3>, 8> points{
      {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, {0, 0, 3}, {2, 0, 3}, {2, 1, 3}, {0, 1, 3}}};
  constexpr std::array<std::array<std::uint32_t, 4>, 6> quads{
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  std::string vertices;
  append(vertices, points.size(), 2);
  for (const auto& point : points) {
    for (const float x : point) {
      append(vertices, std::bit_cast<std::uint32_t>(x), 4);
    }
  }
  std::string faces;
  append(faces, 2 * quads.size(), 2);
  for (const auto& [a, b, c, d] : quads) {
    for (const std::uint32_t corner : {a, b, c, 7U, a, c, d, 7U}) {
      append(faces, corner, 2);
    }
  }
  std::string painted("stone\0", 6);
  append(painted, 2 * quads.size(), 2);
  for (std::uint32_t f = 0; f < 2 * quads.size(); ++f) {
    append(painted, f, 2);
  }
  const std::string mesh =
      chunk(0x4100, chunk(0x4110, vertices) + chunk(0x4120, faces + chunk(0x4130, painted)));
  const std::string colour = chunk(0xa020, chunk(0x0011, std::string("\xff\x80\0", 3)));
  const std::string material = chunk(0xafff, chunk(0xa000, std::string("stone\0", 6)) + colour);
  return chunk(0x4d4d, chunk(0x3d3d, material + chunk(0x4000, std::string("tower\0", 6) + mesh)));
}

}  // namespace ridgecraft::test
