// SPDX-License-Identifier: GPL-3.0-or-later
// Promise 4: everything lies on the printable area of its page, and pages lie beside each other.
#include <algorithm>

#include <fmt/format.h>

#include "verify/checks/checks.hpp"
#include "verify/file/tolerance.hpp"
#include "verify/geometry/box_finder.hpp"
#include "verify/geometry/polygon.hpp"

namespace ridgecraft::verify {
namespace {

/// How far the polygon reaches out of the printable area, mm; not positive if it is inside.
double excess(std::span<const Vec2> polygon, const Page& page) {
  const Box2 box = bounding_box(polygon);
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
