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

constexpr PathRules solid{};
constexpr PathRules dashed{.engraves = true, .dashes = true};
constexpr PathRules dashed_without_words{.engraves = false, .dashes = true};

/// Colours: engraving, mountain, valley, tab (never used: as its fold), inner cut, outer cut.
constexpr std::array table{
    Preset{"lightburn", "LightBurn, any laser", true, std::nullopt, solid,
           {lightburn_green, blue, lightburn_purple, blue, red, black}, 0.1, false},
    Preset{"laser", "other lasers' programs: red cuts, blue scores, green engraves", true, DxfKind::r2000,
           dashed, {green, blue, blue, blue, red, red}, 0.01, false},
    Preset{"glowforge", "Glowforge", true, std::nullopt, solid, {green, blue, violet, blue, orange, red}, 0.1,
           false},
    Preset{"cricut", "Cricut Design Space: one path for each operation", true, std::nullopt, solid,
           {green, red, blue, red, black, black}, 0.25, true},
    Preset{"silhouette", "Silhouette Studio, whose free edition reads DXF alone", true, DxfKind::r12,
           dashed_without_words, {green, red, blue, red, black, black}, 0.25, false},
    Preset{"scanncut", "Brother ScanNCut (CanvasWorkspace)", true, std::nullopt, dashed_without_words,
           {green, red, blue, red, black, black}, 0.25, false},
    Preset{"plotter", "cutting plotters and CAD", false, DxfKind::r12, dashed_without_words,
           {green, red, blue, red, black, black}, 0.1, false}};

}  // namespace

std::span<const Preset> presets() {
  return table;
}

}  // namespace ridgecraft::paper
