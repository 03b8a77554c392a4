// SPDX-License-Identifier: GPL-3.0-or-later
// Promises 1 to 4: what can be said of single faces and tabs, and of pairs of them.
#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "verify/checks/checks.hpp"
#include "verify/file/tolerance.hpp"
#include "verify/geometry/geometry.hpp"

namespace ridgecraft::verify {

// Promise 1: every net face is congruent to its model face, and model polygons are plane.

namespace {

struct Difference {
  double worst = 0.0;  ///< mm, of all sides and diagonals
  bool tolerable = true;
};

Difference compare(std::span<const Vec2> net, std::span<const Vec3> model, const Context& context) {
  Difference result;
  for (std::size_t i = 0; i < net.size(); ++i) {
    context.check();
    for (std::size_t j = i + 1; j < net.size(); ++j) {
      const double truth = length(model[j] - model[i]);
      const double error = std::abs(length(net[j] - net[i]) - truth);
      result.worst = std::fmax(result.worst, error);
      result.tolerable = result.tolerable && error <= length_tolerance_mm + length_tolerance_fraction * truth;
    }
  }
  return result;
}

void check_congruence(const Case& given, Index face, const Polygon& polygon, Findings& findings) {
  const File& file = given.file;
  const Relations& relations = given.relations;
  const Context& context = given.context;
  const Index model_face = file.face_model[face];
  if (!relations.corners_match[face]) {
    findings.add(Promise::lengths, {{"face", face}, {"model_face", model_face}}, [&] {
      return fmt::format("{} has {} corners, its model face {} has {}", face_name(file, face), polygon.size(),
                         model_face, file.model.faces.size(model_face));
    });
    return;
  }
  std::vector<Vec3> corners;
  for (const Index v : file.model.faces.vertices(model_face)) {
    corners.push_back(file.model.points[v]);
  }
  const Difference difference = compare(polygon, corners, context);
  double& worst = findings.figures().max_length_error_mm;
  worst = std::fmax(worst, difference.worst);
  if (!difference.tolerable) {
    findings.add(Promise::lengths, {{"face", face}, {"model_face", model_face}}, [&] {
      return fmt::format("{} differs from its model face {} by {:.4g} mm in a length", face_name(file, face),
                         model_face, difference.worst);
    });
  }
}

void check_shape(const Case& given, Index face, const Polygon& polygon, Findings& findings) {
  if (!(doubled_area(polygon) > 0.0)) {
    findings.add(Promise::lengths, {{"face", face}}, [&] {
      return fmt::format("{} is not counterclockwise: it is mirrored or has no area",
                         face_name(given.file, face));
    });
  } else if (!is_convex(polygon) && !is_simple(polygon, given.context)) {
    findings.add(Promise::lengths, {{"face", face}}, [&] {
      return fmt::format("the outline of {} crosses or touches itself", face_name(given.file, face));
    });
  }
}

void check_plane(const Case& given, Index model_face, Findings& findings) {
  const Model& model = given.file.model;
  const std::span<const Index> corners = model.faces.vertices(model_face);
  if (corners.size() == 3) {
    return;
  }
  Vec3 mean;
  for (const Index v : corners) {
    mean += model.points[v] / static_cast<double>(corners.size());
  }
  double worst = 0.0;
  for (const Index v : corners) {
    worst = std::fmax(worst, std::abs(dot(model.points[v] - mean, given.relations.normal[model_face])));
  }
  if (worst > plane_tolerance_fraction * model.size) {
    findings.add(Promise::lengths, {{"model_face", model_face}}, [&] {
      return fmt::format("model face {} is not plane: a corner is {:.4g} mm off its plane", model_face,
                         worst);
    });
  }
}

// Promise 2: no two faces of a page overlap, and tabs overlap nothing. All pairs whose boxes meet are
// measured.

/// The convex parts of everything that lies on the pages. Items are the faces, then the tabs.
struct Parts {
  std::vector<Polygon> polygons;
  std::vector<Box2> boxes;
  std::vector<Index> item;   ///< per part
  std::vector<Index> first;  ///< per item, and one more: its first part
  std::vector<Index> page;   ///< per item
};

void add_item(const Polygon& outline, Index page, const Context& context, Parts& parts) {
  for (Polygon& part : convex_parts(outline, context)) {
    parts.boxes.push_back(box_of(part));
    parts.polygons.push_back(std::move(part));
    parts.item.push_back(static_cast<Index>(parts.page.size()));
  }
  parts.page.push_back(page);
  parts.first.push_back(static_cast<Index>(parts.polygons.size()));
}

Parts collect(const Case& given) {
  const File& file = given.file;
  const Relations& relations = given.relations;
  const Context& context = given.context;
  Parts parts;
  parts.first.push_back(0);
  for (Index face = 0; face < file.faces.faces(); ++face) {
    context.check();
    add_item(file.polygon(face), page_of_face(file, face), context, parts);
  }
  for (Index tab = 0; tab < file.tabs.size(); ++tab) {
    add_item(file.tabs[tab].polygon, page_of_face(file, face_of_tab(file, relations, tab)), context, parts);
  }
  return parts;
}

/// The parts of one page, to be searched by box.
struct PageSearch {
  std::vector<Index> numbers;
  BoxFinder tree;
};

std::map<Index, PageSearch> search_by_page(const Parts& parts) {
  std::map<Index, std::vector<Index>> of_page;
  for (Index part = 0; part < parts.polygons.size(); ++part) {
    of_page[parts.page[parts.item[part]]].push_back(part);
  }
  std::map<Index, PageSearch> result;
  for (const auto& [page, numbers] : of_page) {
    std::vector<Box2> boxes;
    for (const Index part : numbers) {
      boxes.push_back(parts.boxes[part]);
    }
    result.emplace(page, PageSearch{numbers, BoxFinder(boxes)});
  }
  return result;
}

struct Overlap {
  Index other;
  double depth;
};

/// Measures an item against all later ones that come near it.
class Measure {
 public:
  explicit Measure(const Parts& parts) : parts_(parts), pages_(search_by_page(parts)) {}

  /// What overlaps the item by more than the tolerance, among the items after it: each once, with its
  /// greatest depth.
  [[nodiscard]] std::vector<Overlap> later_overlaps(Index item) {
    std::vector<Overlap> found;
    const PageSearch& page = pages_.at(parts_.page[item]);
    for (Index part = parts_.first[item]; part < parts_.first[item + 1]; ++part) {
      page.tree.for_each_overlapping(parts_.boxes[part], [&](std::size_t i) {
        const Index other = page.numbers[i];
        if (parts_.item[other] > item && !given_up()) {
          measure(part, other, found);
        }
      });
    }
    std::sort(found.begin(), found.end(), [](const Overlap& a, const Overlap& b) {
      return a.other != b.other ? a.other < b.other : a.depth > b.depth;
    });
    found.erase(std::unique(found.begin(), found.end(),
                            [](const Overlap& a, const Overlap& b) { return a.other == b.other; }),
                found.end());
    return found;
  }

  [[nodiscard]] double deepest() const { return deepest_; }
  [[nodiscard]] bool given_up() const { return work_ > max_overlap_work; }

 private:
  void measure(Index part, Index other, std::vector<Overlap>& found) {
    const Polygon& a = parts_.polygons[part];
    const Polygon& b = parts_.polygons[other];
    work_ += 2 * a.size() * b.size();
    const double depth = penetration(a, b);
    deepest_ = std::max(deepest_, depth);
    if (depth > overlap_tolerance_mm) {
      found.push_back({parts_.item[other], depth});
    }
  }

  const Parts& parts_;
  std::map<Index, PageSearch> pages_;
  double deepest_ = 0.0;
  std::size_t work_ = 0;
};

void add_overlap(const File& file, Index a, Index b, double depth, Findings& findings) {
  const Index faces = file.faces.faces();
  if (b < faces) {
    ++findings.figures().overlaps;
    findings.add(Promise::no_overlap, {{"face", a}, {"face", b}}, [&] {
      return fmt::format("{} and {} overlap by {:.4g} mm", face_name(file, a), face_name(file, b), depth);
    });
    return;
  }
  ++findings.figures().tab_overlaps;
  if (a < faces) {
    findings.add(Promise::no_overlap, {{"tab", b - faces}, {"face", a}}, [&] {
      return fmt::format("{} overlaps {} by {:.4g} mm", tab_name(file, b - faces), face_name(file, a), depth);
    });
  } else {
    findings.add(Promise::no_overlap, {{"tab", a - faces}, {"tab", b - faces}}, [&] {
      return fmt::format("{} and {} overlap by {:.4g} mm", tab_name(file, a - faces),
                         tab_name(file, b - faces), depth);
    });
  }
}

// Promise 3: every model face is one net face, and every piece has the parts that it states.

void check_model_faces(const Case& given, Findings& findings) {
  Figures& figures = findings.figures();
  for (Index face = 0; face < given.file.model.faces.faces(); ++face) {
    const Index uses = given.relations.uses[face];
    if (uses == 0) {
      ++figures.missing_faces;
      findings.add(Promise::coverage, {{"model_face", face}},
                   [&] { return fmt::format("model face {} is on no piece", face); });
    } else if (uses > 1) {
      ++figures.double_faces;
      findings.add(Promise::coverage, {{"model_face", face}},
                   [&] { return fmt::format("model face {} is {} faces of the nets", face, uses); });
    }
  }
}

/// The parts of the faces of each piece, each once, in order.
std::vector<std::vector<std::int64_t>> parts_of_pieces(const File& file) {
  std::vector<std::vector<std::int64_t>> parts(file.pieces.size());
  for (Index face = 0; face < file.faces.faces(); ++face) {
    parts[file.face_piece[face]].push_back(file.model.face_part[file.face_model[face]]);
  }
  for (std::vector<std::int64_t>& list : parts) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return parts;
}

// Promise 4: everything lies on the printable area of its page, and pages don't overlap.

/// How far the polygon reaches out of the printable area, mm; not positive if it is inside.
double excess(std::span<const Vec2> polygon, const Page& page) {
  const Box2 box = box_of(polygon);
  return std::max({page.printable_low.x - box.low.x, page.printable_low.y - box.low.y,
                   box.high.x - page.printable_high.x, box.high.y - page.printable_high.y});
}

/// Whether a polygon is out of bounds, and by how much: for faces and tabs alike.
bool is_outside(const File& file, Index page, std::span<const Vec2> polygon, double& by) {
  by = file.pages[page].bounded ? excess(polygon, file.pages[page]) : 0.0;
  return by > page_tolerance_mm;
}

void check_pages_apart(const File& file, Findings& findings) {
  std::vector<Index> bounded;
  std::vector<Box2> boxes;
  const Vec2 slack{page_tolerance_mm, page_tolerance_mm};
  for (Index p = 0; p < file.pages.size(); ++p) {
    const Page& page = file.pages[p];
    // A page no larger than the tolerance can't overlap another by more than it.
    if (page.bounded && page.high.x - page.low.x > slack.x && page.high.y - page.low.y > slack.y) {
      bounded.push_back(p);
      boxes.push_back({page.low, page.high - slack});
    }
  }
  const BoxFinder tree(boxes);
  std::size_t found = 0;
  for (std::size_t a = 0; a < boxes.size() && found < max_page_overlaps; ++a) {
    std::vector<std::size_t> others;
    tree.for_each_overlapping(boxes[a], [&](std::size_t b) {
      if (b > a) {
        others.push_back(b);
      }
    });
    found += others.size();
    std::sort(others.begin(), others.end());
    for (const std::size_t b : others) {
      findings.add(Promise::page_bounds, {{"page", bounded[a]}, {"page", bounded[b]}}, [&] {
        return fmt::format("pages {} and {} overlap in the plane", bounded[a], bounded[b]);
      });
    }
  }
}

}  // namespace

void check_lengths(const Case& given, Findings& findings) {
  for (Index face = 0; face < given.file.faces.faces(); ++face) {
    given.context.check();
    const Polygon polygon = given.file.polygon(face);
    check_congruence(given, face, polygon, findings);
    check_shape(given, face, polygon, findings);
  }
  for (Index face = 0; face < given.file.model.faces.faces(); ++face) {
    check_plane(given, face, findings);
  }
}

void check_overlap(const Case& given, Findings& findings) {
  const Parts parts = collect(given);
  Measure measure(parts);
  for (Index item = 0; item < parts.page.size() && !measure.given_up(); ++item) {
    given.context.check();
    for (const Overlap& overlap : measure.later_overlaps(item)) {
      add_overlap(given.file, item, overlap.other, overlap.depth, findings);
    }
  }
  findings.figures().max_penetration_mm = measure.deepest();
  if (measure.given_up()) {
    findings.add(Promise::no_overlap, {}, [&] {
      const Figures& figures = findings.figures();
      return fmt::format("so much lies on each other that counting stopped at {} overlaps",
                         figures.overlaps + figures.tab_overlaps);
    });
  }
}

void check_coverage(const Case& given, Findings& findings) {
  check_model_faces(given, findings);
  const File& file = given.file;
  const std::vector<std::vector<std::int64_t>> parts = parts_of_pieces(file);
  for (Index p = 0; p < file.pieces.size(); ++p) {
    const Piece& piece = file.pieces[p];
    std::vector<std::int64_t> stated = piece.parts;
    std::sort(stated.begin(), stated.end());
    const bool part_fits = parts[p].size() == 1 ? piece.part == parts[p].front() : !piece.part.has_value();
    if (parts[p].empty()) {
      findings.add(Promise::coverage, {{"piece", p}},
                   [&] { return fmt::format("{} has no face", piece_name(file, p)); });
    } else if (stated != parts[p]) {
      findings.add(Promise::coverage, {{"piece", p}}, [&] {
        return fmt::format("{} doesn't state the parts that its faces have, each once", piece_name(file, p));
      });
    } else if (!part_fits) {
      findings.add(Promise::coverage, {{"piece", p}}, [&] {
        return fmt::format("\"part\" of {} doesn't go with the {} part{} of its faces", piece_name(file, p),
                           parts[p].size(), parts[p].size() == 1 ? "" : "s");
      });
    }
  }
}

void check_bounds(const Case& given, Findings& findings) {
  const File& file = given.file;
  const Relations& relations = given.relations;
  const Context& context = given.context;
  double by = 0.0;
  for (Index face = 0; face < file.faces.faces(); ++face) {
    const Index page = page_of_face(file, face);
    if (is_outside(file, page, file.polygon(face), by)) {
      ++findings.figures().outside_page;
      findings.add(Promise::page_bounds, {{"face", face}, {"page", page}}, [&] {
        return fmt::format("{} is {:.4g} mm outside the printable area of page {}", face_name(file, face), by,
                           page + 1);
      });
    }
  }
  for (Index tab = 0; tab < file.tabs.size(); ++tab) {
    const Index page = page_of_face(file, face_of_tab(file, relations, tab));
    if (is_outside(file, page, file.tabs[tab].polygon, by)) {
      ++findings.figures().outside_page;
      findings.add(Promise::page_bounds, {{"tab", tab}, {"page", page}}, [&] {
        return fmt::format("{} is {:.4g} mm outside the printable area of page {}", tab_name(file, tab), by,
                           page + 1);
      });
    }
  }
  context.check();
  check_pages_apart(file, findings);
}

}  // namespace ridgecraft::verify
