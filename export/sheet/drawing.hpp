// SPDX-License-Identifier: GPL-3.0-or-later
// A page as a drawing: typed lines, areas and texts in millimetres. It knows nothing of any file format, and
// a format knows nothing but this.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft::export_ {

/// sRGB, 0 to 255 each.
struct Color {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  friend bool operator==(const Color&, const Color&) = default;
};

/// A look of its own, for lines of pictures.
struct Pen {
  double width = 0.2;  ///< mm
  Color color;
};

/// What a line, an area or a text is for. A format maps each to a layer, a colour, a style.
enum class Layer {
  paint,     ///< the model's colours and pictures; a page without them has no such layer
  tab_fill,  ///< area of a glue tab
  cut,       ///< outline of a piece, its tabs included; holes
  mountain,  ///< fold away from the printed side
  valley,    ///< fold towards the printed side
  tab_fold,  ///< base of a tab
  label,     ///< join numbers
  piece_name,
  mark,     ///< page furniture: scale bar, legend, page number, title
  shadow,   ///< where tabs come to lie behind faces, if that is wanted
  glue,     ///< where pieces are glued that no join connects with this one; pages without have no such layer
  picture,  ///< areas and lines of pictures in the guide, below all else; sheets of pieces have none
};
/// Those that files of sheets have.
inline constexpr int layer_count = 11;
/// Whether files have the layer only where something belongs to it.
[[nodiscard]] constexpr bool is_optional(Layer layer) {
  return layer == Layer::paint || layer == Layer::shadow || layer == Layer::glue;
}
/// Plain identifier, also usable as an XML id: "tab-fill", "cut", ...
[[nodiscard]] std::string_view id(Layer layer);
/// For people: "Tabs", "Cut", "Mountain folds", ...
[[nodiscard]] std::string_view title(Layer layer);

/// Which way the paper is folded at a line; decides its pattern.
enum class Fold {
  none,
  mountain,  ///< away from the viewer
  valley,    ///< towards the viewer
};

/// In which tone a line or a text is drawn, so that it can be seen on what lies below it.
enum class Tone {
  dark,
  light,
};

/// A chain of straight strokes, as its layer looks.
struct Line {
  Layer layer = Layer::cut;
  std::vector<Vec2> points;  ///< at least two
  bool closed = false;
  Fold fold = Fold::none;  ///< of folds, bases of tabs and their samples in the legend
  /// Of a mark: looks like a line of this layer, as samples in the legend do. Of paint: is the halo around
  /// such a line, where its ground is dark here and light there, or, like paint, an edge of the model that
  /// isn't folded.
  Layer like = Layer::mark;
  Tone tone = Tone::dark;
  std::optional<Pen> pen = {};  ///< instead of the layer's look
};

/// A filled polygon, as its layer looks.
struct Area {
  Layer layer = Layer::tab_fill;
  std::vector<Vec2> outline;        ///< closed, simple
  std::optional<Color> color = {};  ///< instead of the layer's
};

/// One line of words around a point.
struct Text {
  Layer layer = Layer::label;
  std::string text;                 ///< UTF-8
  Vec2 centre;                      ///< middle of the text's box
  double height = 2.5;              ///< of capital letters and digits, mm
  double angle = 0.0;               ///< of the baseline, radians, counterclockwise
  bool underlined = false;          ///< a number that is another number upside down
  Tone tone = Tone::dark;           ///< of paint: a halo, whatever stands here
  std::optional<Color> color = {};  ///< instead of that of its layer and tone
  unsigned heading = 0;             ///< 1 for the title of a guide, 2 for what is below it; else 0
};

/// A picture of a guide as it is told to people who don't see it.
struct Figure {
  Box2 place;
  std::string words;
  std::size_t texts_before = 0;  ///< of its group, those that are read before it
};

/// One colour on several polygons, each counterclockwise; of the layer paint. Where polygons meet no ground
/// is seen between them.
struct Fill {
  Color color;
  std::vector<std::vector<Vec2>> polygons;
};

/// A picture; of the layer paint. It is seen where one of the polygons lies, each counterclockwise.
struct Image {
  Box2 place;
  std::uint32_t width = 0;  ///< pixels
  std::uint32_t height = 0;
  std::shared_ptr<const std::string> jpeg;
  std::vector<std::vector<Vec2>> clip;
};

/// All that belongs to one piece; formats keep it together.
struct Group {
  std::string id;  ///< plain identifier, unique on the page: "piece-A"; "page" for furniture
  std::vector<Line> lines;
  std::vector<Area> areas;
  std::vector<Text> texts;
  std::vector<Fill> ground;          ///< the lowest: what may reach under other pieces' colours
  std::vector<Image> images;         ///< over the ground
  std::vector<Fill> fills;           ///< over pictures
  std::vector<Figure> figures = {};  ///< of guides
};

/// One page, millimetres, origin at the lower left corner of the sheet, y up.
struct Drawing {
  Vec2 size{210.0, 297.0};
  std::string title;  ///< the model's name
  int page = 1;       ///< from 1
  int page_count = 1;
  std::vector<Group> groups;
  std::vector<Group> back;  ///< what is printed on the other side of the sheet, as it is seen there
};

/// Whether anything of it belongs to the layer.
[[nodiscard]] bool has_layer(const Group& group, Layer layer);
[[nodiscard]] bool has_layer(const Drawing& page, Layer layer);

/// The page as it has to be drawn for a machine on which 100 mm come out as `measured` mm (x across the
/// sheet, y up): places on both sides shrink and grow about the sheet's middle, and come out where they were
/// meant. The sizes of letters and the widths of lines stay.
[[nodiscard]] Drawing calibrated(Drawing page, Vec2 measured);

}  // namespace ridgecraft::export_
