// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/machine/presets.hpp"

namespace ridgecraft::paper {
namespace {

constexpr Color black{0x00, 0x00, 0x00};
constexpr Color red{0xff, 0x00, 0x00};
constexpr Color orange{0xff, 0x80, 0x00};
constexpr Color green{0x00, 0xff, 0x00};
constexpr Color blue{0x00, 0x00, 0xff};
constexpr Color violet{0x80, 0x00, 0xff};
// LightBurn takes colours of its own palette for its first layers.
constexpr Color lightburn_green{0x00, 0xe0, 0x00};
constexpr Color lightburn_purple{0xa0, 0x00, 0xa0};

constexpr PathRules dashed{.engraves = true, .dashes = true};
constexpr PathRules dashed_without_words{.engraves = false, .dashes = true};

/// Colours: engraving, mountain, valley, flat base of a tab, inner cut, outer cut.
constexpr std::array table{
    Preset{.name = "lightburn",
           .what = "LightBurn, any laser",
           .colors = {lightburn_green, blue, lightburn_purple, blue, red, black}},
    Preset{.name = "laser",
           .what = "other lasers' programs: red cuts, blue scores, green engraves",
           .dxf = DxfKind::r2000,
           .paths = dashed,
           .colors = {green, blue, blue, blue, red, red},
           .width = 0.01},
    Preset{.name = "glowforge", .what = "Glowforge", .colors = {green, blue, violet, blue, orange, red}},
    Preset{.name = "cricut",
           .what = "Cricut Design Space: one path for each operation",
           .colors = {green, red, blue, red, black, black},
           .width = 0.25,
           .joined = true},
    Preset{.name = "silhouette",
           .what = "Silhouette Studio, whose free edition reads DXF alone",
           .dxf = DxfKind::r12,
           .paths = dashed_without_words,
           .colors = {green, red, blue, red, black, black},
           .width = 0.25},
    Preset{.name = "scanncut",
           .what = "Brother ScanNCut (CanvasWorkspace)",
           .paths = dashed_without_words,
           .colors = {green, red, blue, red, black, black},
           .width = 0.25},
    Preset{.name = "plotter",
           .what = "cutting plotters and CAD",
           .svg = false,
           .dxf = DxfKind::r12,
           .paths = dashed_without_words},
    Preset{.name = "origami-simulator",
           .what = "Origami Simulator: nets without tabs, each fold with its angle",
           .simulates = true}};

}  // namespace

std::span<const Preset> presets() {
  return table;
}

}  // namespace ridgecraft::paper
