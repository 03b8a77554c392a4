// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/nets.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "base/error.hpp"
#include "base/option_table.hpp"
#include "export/export.hpp"
#include "job/asked_options.hpp"
#include "job/job.hpp"
#include "mesh/mesh.hpp"
#include "python/background.hpp"
#include "python/polygons.hpp"
#include "session/project_file.hpp"
#include "session/session.hpp"

namespace ridgecraft::python {
namespace {

namespace py = pybind11;

/// Finished nets, with or without pages; every property is a copy.
struct Nets {
  std::shared_ptr<const job::Result> made;

  [[nodiscard]] const mesh::Surface& surface() const { return made->prepared.model.surface; }
  [[nodiscard]] const unfold::Nets& nets() const { return made->nets; }
};

struct Paper : Nets {
  [[nodiscard]] const export_::Drawing& page(std::size_t number) const {
    if (number >= made->drawings.size()) {
      throw py::index_error(
          fmt::format("there is no page {}; the first of {} is 0", number, made->drawings.size()));
    }
    return made->drawings[number];
  }
  [[nodiscard]] const export_::Mark& mark() const { return made->mark; }
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

/// The option of this keyword, or null.
const Option* option_of(const std::string& keyword) {
  const auto& table = option_table();
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const Option& row) { return row.keyword == keyword; });
  return found == table.end() || keyword.empty() ? nullptr : &*found;
}

/// A number, a word or a length: what a command line would say.
std::string text_of(const Option& row, const py::handle& value) {
  if (!py::isinstance<py::bool_>(value)) {
    return py::str(value);
  }
  // tabs=True, tabs=False
  if (std::ranges::none_of(row.choices, [](const OptionChoice& choice) { return choice.word == "none"; })) {
    throw py::type_error(fmt::format("{} is neither True nor False", row.keyword));
  }
  return value.cast<bool>() ? std::string(row.usual) : "none";
}

/// Takes the options out of keyword arguments, as a command line would name them; None is as if not given.
job::AskedOptions asked_of(const py::dict& keywords) {
  job::AskedOptions asked(job::Naming::keywords);
  for (const auto& [key, value] : keywords) {
    const Option* const row = option_of(key.cast<std::string>());
    if (row == nullptr) {
      throw py::type_error("there is no option '" + key.cast<std::string>() + "'");
    }
    if (value.is_none()) {
      continue;
    }
    job::AskedOptions::Typed& typed = asked.typed(row->name);
    if (row->kind == OptionKind::flag) {
      typed.flag = value.cast<bool>();
      typed.off = !typed.flag;
    } else if (row->kind == OptionKind::list) {
      typed.texts = py::isinstance<py::str>(value) ? std::vector{value.cast<std::string>()}
                                                   : value.cast<std::vector<std::string>>();
    } else {
      typed.text = text_of(*row, value);
    }
  }
  return asked;
}

/// What the arguments mean that are no options of the table.
struct Making {
  bool pages = true;
  bool whole = false;  ///< each component is one part
  std::string title;
};

job::Options options_of(const py::dict& keywords, const Making& making) {
  job::AskedOptions asked = asked_of(keywords);
  if (!making.pages && !asked.given("tabs") && !asked.flag("all-tabs")) {
    asked.typed("tabs").text = "none";
  }
  job::Options usual;
  usual.size.adapts = making.pages;
  if (!making.pages) {
    usual.paper = std::nullopt;
    usual.simplify.mode = prepare::Simplification::keep;
    usual.bodies = prepare::Bodies::keep;
  }
  job::Options options = job::options_of(asked, std::move(usual));
  if (options.paper) {
    export_::check_paper(*options.paper);
  }
  if (making.whole) {
    options.parts = job::PartsFrom::components;
    options.panel_cuts = unfold::PanelCuts::before_pieces;
  }
  return options;
}

py::object make(const py::object& vertices, const py::object& faces, const py::dict& keywords,
                const Making& making, const RunSettings& settings) {
  const job::Options options = options_of(keywords, making);
  const auto mesh = std::make_shared<const Mesh>(mesh_of(vertices, faces));
  auto made = result_in_background(
      [mesh, options, title = making.title](const Context& context) {
        mesh::Model model = model_of(*mesh, {}, context);
        model.name = title;
        return std::make_shared<const job::Result>(job::run(std::move(model), options, context));
      },
      settings);
  if (making.pages) {
    return py::cast(Paper{{std::move(made)}});
  }
  return py::cast(Nets{std::move(made)});
}

/// python/ridgecraft/_run.py has the signature that users see.
template <bool pages>
void add_making(py::module_& module, const char* name) {
  using namespace py::literals;
  module.def(
      name,
      [](const py::object& vertices, const py::object& faces, const py::dict& options,
         const std::tuple<bool, std::string>& making, const py::tuple& run) {
        const auto& [whole, title] = making;
        return make(vertices, faces, options, {pages, whole, title}, run_settings(run));
      },
      "vertices"_a, "faces"_a, "options"_a, "making"_a, "run"_a);
}

/// The options of a project, whose words are those of a command line.
job::AskedOptions asked_of(const session::ProjectFile& project) {
  job::AskedOptions asked;
  for (const std::string& word : project.words) {
    const std::size_t equals = std::min(word.find('='), word.size());
    const Option& row = option_row(std::string_view(word).substr(2, equals - 2));
    job::AskedOptions::Typed& typed = asked.typed(row.name);
    const std::string text = word.substr(std::min(equals + 1, word.size()));
    if (row.kind == OptionKind::file) {
      throw Error(ErrorKind::usage,
                  "the project names edges or tabs in files, which the program alone reads");
    }
    typed.flag = row.kind == OptionKind::flag;
    typed.text = text;
    typed.texts.push_back(text);
  }
  return asked;
}

/// A project as it was saved: its model with its options, and what was done by hand.
job::Result opened(const session::ProjectFile& project, const std::filesystem::path& folder,
                   Context context) {
  const job::AskedOptions asked = asked_of(project);
  job::Options usual;
  usual.size.adapts = true;
  const job::Options options = job::options_of(asked, std::move(usual));
  context.seed = asked.whole("seed");
  job::Result made = job::run(mesh::read(folder / project.model, {}, context), options, context);
  const std::vector<std::vector<session::Edit>> steps = session::steps_of(project.edits);
  return steps.empty() ? made : session::repeat(std::move(made), steps, context).project.now;
}

py::object open_project(const std::string& file, const std::string& bytes, const std::string& folder,
                        const RunSettings& settings) {
  auto made = result_in_background(
      [file, bytes, folder](const Context& context) {
        const session::ProjectFile project = session::read_project(file, bytes);
        for (const auto& [name, bytes] : project.files) {
          std::ofstream out(std::filesystem::path(folder) / name, std::ios::binary);
          if (!(out << bytes).flush()) {
            throw Error(ErrorKind::cant_write, "can't write the project's " + name + " into " + folder);
          }
        }
        return std::make_shared<const job::Result>(opened(project, folder, context));
      },
      settings);
  return py::cast(Paper{{std::move(made)}});
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
          "(number, edge, tab) for each cut: cuts in a row share a number, which is printed on both "
          "sides; tab is -1 where there is none.")
      .def_property_readonly(
          "tabs", &tabs,
          "(face, polygon) for each tab: the triangle that it grows from, and its corners in the "
          "plane of that one's piece: k x 2.")
      .def_property_readonly(
          "notes",
          [](const Nets& n) {
            std::vector<std::string> sentences;
            for (const Message& note : n.nets().notes) {
              sentences.push_back(english(note));
            }
            return sentences;
          },
          "Sentences on how the nets were found.")
      .def_property_readonly("figures", &figures, "Counts and lengths, as the check found them.")
      .def_property_readonly(
          "fold", [](const Nets& n) { return n.made->fold; }, "The text of a FOLD file.");
  py::class_<Paper, Nets>(module, "Paper", "Nets on pages.")
      .def_property_readonly(
          "page_count", [](const Paper& p) { return p.made->drawings.size(); }, "How many pages there are.")
      .def(
          "pdf",
          [](const Paper& p) {
            return py::bytes(written([&] { return export_::write_pdf(p.made->drawings, p.mark()); }));
          },
          "All pages as a PDF.")
      .def(
          "svg",
          [](const Paper& p, std::size_t page) {
            const export_::Drawing& drawing = p.page(page);
            return written([&] { return export_::write_svg(drawing, p.mark()); });
          },
          "page"_a, "One page, counted from 0, as an SVG.")
      .def(
          "png",
          [](const Paper& p, std::size_t page, double dots_per_inch) {
            if (!(dots_per_inch >= 1.0) || dots_per_inch > 2400.0) {
              throw Error(ErrorKind::usage, fmt::format("dots_per_inch is 1 to 2400, not {}", dots_per_inch));
            }
            const export_::Drawing& drawing = p.page(page);
            return py::bytes(written([&] { return export_::write_png(drawing, p.mark(), dots_per_inch); }));
          },
          "page"_a, "dots_per_inch"_a = 150.0, "One page, counted from 0, as a PNG.")
      .def(
          "dxf",
          [](const Paper& p, std::size_t page) {
            const export_::Drawing& drawing = p.page(page);
            return written([&] { return export_::write_dxf(drawing, p.mark()); });
          },
          "page"_a, "One page, counted from 0, as a DXF for machines.");
  module.def(
      "open_project",
      [](const std::string& file, const py::bytes& bytes, const std::string& folder, unsigned threads,
         const py::object& progress) {
        return open_project(file, bytes, folder, {threads, 1, std::nullopt, progress});
      },
      "file"_a, "bytes"_a, "folder"_a, "threads"_a, "progress"_a);
  add_making<false>(module, "unfold");
  add_making<true>(module, "run");
}

}  // namespace ridgecraft::python
