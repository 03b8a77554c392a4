// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/boxes.hpp"
#include "base/geometry.hpp"
#include "verify/pages/check_pages.hpp"

namespace ridgecraft::verify {
namespace {

/// A number without a line stands within this of its edge or its tab's rim: 9 mm inside, and half a letter.
constexpr double at_edge_mm = 11.0;
/// A line ends this near to its edge ...
constexpr double leader_to_edge_mm = 1.0;
/// ... and this near to its number: a gap, and half of the longest label, as PDF has its words level.
constexpr double leader_to_number_mm = 6.0;
/// A name stands in its piece's box, or a line leads from it there.
constexpr double beside_piece_mm = 35.0;

/// "7", or "C:7" with the piece that the edge is joined to.
struct Label {
  std::string partner;
  std::int64_t number = 0;
};

std::optional<Label> label_of(std::string_view words) {
  Label label;
  if (const std::size_t colon = words.rfind(':'); colon != std::string_view::npos) {
    label.partner = words.substr(0, colon);
    words.remove_prefix(colon + 1);
  }
  const auto [end, error] = std::from_chars(words.data(), words.data() + words.size(), label.number);
  return error == std::errc{} && end == words.data() + words.size() ? std::optional(label) : std::nullopt;
}

/// Of segments that don't cross.
double distance(const Segment& a, const Segment& b) {
  return std::min({distance(a.a, b), distance(a.b, b), distance(b.a, a), distance(b.b, a)});
}

/// An edge, or a side of its tab, on a page.
struct Seam {
  Segment line;
  Index piece = 0;
  Index partner = none;
};

class WordCheck {
 public:
  WordCheck(const Case& given, Index page, const PrintedPage& printed)
      : given_(given), file_(given.file), page_(page), printed_(printed), leaders_(boxes_of(printed)) {
    for (const Join& join : file_.joins) {
      for (std::size_t side : {0U, 1U}) {
        const Index edge = join.edges[side];
        partner_[edge] = piece_of_edge(file_, given.relations, join.edges[1 - side]);
        const auto [a, b] = file_.edges[edge].ends;
        add_seam(join.number, edge, {file_.points[a], file_.points[b]});
      }
    }
    for (const Tab& tab : file_.tabs) {
      for (std::size_t i = 0; i < tab.polygon.size(); ++i) {
        for (const std::int64_t number : tab.numbers) {
          add_seam(number, tab.edge, {tab.polygon[i], tab.polygon[(i + 1) % tab.polygon.size()]});
        }
      }
    }
  }

  std::vector<std::string> run(bool lists_numbers) {
    for (const PrintedText& text : printed_.texts) {
      given_.context.check();
      if (const auto label = label_of(text.words); label && text.layer == PrintedLayer::label) {
        check_label(*label, text);
      }
    }
    // With --numbers back a page has no names, and of the numbers those of tabs alone.
    const bool on_back =
        std::none_of(printed_.texts.begin(), printed_.texts.end(),
                     [](const PrintedText& text) { return text.layer == PrintedLayer::name; });
    for (const auto& [number, seams] : seams_) {
      for (const Seam& seam : seams) {
        if (!lists_numbers && !on_back && seen_.insert({number, seam.piece}).second) {
          faults_.push_back(fmt::format("lacks the number {} at {}", number, piece_name(file_, seam.piece)));
        }
      }
    }
    check_names();
    return std::move(faults_);
  }

 private:
  static std::vector<Box2> boxes_of(const PrintedPage& printed) {
    std::vector<Box2> boxes;
    for (const PrintedLine& line : printed.leaders) {
      boxes.push_back(box_of(std::array{line.points.front(), line.points.back()}));
    }
    return boxes;
  }

  void add_seam(std::int64_t number, Index edge, const Segment& line) {
    const Index piece = piece_of_edge(file_, given_.relations, edge);
    if (file_.pieces[piece].page == page_) {
      const Vec2 low = file_.pages[page_].low;
      const auto partner = partner_.find(edge);
      seams_[number].push_back(
          {{line.a - low, line.b - low}, piece, partner == partner_.end() ? none : partner->second});
    }
  }

  void check_label(const Label& label, const PrintedText& printed) {
    const auto found = seams_.find(label.number);
    if (found == seams_.end()) {
      faults_.push_back(fmt::format("has the number {}, which joins nothing on it", label.number));
      return;
    }
    const Segment text{printed.from, printed.to};
    bool any = false;
    for (const Seam& seam : found->second) {
      const bool joins =
          label.partner.empty() || (seam.partner != none && file_.pieces[seam.partner].name == label.partner);
      if (joins && (distance(text, seam.line) <= at_edge_mm || leads_to(text, seam.line))) {
        seen_.insert({label.number, seam.piece});
        any = true;
      }
    }
    if (!any) {
      faults_.push_back(fmt::format("has {} at ({:.2f}, {:.2f}), where it joins nothing", printed.words,
                                    text.a.x, text.a.y));
    }
  }

  [[nodiscard]] bool leads_to(const Segment& text, const Segment& edge) const {
    bool leads = false;
    leaders_.for_each_overlapping(
        grown(box_of(std::array{text.a, text.b}), leader_to_number_mm), [&](std::size_t i) {
          const std::vector<Vec2>& line = printed_.leaders[i].points;
          const auto ends_well = [&](Vec2 at_text, Vec2 at_edge) {
            return distance(at_text, text) <= leader_to_number_mm &&
                   distance(at_edge, edge) <= leader_to_edge_mm;
          };
          leads = leads || ends_well(line.front(), line.back()) || ends_well(line.back(), line.front());
        });
    return leads;
  }

  /// One that has no room is in a list, among other words.
  void check_names() {
    std::vector<Box2> boxes(file_.pieces.size());
    for (Index face = 0; face < file_.faces.faces(); ++face) {
      for (const Vec2 p : file_.polygon(face)) {
        boxes[file_.face_piece[face]].add(p - file_.pages[page_].low);
      }
    }
    std::map<std::string, std::vector<const PrintedText*>> names;
    for (const PrintedText& text : printed_.texts) {
      if (text.layer == PrintedLayer::name) {
        names[text.words].push_back(&text);
      }
    }
    for (Index piece = 0; piece < file_.pieces.size(); ++piece) {
      const auto found = names.find(file_.pieces[piece].name);
      if (file_.pieces[piece].page != page_ || found == names.end()) {
        continue;
      }
      const Box2 near = grown(boxes[piece], beside_piece_mm);
      if (std::none_of(found->second.begin(), found->second.end(), [&](const PrintedText* text) {
            return meet(near, box_of(std::array{text->from, text->to}));
          })) {
        faults_.push_back(fmt::format("has the name of {} elsewhere", piece_name(file_, piece)));
      }
    }
  }

  const Case& given_;
  const File& file_;
  Index page_;
  const PrintedPage& printed_;
  BoxFinder leaders_;
  std::map<Index, Index> partner_;  ///< of edges: the piece that they are joined to
  std::map<std::int64_t, std::vector<Seam>> seams_;
  std::set<std::pair<std::int64_t, Index>> seen_;  ///< numbers that stand at a piece
  std::vector<std::string> faults_;
};

}  // namespace

bool has_list_of_numbers(const PrintedFile& file) {
  return std::any_of(file.pages.begin(), file.pages.end(), [](const PrintedPage& page) {
    return std::any_of(page.texts.begin(), page.texts.end(), [](const PrintedText& text) {
      return text.words.find("unmarked") != std::string::npos ||
             text.words.starts_with("numbers that stand nowhere");
    });
  });
}

std::vector<std::string> faults_of_words(const Case& given, Index page, const PrintedPage& printed,
                                         bool lists_numbers) {
  return WordCheck(given, page, printed).run(lists_numbers);
}

}  // namespace ridgecraft::verify
