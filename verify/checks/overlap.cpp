// SPDX-License-Identifier: GPL-3.0-or-later
// Promise 2: no two faces of a page overlap, and tabs overlap nothing. All pairs whose boxes meet are
// measured.
#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "verify/checks/checks.hpp"
#include "verify/file/tolerance.hpp"
#include "verify/geometry/box_finder.hpp"
#include "verify/geometry/polygon.hpp"

namespace ridgecraft::verify {
namespace {

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
    parts.boxes.push_back(bounding_box(part));
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
class PageSearch {
 public:
  PageSearch(const Parts& parts, const std::vector<Index>& numbers)
      : numbers_(numbers), tree_(boxes(parts, numbers)) {}

  template <typename Visit>
  void for_each_near(const Box2& box, Visit&& visit) const {
    tree_.for_each_overlapping(box, [&](std::size_t i) { visit(numbers_[i]); });
  }

 private:
  static std::vector<Box2> boxes(const Parts& parts, const std::vector<Index>& numbers) {
    std::vector<Box2> result;
    for (const Index part : numbers) {
      result.push_back(parts.boxes[part]);
    }
    return result;
  }

  std::vector<Index> numbers_;
  BoxFinder tree_;
};

std::map<Index, PageSearch> search_by_page(const Parts& parts) {
  std::map<Index, std::vector<Index>> of_page;
  for (Index part = 0; part < parts.polygons.size(); ++part) {
    of_page[parts.page[parts.item[part]]].push_back(part);
  }
  std::map<Index, PageSearch> result;
  for (const auto& [page, numbers] : of_page) {
    result.emplace(page, PageSearch(parts, numbers));
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
    for (Index part = parts_.first[item]; part < parts_.first[item + 1]; ++part) {
      pages_.at(parts_.page[item]).for_each_near(parts_.boxes[part], [&](Index other) {
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

}  // namespace

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

}  // namespace ridgecraft::verify
