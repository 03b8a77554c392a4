// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/machine/presets.hpp"

#include <cstddef>

namespace ridgecraft::export_ {
namespace {

constexpr Color black{0x00, 0x00, 0x00};
constexpr Color red{0xff, 0x00, 0x00};
constexpr Color orange{0xff, 0x80, 0x00};
constexpr Color green{0x00, 0xff, 0x00};
constexpr Color blue{0x00, 0x00, 0xff};
constexpr Color violet{0x80, 0x00, 0xff};
/// Tool layer T1 of LightBurn, which is never cut.
constexpr Color marks{0xf3, 0x69, 0x26};
// LightBurn takes colours of its own palette for its first layers.
constexpr Color lightburn_green{0x00, 0xe0, 0x00};
constexpr Color lightburn_purple{0xa0, 0x00, 0xa0};

constexpr PathRules dashed{.engraves = true, .scores = Scores::dashes};
constexpr PathRules dashed_without_words{.engraves = false, .scores = Scores::dashes};
constexpr PathRules for_beam{.engraves = true, .scores = Scores::solid, .kerf_mm = 0.1};
constexpr PathRules dashed_for_beam{.engraves = true, .scores = Scores::dashes, .kerf_mm = 0.1};

// Of machines whose sheet has one size: the bed of a Glowforge, what a Cricut cuts on its mat of 12 inches,
// and such mats of others, whose rollers need a margin.
constexpr Vec2 glowforge_bed{495.0, 279.0};
constexpr Vec2 cricut_mat{292.0, 292.0};
constexpr Vec2 mat{304.8, 304.8};
constexpr double mat_margin = 6.4;

/// Colours: registration, engraving, mountain, valley, flat base of a tab, inner cut, outer cut.
constexpr std::array table{
    Preset{.name = "lightburn",
           .what = "LightBurn, any laser; kerf is set there",
           .colors = {marks, lightburn_green, blue, lightburn_purple, blue, red, black}},
    Preset{.name = "laser",
           .what = "other lasers' programs: red cuts, blue scores, green engraves",
           .dxf = true,
           .paths = dashed_for_beam,
           .colors = {marks, green, blue, blue, blue, red, red},
           .width = 0.01},
    Preset{.name = "glowforge",
           .what = "Glowforge",
           .paths = for_beam,
           .colors = {marks, green, blue, violet, blue, orange, red},
           .sheet = glowforge_bed},
    Preset{.name = "cricut",
           .what = "Cricut Design Space: one path for each operation",
           .colors = {marks, green, red, blue, red, black, black},
           .width = 0.25,
           .own_marks = true,
           .joined = true,
           .sheet = cricut_mat},
    Preset{.name = "silhouette",
           .what = "Silhouette Studio, whose free edition reads DXF alone",
           .dxf = true,
           .dxf_kind = DxfKind::r12,
           .paths = dashed_without_words,
           .colors = {marks, green, red, blue, red, black, black},
           .width = 0.25,
           .sheet = mat,
           .margin = mat_margin},
    Preset{.name = "scanncut",
           .what = "Brother ScanNCut (CanvasWorkspace)",
           .paths = dashed_without_words,
           .colors = {marks, green, red, blue, red, black, black},
           .width = 0.25,
           .sheet = mat,
           .margin = mat_margin},
    Preset{.name = "plotter",
           .what = "cutting plotters and CAD",
           .svg = false,
           .dxf = true,
           .plt = true,
           .dxf_kind = DxfKind::r12,
           .paths = dashed_without_words},
    Preset{.name = "packaging",
           .what = "packaging shops: cut, crease and glue in inks of their own",
           .svg = false,
           .pdf = true,
           .dxf = true,
           .paths = {.engraves = false},
           .width = 0.25},
    Preset{.name = "origami-simulator",
           .what = "Origami Simulator: nets without tabs, each fold with its angle",
           .fold = true,
           .simulates = true}};

constexpr std::array<std::string_view, operation_count> operation_words{
    "marks", "numbers", "mountain", "valley", "tab", "inner", "cut"};
constexpr std::array<std::string_view, 5> score_words{"solid", "dashes", "perforate", "ends", "none"};

}  // namespace

std::span<const Preset> presets() {
  return table;
}

std::string_view word(Operation operation) {
  return operation_words[static_cast<std::size_t>(operation)];
}

std::string_view word(Scores scores) {
  return score_words[static_cast<std::size_t>(scores)];
}

}  // namespace ridgecraft::export_
