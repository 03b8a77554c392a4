// SPDX-License-Identifier: GPL-3.0-or-later
#include "imported_seeds.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace ridgecraft::test {
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
<library_effects><effect id="e"><profile_COMMON><technique sid="c"><lambert><diffuse><color>1 0.5 0 1</color></diffuse></lambert></technique></profile_COMMON></effect></library_effects>
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
