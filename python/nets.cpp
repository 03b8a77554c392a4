// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/nets.hpp"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "base/error.hpp"
#include "export/export.hpp"
#include "job/job.hpp"
#include "python/background.hpp"
#include "python/polygons.hpp"

namespace ridgecraft::python {
namespace {

namespace py = pybind11;

/// Finished nets, with or without pages; every property is a copy.
struct Nets {
  std::shared_ptr<const job::Paper> made;

  [[nodiscard]] const mesh::Surface& surface() const { return made->prepared.model.surface; }
  [[nodiscard]] const unfold::Nets& nets() const { return made->nets; }
};

struct Paper : Nets {
  [[nodiscard]] const paper::Drawing& page(std::size_t number) const {
    if (number >= made->drawings.size()) {
      throw py::index_error(
          fmt::format("there is no page {}; the first of {} is 0", number, made->drawings.size()));
    }
    return made->drawings[number];
  }
  [[nodiscard]] const paper::Mark& mark() const { return made->mark; }
};

/// -1 for none.
template <class Id>
std::int64_t number(Id id) {
  return id.valid() ? std::int64_t{id.value()} : std::int64_t{-1};
}

py::array_t<std::int32_t> faces(const Nets& made) {
  const mesh::Surface& surface = made.surface();
  return filled<std::int32_t>(
      std::array{surface.face_count(), std::size_t{3}}, [&](std::size_t face, std::size_t k) {
        return surface.vertex(mesh::corner(FaceId(face), static_cast<unsigned>(k))).value();
      });
}

py::array_t<std::int32_t> polygons(const Nets& made) {
  const auto& polygon = made.made->prepared.model.polygon;
  return filled<std::int32_t>(std::array{polygon.size()}, [&](std::size_t face, std::size_t /*column*/) {
    const std::uint32_t from = polygon[FaceId(face)];
    return from == mesh::Soup::none ? std::int64_t{-1} : std::int64_t{from};
  });
}

py::array_t<double> flat(const Nets& made) {
  const auto& flat = made.nets().flat;
  return filled<double>(std::array{flat.size(), std::size_t{3}, std::size_t{2}},
                        [&](std::size_t face, std::size_t column) {
                          const Vec2 p = flat[FaceId(face)][column / 2];
                          return column % 2 == 0 ? p.x : p.y;
                        });
}

py::array_t<std::int32_t> of_faces(const auto& ids) {
  return filled<std::int32_t>(std::array{ids.size()}, [&](std::size_t face, std::size_t /*column*/) {
    return number(ids[FaceId(face)]);
  });
}

py::array_t<std::int32_t> edges(const Nets& made) {
  const mesh::Surface& surface = made.surface();
  return filled<std::int32_t>(std::array{surface.edge_count(), std::size_t{2}},
                              [&](std::size_t edge, std::size_t end) {
                                const CornerId side = surface.sides(EdgeId(edge))[0];
                                return surface.vertex(end == 0 ? side : mesh::next(side)).value();
                              });
}

std::vector<std::string> edge_uses(const Nets& made) {
  std::vector<std::string> uses;
  for (const unfold::EdgeUse use : made.nets().use) {
    uses.emplace_back(use == unfold::EdgeUse::fold ? "fold" : use == unfold::EdgeUse::cut ? "cut" : "border");
  }
  return uses;
}

py::array_t<double> fold_angles(const Nets& made) {
  const mesh::Surface& surface = made.surface();
  return filled<double>(std::array{surface.edge_count()}, [&](std::size_t edge, std::size_t /*column*/) {
    return surface.fold_angle(EdgeId(edge));
  });
}

std::vector<std::string> piece_names(const Nets& made) {
  std::vector<std::string> names;
  for (const unfold::Piece& piece : made.nets().pieces) {
    names.push_back(piece.name);
  }
  return names;
}

py::list joins(const Nets& made) {
  py::list joins;
  for (const unfold::Join& join : made.nets().joins) {
    joins.append(py::make_tuple(join.number, join.edge.value(), number(join.tab)));
  }
  return joins;
}

py::list tabs(const Nets& made) {
  py::list tabs;
  for (const unfold::Tab& tab : made.nets().tabs) {
    const auto polygon = filled<double>(std::array{tab.polygon.size(), std::size_t{2}},
                                        [&](std::size_t row, std::size_t column) {
                                          return column == 0 ? tab.polygon[row].x : tab.polygon[row].y;
                                        });
    tabs.append(py::make_tuple(mesh::face_of(tab.side).value(), polygon));
  }
  return tabs;
}

py::dict figures(const Nets& made) {
  const verify::Figures& f = made.made->figures;
  py::dict figures;
  figures["faces"] = f.faces;
  figures["parts"] = made.made->part_count;
  figures["pieces"] = f.pieces;
  figures["pages"] = f.pages;
  figures["overlaps"] = f.overlaps + f.tab_overlaps;
  figures["joins"] = f.joins;
  figures["joins_without_tab"] = f.joins_without_tab;
  figures["tabs"] = f.tabs;
  figures["cut_mm"] = f.cut_mm;
  figures["fold_mm"] = f.fold_mm;
  figures["max_length_error_mm"] = f.max_length_error_mm;
  return figures;
}

using Simplify = std::variant<std::size_t, std::string>;

prepare::SimplifyOptions simplify_of(const Simplify& asked) {
  prepare::SimplifyOptions options;
  if (const std::size_t* const count = std::get_if<std::size_t>(&asked)) {
    constexpr std::size_t fewest_faces = 4;
    if (*count < fewest_faces) {
      throw Error(ErrorKind::usage, fmt::format("simplify takes at least 4 faces, not {}", *count));
    }
    options.mode = prepare::Simplification::count;
    options.faces = *count;
  } else if (const std::string& word = std::get<std::string>(asked); word == "keep") {
    options.mode = prepare::Simplification::keep;
  } else if (word != "auto") {
    throw Error(ErrorKind::usage, "simplify is 'auto', 'keep' or a number of faces, not '" + word + "'");
  }
  return options;
}

prepare::SizeOptions size_of(std::optional<double> size, std::optional<double> scale, bool adapts) {
  if (size && scale) {
    throw Error(ErrorKind::usage, "size and scale exclude each other");
  }
  prepare::SizeOptions options;
  options.adapts = adapts && !size && !scale;
  const auto in_range = [](std::optional<double> value, double low, double high) {
    return !value || (*value >= low && *value <= high);
  };
  if (!in_range(size, 1.0, 100000.0)) {
    throw Error(ErrorKind::usage, fmt::format("size is 1 to 100000 mm, not {}", *size));
  }
  if (!in_range(scale, 1e-12, 1e12)) {
    throw Error(ErrorKind::usage, fmt::format("scale is a number above 0, not {}", *scale));
  }
  options.largest_extent_mm = size.value_or(options.largest_extent_mm);
  options.mm_per_unit = scale;
  return options;
}

unfold::PieceRules rules_of(const std::string& pieces) {
  for (const auto mode : {unfold::PieceMode::few, unfold::PieceMode::parts, unfold::PieceMode::small}) {
    if (pieces == unfold::name(mode)) {
      return unfold::rules_of(mode);
    }
  }
  throw Error(ErrorKind::usage, "pieces is 'few', 'parts' or 'small', not '" + pieces + "'");
}

std::optional<paper::Paper> paper_of(const std::optional<std::string>& name, double margin) {
  if (!name) {
    return std::nullopt;
  }
  paper::Paper paper = paper::parse_paper(*name);
  paper.margin = margin;
  paper::check_paper(paper);
  return paper;
}

py::object make(const py::object& vertices, const py::object& faces, std::optional<double> size,
                std::optional<double> scale, const std::optional<std::string>& sheet, double margin,
                const Simplify& simplify, double concavity, bool whole, const std::string& pieces, bool tabs,
                double tab_height, bool all_tabs, bool unite, bool fold_linear, bool strict,
                const std::string& title, unsigned threads, std::uint64_t seed,
                std::optional<double> time_limit, const py::object& progress) {
  job::Options options;
  options.paper = paper_of(sheet, margin);
  options.size = size_of(size, scale, sheet.has_value());
  options.simplify = simplify_of(simplify);
  options.bodies = unite ? prepare::Bodies::unite : prepare::Bodies::keep;
  options.concavity = concavity;
  if (sheet) {
    options.pieces = rules_of(pieces);
  }
  if (whole) {
    options.parts = job::PartsFrom::components;
    options.panel_cuts = unfold::PanelCuts::before_pieces;
  }
  options.pieces.fold_linear = fold_linear;
  options.tabs.wanted = tabs || all_tabs;
  options.tabs.height_mm = tab_height;
  options.tabs.split_pieces = all_tabs;
  options.strict = strict;
  if (!(tab_height > 0.0) || tab_height > 1000.0) {
    throw Error(ErrorKind::usage,
                fmt::format("tab_height is above 0 and at most 1000 mm, not {}", tab_height));
  }
  const auto mesh = std::make_shared<const Mesh>(mesh_of(vertices, faces));
  auto made = result_in_background(
      [mesh, options, title](const Context& context) {
        mesh::Model model = model_of(*mesh, {}, context);
        model.name = title;
        return std::make_shared<const job::Paper>(job::paper(std::move(model), options, context));
      },
      {threads, seed, time_limit, progress});
  if (sheet) {
    return py::cast(Paper{{std::move(made)}});
  }
  return py::cast(Nets{std::move(made)});
}

/// Bytes or text that takes a while to be written, without the interpreter's lock.
template <class Write>
std::string written(const Write& write) {
  const py::gil_scoped_release unlocked;
  return write();
}

}  // namespace

void add_nets(py::module_& module) {
  using namespace py::literals;
  py::class_<Nets>(module, "Nets",
                   "Nets without overlap, checked. Lengths are millimetres; every array is a copy.")
      .def_property_readonly(
          "vertices", [](const Nets& n) { return array_of(n.surface().points()); },
          "Points of the surface that was unfolded (prepared: scaled, and simplified where asked): n x 3.")
      .def_property_readonly("faces", &faces, "Its triangles, as rows of `vertices`: m x 3.")
      .def_property_readonly(
          "polygons", &polygons,
          "The face of the input that each triangle is part of: m; -1 where preparing made it.")
      .def_property_readonly(
          "part", [](const Nets& n) { return of_faces(n.made->part); }, "The part of each triangle: m.")
      .def_property_readonly(
          "piece", [](const Nets& n) { return of_faces(n.nets().piece); }, "The piece of each triangle: m.")
      .def_property_readonly(
          "flat", &flat,
          "The corners of each triangle in the plane of its piece: m x 3 x 2. The outside is seen, y is up.")
      .def_property_readonly("edges", &edges, "The edges of the surface, as rows of `vertices`: e x 2.")
      .def_property_readonly("edge_uses", &edge_uses,
                             "For each edge 'fold', 'cut' or 'border' (one face only).")
      .def_property_readonly("fold_angles", &fold_angles,
                             "How far the surface is folded along each edge, radians: e. Mountains are "
                             "negative, valleys positive.")
      .def_property_readonly("piece_names", &piece_names, "The name of each piece, as printed.")
      .def_property_readonly(
          "joins", &joins,
          "(number, edge, tab) for each cut: the number is printed on both of its sides, tab is -1 "
          "where there is none.")
      .def_property_readonly(
          "tabs", &tabs,
          "(face, polygon) for each tab: the triangle that it grows from, and its corners in the "
          "plane of that one's piece: k x 2.")
      .def_property_readonly(
          "notes", [](const Nets& n) { return n.nets().notes; }, "Sentences on how the nets were found.")
      .def_property_readonly("figures", &figures, "Counts and lengths, as the check found them.")
      .def_property_readonly(
          "fold", [](const Nets& n) { return n.made->fold; }, "The text of a FOLD file.");
  py::class_<Paper, Nets>(module, "Paper", "Nets on pages.")
      .def_property_readonly(
          "page_count", [](const Paper& p) { return p.made->drawings.size(); }, "How many pages there are.")
      .def(
          "pdf",
          [](const Paper& p) {
            return py::bytes(written([&] { return paper::write_pdf(p.made->drawings, p.mark()); }));
          },
          "All pages as a PDF.")
      .def(
          "svg",
          [](const Paper& p, std::size_t page) {
            const paper::Drawing& drawing = p.page(page);
            return written([&] { return paper::write_svg(drawing, p.mark()); });
          },
          "page"_a, "One page, counted from 0, as an SVG.")
      .def(
          "png",
          [](const Paper& p, std::size_t page, double dots_per_inch) {
            if (!(dots_per_inch >= 1.0) || dots_per_inch > 2400.0) {
              throw Error(ErrorKind::usage, fmt::format("dots_per_inch is 1 to 2400, not {}", dots_per_inch));
            }
            const paper::Drawing& drawing = p.page(page);
            return py::bytes(written([&] { return paper::write_png(drawing, p.mark(), dots_per_inch); }));
          },
          "page"_a, "dots_per_inch"_a = 150.0, "One page, counted from 0, as a PNG.")
      .def(
          "dxf",
          [](const Paper& p, std::size_t page) {
            const paper::Drawing& drawing = p.page(page);
            return written([&] { return paper::write_dxf(drawing, p.mark()); });
          },
          "page"_a, "One page, counted from 0, as a DXF for machines.");
  module.def("make", &make, "vertices"_a, "faces"_a, py::kw_only(), "size"_a, "scale"_a, "sheet"_a,
             "margin"_a, "simplify"_a, "concavity"_a, "whole"_a, "pieces"_a, "tabs"_a, "tab_height"_a,
             "all_tabs"_a, "unite"_a, "fold_linear"_a, "strict"_a, "title"_a, "threads"_a, "seed"_a,
             "time_limit"_a, "progress"_a);
}

}  // namespace ridgecraft::python
