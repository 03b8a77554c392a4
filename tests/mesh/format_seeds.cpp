// SPDX-License-Identifier: GPL-3.0-or-later
#include "format_seeds.hpp"

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

}  // namespace ridgecraft::test
