// SPDX-License-Identifier: GPL-3.0-or-later
// Promise 8: what a file says of itself is so. Most of it is asked of files that this program says to have
// made; others need not have our keys, nor our way to name things.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

#include <fmt/format.h>

#include "base/disjoint_sets.hpp"
#include "verify/checks/checks.hpp"
#include "verify/file/tolerance.hpp"
#include "verify/geometry/geometry.hpp"

namespace ridgecraft::verify {

namespace {

class StatementCheck {
 public:
  StatementCheck(const Case& given, Findings& findings)
      : given_(given), file_(given.file), findings_(findings) {}

  void run() {
    if (!file_.is_ours()) {
      return;
    }
    for (const std::string& remark : file_.remarks) {
      add({}, remark);
    }
    if (!is_hash(file_.digest)) {
      add({}, "ridgecraft:model_digest is no hash of a model");
    }
    check_vertices(file_.points.size(), file_.faces, "the nets");
    check_vertices(file_.model.points.size(), file_.model.faces, "the model");
    check_tabs();
    check_settings();
  }

 private:
  void add(std::initializer_list<std::pair<const char*, std::size_t>> indices, const std::string& message) {
    findings_.add(Promise::statements, indices, [&] { return message; });
  }

  void check_vertices(std::size_t count, const FaceList& faces, const char* where) {
    std::vector<bool> used(count, false);
    for (Index side = 0; side < faces.sides(); ++side) {
      used[faces.tail(side)] = true;
    }
    if (const auto idle = std::find(used.begin(), used.end(), false); idle != used.end()) {
      const auto vertex = static_cast<std::size_t>(idle - used.begin());
      add({{"vertex", vertex}}, fmt::format("vertex {} of {} belongs to no face", vertex, where));
    }
  }

  /// Tabs have a neck where they are put through a slit, and only there.
  void check_tabs() {
    for (Index t = 0; t < file_.tabs.size(); ++t) {
      if (!file_.tabs[t].slit && !is_convex(file_.tabs[t].polygon)) {
        add({{"tab", t}}, fmt::format("{} isn't convex", tab_name(file_, t)));
      }
    }
  }

  void check_settings() {
    const std::vector<std::string> faults = faults_of_settings(file_.settings);
    for (const std::string& fault : faults.empty() ? contradictions(given_) : faults) {
      add({}, fault);
    }
  }

  const Case& given_;
  const File& file_;
  Findings& findings_;
};

// Promise 8: pieces that are said to be equal can be laid on each other, with their folds, and with their
// tabs unless these are said to differ.

struct Stroke {
  Vec2 from, to;
  double angle_deg = 0.0;  ///< of a fold; what isn't one has an angle that no fold has
};

constexpr double cut_angle = 1000.0;
constexpr double tab_angle = 2000.0;

/// A motion of the plane, after turning it over or not.
struct Overlay {
  bool turned_over = false;
  Vec2 x_axis{1.0, 0.0};
  Vec2 origin;

  [[nodiscard]] Vec2 operator()(Vec2 p) const {
    const double x = turned_over ? -p.x : p.x;
    return origin + Vec2{x_axis.x * x - x_axis.y * p.y, x_axis.y * x + x_axis.x * p.y};
  }
};

/// What can be seen of a piece: its cuts first, then folds that show, then tabs.
struct Sheet {
  std::vector<Stroke> strokes;
  std::size_t cuts = 0;
  std::vector<std::size_t> order;  ///< strokes ascending by the x of their middles
};

double key(const Stroke& stroke) {
  return stroke.from.x + stroke.to.x;
}

class EqualPieceCheck {
 public:
  EqualPieceCheck(const Case& given, Findings& findings)
      : file_(given.file),
        relations_(given.relations),
        findings_(findings),
        named_(given.file.pieces.size(), false) {}

  void run() {
    if (file_.equal.empty()) {
      return;
    }
    gather();
    for (const std::vector<EqualPiece>& kind : file_.equal) {
      for (const EqualPiece& equal : kind) {
        if (named_[equal.piece]) {
          findings_.add(Promise::statements, {{"piece", equal.piece}}, [&] {
            return fmt::format("{} is named twice among equal pieces", piece_name(file_, equal.piece));
          });
        }
        named_[equal.piece] = true;
      }
    }
    for (const std::vector<EqualPiece>& kind : file_.equal) {
      for (std::size_t i = 1; i < kind.size(); ++i) {
        const Index first = kind.front().piece;
        const Index piece = kind[i].piece;
        const bool tabs = !kind[i].other_tabs;
        if (!are_equal(lines_of(first, tabs), lines_of(piece, tabs), kind[i].mirrored)) {
          findings_.add(Promise::statements, {{"piece", first}, {"piece", piece}}, [&] {
            return fmt::format("{} is said to be {} {}, and isn't", piece_name(file_, piece),
                               kind[i].mirrored ? "a mirror image of" : "equal to", piece_name(file_, first));
          });
        }
      }
    }
  }

 private:
  void gather() {
    sheets_.resize(file_.pieces.size());
    gather_edges();
    gather_tabs();
    for (Sheet& sheet : sheets_) {
      put_in_order(sheet);
    }
  }

  /// All cuts before all folds.
  void gather_edges() {
    for (const bool cuts : {true, false}) {
      for (Index e = 0; e < file_.edges.size(); ++e) {
        const Edge& edge = file_.edges[e];
        const auto sides = relations_.sides_of(e);
        if (sides.empty() || (edge.assignment == Assignment::cut) != cuts ||
            (!cuts && std::abs(edge.angle_deg) < slightest_fold_deg)) {
          continue;
        }
        Sheet& sheet = sheets_[file_.face_piece[file_.faces.face(sides.front())]];
        sheet.strokes.push_back({file_.points[file_.faces.tail(sides.front())],
                                 file_.points[file_.faces.head(sides.front())],
                                 cuts ? cut_angle : edge.angle_deg});
        sheet.cuts += cuts ? 1U : 0U;
      }
    }
  }

  void gather_tabs() {
    for (Index t = 0; t < file_.tabs.size(); ++t) {
      const std::vector<Vec2>& polygon = file_.tabs[t].polygon;
      if (relations_.sides_of(file_.tabs[t].edge).empty()) {
        continue;
      }
      const Index own = file_.face_piece[face_of_tab(file_, relations_, t)];
      Sheet& sheet = sheets_[own];
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        sheet.strokes.push_back({polygon[i], polygon[(i + 1) % polygon.size()], tab_angle});
      }
      if (const Index side = target_of_slit(file_, relations_, t); side != none) {
        const auto& slit = *file_.tabs[t].slit;
        const Index target = file_.face_piece[file_.faces.face(side)];
        sheets_[target].strokes.push_back({slit[0], slit[1], tab_angle});
      }
    }
  }

  static void put_in_order(Sheet& sheet) {
    sheet.order.resize(sheet.strokes.size());
    std::iota(sheet.order.begin(), sheet.order.end(), std::size_t{0});
    std::sort(sheet.order.begin(), sheet.order.end(),
              [&](std::size_t i, std::size_t k) { return key(sheet.strokes[i]) < key(sheet.strokes[k]); });
  }

  [[nodiscard]] Sheet lines_of(Index piece, bool with_tabs) const {
    Sheet sheet = sheets_[piece];
    if (!with_tabs) {
      std::erase_if(sheet.strokes, [](const Stroke& stroke) { return stroke.angle_deg == tab_angle; });
      put_in_order(sheet);
    }
    return sheet;
  }

  /// Folds that are so slight that one of two equal pieces may lack them aren't asked for.
  static bool is_asked_for(const Stroke& stroke) {
    return std::abs(stroke.angle_deg) >= 2.0 * slightest_fold_deg;
  }

  static bool has(const Sheet& sheet, const Stroke& wanted) {
    const auto near = [](Vec2 p, Vec2 q) { return length(p - q) <= equal_pieces_tolerance_mm; };
    const double low = key(wanted) - 2.0 * equal_pieces_tolerance_mm;
    const auto begin = std::lower_bound(sheet.order.begin(), sheet.order.end(), low,
                                        [&](std::size_t i, double x) { return key(sheet.strokes[i]) < x; });
    for (auto at = begin; at != sheet.order.end(); ++at) {
      const Stroke& stroke = sheet.strokes[*at];
      if (key(stroke) > low + 4.0 * equal_pieces_tolerance_mm) {
        break;
      }
      const bool same_ends = (near(stroke.from, wanted.from) && near(stroke.to, wanted.to)) ||
                             (near(stroke.from, wanted.to) && near(stroke.to, wanted.from));
      if (same_ends && std::abs(stroke.angle_deg - wanted.angle_deg) <= equal_folds_tolerance_deg) {
        return true;
      }
    }
    return false;
  }

  static Stroke laid(const Stroke& stroke, const Overlay& overlay) {
    return {overlay(stroke.from), overlay(stroke.to), stroke.angle_deg};
  }

  static bool covers(const Sheet& a, const Sheet& b, const Overlay& overlay) {
    return std::all_of(a.strokes.begin(), a.strokes.end(), [&](const Stroke& stroke) {
      return !is_asked_for(stroke) || has(b, laid(stroke, overlay));
    });
  }

  /// Lays a cut of one piece along a cut of another, so that their paper lies on the same side.
  static Overlay along(const Stroke& a, const Stroke& b, bool turned_over) {
    Overlay overlay{turned_over, {}, {}};
    Vec2 from = a.from;
    Vec2 to = a.to;
    if (turned_over) {
      from = {-a.to.x, a.to.y};
      to = {-a.from.x, a.from.y};
    }
    const Vec2 p = to - from;
    const Vec2 q = b.to - b.from;
    overlay.x_axis = Vec2{dot(p, q), cross(p, q)} / (length(p) * length(q));
    const Vec2 middle = 0.5 * (from + to);
    const Vec2 turned{overlay.x_axis.x * middle.x - overlay.x_axis.y * middle.y,
                      overlay.x_axis.y * middle.x + overlay.x_axis.x * middle.y};
    overlay.origin = 0.5 * (b.from + b.to) - turned;
    return overlay;
  }

  static bool are_equal(const Sheet& a, const Sheet& b, bool mirrored) {
    if (a.cuts != b.cuts || a.cuts == 0) {
      return false;
    }
    const auto size = [](const Stroke& stroke) { return length(stroke.to - stroke.from); };
    const Stroke& longest =
        *std::max_element(a.strokes.begin(), a.strokes.begin() + static_cast<std::ptrdiff_t>(a.cuts),
                          [&](const Stroke& s, const Stroke& t) { return size(s) < size(t); });
    for (std::size_t i = 0; i < b.cuts; ++i) {
      const Stroke& cut = b.strokes[i];
      if (std::abs(size(cut) - size(longest)) > 2.0 * equal_pieces_tolerance_mm) {
        continue;
      }
      const Overlay there = along(longest, cut, mirrored);
      if (covers(a, b, there) && covers(b, a, along(cut, longest, mirrored))) {
        return true;
      }
    }
    return false;
  }

  const File& file_;
  const Relations& relations_;
  Findings& findings_;
  std::vector<Sheet> sheets_;
  std::vector<bool> named_;  ///< per piece: among equal pieces
};

// Promise 8: the order of assembly names each piece once, each join where both its pieces stand, and goes on
// from what stands.

class AssemblyCheck {
 public:
  AssemblyCheck(const Case& given, Findings& findings)
      : file_(given.file),
        relations_(given.relations),
        findings_(findings),
        step_of_(file_.pieces.size(), none) {}

  void run() {
    number_pieces();
    if (sound_) {
      check_joins_of_steps();
      check_footing();
    }
  }

 private:
  [[nodiscard]] const std::vector<AssemblyStep>& steps() const { return *file_.assembly; }

  void add(std::size_t step, const std::string& words) {
    sound_ = false;
    findings_.add(Promise::statements, {{"step", step}},
                  [&] { return fmt::format("step {} of the assembly {}", step, words); });
  }

  void number_pieces() {
    for (std::size_t s = 0; s < steps().size(); ++s) {
      for (const Index piece : steps()[s].pieces) {
        if (step_of_[piece] != none) {
          add(s, fmt::format("has {}, which stands already", piece_name(file_, piece)));
        }
        step_of_[piece] = static_cast<Index>(s);
      }
    }
    for (Index piece = 0; piece < step_of_.size(); ++piece) {
      if (step_of_[piece] == none) {
        sound_ = false;
        findings_.add(Promise::statements, {{"piece", piece}}, [&] {
          return fmt::format("no step of the assembly has {}", piece_name(file_, piece));
        });
      }
    }
  }

  [[nodiscard]] Index piece_at(Index edge) const {
    return file_.face_piece[file_.faces.face(relations_.sides_of(edge).front())];
  }

  void check_joins_of_steps() {
    std::vector<std::vector<std::int64_t>> wanted(steps().size());
    for (const Join& join : file_.joins) {
      wanted[std::max(step_of_[piece_at(join.edges[0])], step_of_[piece_at(join.edges[1])])].push_back(
          join.number);
    }
    for (std::size_t s = 0; s < wanted.size(); ++s) {
      std::sort(wanted[s].begin(), wanted[s].end());
      wanted[s].erase(std::unique(wanted[s].begin(), wanted[s].end()), wanted[s].end());
      // Joins of one number are one seam, which another program may glue in two steps.
      if (file_.is_ours() ? wanted[s] != steps()[s].joins
                          : !std::includes(wanted[s].begin(), wanted[s].end(), steps()[s].joins.begin(),
                                           steps()[s].joins.end())) {
        add(s, "has other joins than those by which its pieces are glued to what stands");
      }
    }
  }

  /// A piece that isn't glued to anything that stands begins a body, and nothing of it may stand by then.
  void check_footing() {
    DisjointSets bodies(file_.pieces.size());
    std::vector<bool> has_footing(file_.pieces.size(), false);
    for (const Join& join : file_.joins) {
      const Index a = piece_at(join.edges[0]);
      const Index b = piece_at(join.edges[1]);
      bodies.join(a, b);
      if (step_of_[a] != step_of_[b]) {
        has_footing[step_of_[a] > step_of_[b] ? a : b] = true;
      }
    }
    std::vector<Index> begun(file_.pieces.size(), none);
    for (std::size_t s = 0; s < steps().size(); ++s) {
      for (const Index piece : steps()[s].pieces) {
        const Index first = begun[bodies.find(piece)];
        if (first != none && !has_footing[piece]) {
          add(s, fmt::format("has {}, which isn't glued to anything that stands", piece_name(file_, piece)));
        }
        begun[bodies.find(piece)] = first == none ? static_cast<Index>(s) : first;
      }
    }
  }

  const File& file_;
  const Relations& relations_;
  Findings& findings_;
  std::vector<Index> step_of_;  ///< of each piece
  bool sound_ = true;
};

}  // namespace

void check_statements(const Case& given, Findings& findings) {
  StatementCheck(given, findings).run();
}

void check_equal_pieces(const Case& given, Findings& findings) {
  EqualPieceCheck(given, findings).run();
}

void check_assembly(const Case& given, Findings& findings) {
  if (given.file.assembly) {
    AssemblyCheck(given, findings).run();
  }
}

}  // namespace ridgecraft::verify
