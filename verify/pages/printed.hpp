// SPDX-License-Identifier: GPL-3.0-or-later
// What is printed: the lines of pages in true millimetres, as they stand in SVG and PDF files.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft::verify {

/// What a line is for, as the layer says that it lies in.
enum class PrintedLayer {
  cut,
  mountain,
  valley,
  tab_fold,
  glue,   ///< outlines of what is glued on
  mark,   ///< page furniture: the scale bar, the legend
  label,  ///< numbers of joins, and lines that lead to their edges
  name,   ///< names of pieces
  other,  ///< any other layer of the format: areas of tabs, colours; its lines aren't kept
};

/// How a line looks; people see this and not its layer.
enum class Pattern {
  solid,
  dash_dot,  ///< mountain folds
  dashed,    ///< valley folds
  dotted,    ///< bases of tabs that stay flat
  strange,   ///< none of these
};

/// A line that ink is spent on: lines without width and white ones aren't read.
struct PrintedLine {
  PrintedLayer layer = PrintedLayer::cut;
  Pattern pattern = Pattern::solid;
  std::vector<Vec2> points;  ///< mm from the sheet's lower left corner, y up; at least two. A closed line
                             ///< ends where it begins
};

/// Words that can be read, between the ends of their baseline, mm as in PrintedLine.
struct PrintedText {
  PrintedLayer layer = PrintedLayer::mark;
  std::string words;
  Vec2 from, to;
};

/// One page, as its file draws it.
struct PrintedPage {
  std::string name;                   ///< for messages: "whale-2.svg", "page 2 of whale.pdf"
  Vec2 size;                          ///< of the sheet, mm
  std::optional<std::size_t> number;  ///< which page of how many it says it is, from 1
  std::optional<std::size_t> count;
  std::vector<PrintedLine> lines;
  std::vector<PrintedLine> leaders;  ///< lines of the layer label; letters among them
  std::vector<PrintedText> texts;    ///< of the layers mark, label and name
};

/// All pages of one file.
struct PrintedFile {
  std::string name;
  std::string digest;              ///< hash of the model's bytes that the file bears, or empty
  std::vector<PrintedPage> pages;  ///< in the file's order
  bool whole = false;              ///< holds all pages of a model, as PDF and SVG for Inkscape do
  bool guide = false;              ///< tells how the model is built, and shows no page of nets
  std::string preset;              ///< of the machine that it was made for, or empty
  double thickness_mm = 0.0;       ///< of the board that it was made for; 0 for paper
  std::string defect;              ///< why it can't be checked, a sentence; then there are no pages

  /// Whether its lines should be those of nets: what is cut by machines and what board is cut into isn't, so
  /// none of its pages are read.
  [[nodiscard]] bool shows_nets() const { return !guide && preset.empty() && thickness_mm == 0.0; }
};

/// Whether the bytes claim to be PDF or SVG at all. Any bytes.
[[nodiscard]] bool is_pdf(std::string_view bytes);
[[nodiscard]] bool is_svg(std::string_view bytes);

/// Reads a file of docs/reference/formats.md. It understands what cutters' programs do: paths of straight
/// lines in a layer for each class of line, without transforms and style sheets; or several pages of
/// Inkscape, each in a layer of its own. Never throws for what the bytes hold: what it doesn't understand is
/// a defect, since a line that is overlooked can't be checked. O(size).
[[nodiscard]] PrintedFile read_svg(const std::string& name, std::string_view bytes);

/// The same for PDF, whose layers are optional content and whose lines may be transformed. A guide has no
/// nets, so none of its pages are read, and it isn't whole. Of a file for a machine none are either.
[[nodiscard]] PrintedFile read_pdf(const std::string& name, std::string_view bytes);

}  // namespace ridgecraft::verify
