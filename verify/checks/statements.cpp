// SPDX-License-Identifier: GPL-3.0-or-later
// Promise 8: what a file says of itself is so. Most of it is asked of files that this program says to have
// made; others need not have our keys, nor our way to name things.
#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "verify/checks/checks.hpp"
#include "verify/checks/settings.hpp"
#include "verify/file/json_text.hpp"
#include "verify/file/settings_form.hpp"
#include "verify/file/tolerance.hpp"
#include "verify/geometry/polygon.hpp"

namespace ridgecraft::verify {
namespace {

using Words = std::vector<std::string>;

bool contains(const Words& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// A, B, ... Z, AA, AB, ...
std::string name_of_piece(std::size_t number) {
  std::string name;
  for (++number; number > 0; number = (number - 1) / 26) {
    name.insert(name.begin(), static_cast<char>('A' + (number - 1) % 26));
  }
  return name;
}

class StatementCheck {
 public:
  StatementCheck(const Case& given, Findings& findings)
      : given_(given), file_(given.file), findings_(findings) {}

  void run() {
    if (file_.creator.empty()) {
      add({}, "\"file_creator\" of the file is empty");
    }
    check_contradictory_words();
    check_shared_numbers();
    if (!file_.is_ours()) {
      return;
    }
    check_creator();
    check_keys();
    check_words();
    check_vertices(file_.points.size(), file_.faces, "the nets");
    check_vertices(file_.model.points.size(), file_.model.faces, "the model");
    check_pieces();
    check_pages();
    check_joins();
    check_tabs();
    check_settings();
  }

 private:
  void add(std::initializer_list<std::pair<const char*, std::size_t>> indices, const std::string& message) {
    findings_.add(Promise::statements, indices, [&] { return message; });
  }

  /// Both frames are known to be what they are by now.
  void check_contradictory_words() {
    for (const char* word : {"3D", "abstract"}) {
      if (contains(file_.words.attributes, word)) {
        add({}, fmt::format("\"frame_attributes\" of the file has \"{}\" beside \"2D\"", word));
      }
    }
    for (const char* word : {"2D", "abstract", "nonManifold", "nonOrientable"}) {
      if (contains(file_.model.words.attributes, word)) {
        add({}, fmt::format("\"frame_attributes\" of the model's frame has \"{}\", which it isn't", word));
      }
    }
  }

  /// Joins have one number where they are one seam on paper: straight, and between the same two pieces.
  void check_shared_numbers() {
    std::map<std::int64_t, Index> first;
    for (Index j = 0; j < file_.joins.size(); ++j) {
      const auto [at, is_new] = first.try_emplace(file_.joins[j].number, j);
      if (!is_new && !is_one_seam(at->second, j)) {
        add({{"join", at->second}, {"join", j}},
            fmt::format("{} and {} have the same number and are no straight seam",
                        join_name(file_, at->second), join_name(file_, j)));
      }
    }
  }

  [[nodiscard]] std::pair<Index, Index> pieces_of(const Join& join) const {
    const auto piece = [&](Index edge) {
      return file_.face_piece[file_.faces.face(given_.relations.sides_of(edge).front())];
    };
    return std::minmax(piece(join.edges[0]), piece(join.edges[1]));
  }
  [[nodiscard]] bool is_one_seam(Index j, Index k) const {
    const Join& one = file_.joins[j];
    const Join& other = file_.joins[k];
    const Index a = model_side_of(file_, given_.relations, one.edges[0]);
    const Index b = model_side_of(file_, given_.relations, other.edges[0]);
    if (a == none || b == none) {
      return true;  // promise 1 says what is wrong there
    }
    const Model& model = file_.model;
    const Vec3 start = model.points[model.faces.tail(a)];
    const Vec3 along = normalized(model.points[model.faces.head(a)] - start);
    const auto on_line = [&](Index v) {
      return length(cross(along, model.points[v] - start)) <= seam_tolerance_mm;
    };
    return pieces_of(one) == pieces_of(other) && on_line(model.faces.tail(b)) && on_line(model.faces.head(b));
  }

  /// "ridgecraft 0.1.0": nothing but the version follows the name.
  void check_creator() {
    const std::string_view version = std::string_view(file_.creator).substr(file_.creator.find(' ') + 1);
    if (version.empty() || version.find_first_not_of("0123456789.") != std::string_view::npos) {
      add({}, fmt::format("\"file_creator\" of the file is {}, which is no version of ridgecraft",
                          quote(file_.creator)));
    }
  }

  void check_keys() {
    for (const std::string& key : file_.unknown_keys) {
      add({}, fmt::format("nobody knows the key {}", key));
    }
    if (!file_.fold_order) {
      add({}, "the file has no \"ridgecraft:fold_order\"");
    }
    if (!is_hash(file_.digest)) {
      add({}, "\"ridgecraft:model_digest\" is no hash of a model");
    }
  }

  void check_words() {
    const auto expect = [&](const Words& words, const Words& wanted, const char* what) {
      if (words != wanted) {
        add({}, fmt::format("{} are other words than \"{}\"", what, fmt::join(wanted, "\", \"")));
      }
    };
    expect(file_.file_classes, {"multiModel"}, "\"file_classes\"");
    expect(file_.words.classes, {"creasePattern"}, "\"frame_classes\" of the file");
    expect(file_.words.attributes, {"2D"}, "\"frame_attributes\" of the file");
    expect(file_.model.words.classes, {"foldedForm"}, "\"frame_classes\" of the model's frame");
    expect(file_.model.words.attributes, {"3D", "manifold", "orientable"},
           "\"frame_attributes\" of the model's frame");
    if (file_.frames != 1) {
      add({}, fmt::format("the file has {} frames besides the nets", file_.frames));
    }
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

  /// What a piece is sorted by: the part that most of it belongs to, and its area.
  struct Share {
    std::int64_t part = 0;
    bool certain = true;  ///< no other part has as much of it, up to rounding
    double area = 0.0;
  };
  [[nodiscard]] std::vector<Share> shares() const {
    std::vector<std::map<std::int64_t, double>> areas(file_.pieces.size());
    for (Index face = 0; face < file_.faces.faces(); ++face) {
      const Index model = file_.face_model[face];
      areas[file_.face_piece[face]][file_.model.face_part[model]] += given_.relations.area[model];
    }
    std::vector<Share> result(file_.pieces.size());
    for (std::size_t i = 0; i < areas.size(); ++i) {
      double largest = -1.0;
      for (const auto& [part, area] : areas[i]) {
        result[i].area += area;
        if (area > largest) {
          result[i].certain = area * (1.0 - setting_tolerance_share) > largest;
          result[i].part = part;
          largest = area;
        } else if (area > largest * (1.0 - setting_tolerance_share)) {
          result[i].certain = false;
        }
      }
    }
    return result;
  }

  void check_pieces() {
    const std::vector<Share> share = shares();
    for (std::size_t i = 0; i < file_.pieces.size(); ++i) {
      const Piece& piece = file_.pieces[i];
      const std::string name = name_of_piece(i);
      if (piece.name != name) {
        add({{"piece", i}}, fmt::format("{} is the one that should be named \"{}\"",
                                        piece_name(file_, static_cast<Index>(i)), name));
      }
      check_reason(i, share);
    }
  }

  [[nodiscard]] bool wants_few_pieces() const {
    const Setting* const pieces = file_.settings.find("pieces");
    const auto* const word = pieces != nullptr ? std::get_if<std::string>(pieces) : nullptr;
    return word != nullptr && *word == "few";
  }

  /// Whether no piece is mostly of some part.
  [[nodiscard]] bool has_free_part(const std::vector<Share>& share) const {
    return std::any_of(file_.model.face_part.begin(), file_.model.face_part.end(), [&](std::int64_t part) {
      return std::none_of(share.begin(), share.end(), [&](const Share& s) { return s.part == part; });
    });
  }

  /// The largest piece of a part stands for it, and comes first; others say why they are there. Where no
  /// piece is mostly of a part, another one may stand for it.
  void check_reason(std::size_t i, const std::vector<Share>& share) {
    const Piece& piece = file_.pieces[i];
    const auto name = [&] { return piece_name(file_, static_cast<Index>(i)); };
    const bool certain = i == 0 || (share[i].certain && share[i - 1].certain);
    const bool follows = i > 0 && share[i].part == share[i - 1].part;
    if (certain && i > 0 && share[i].part < share[i - 1].part) {
      add({{"piece", i}}, fmt::format("{} comes after pieces of later parts", name()));
    }
    if (certain && follows && share[i].area > share[i - 1].area * (1.0 + setting_tolerance_share)) {
      add({{"piece", i}}, fmt::format("{} comes after smaller pieces of its part", name()));
    }
    const auto asks = [&](std::string_view setting) {
      return file_.settings.find(setting) != nullptr || searched_with(file_.settings, setting) != nullptr;
    };
    // Without a limit of faces pieces can still be hard to cut out or to fold, unless few are wanted above
    // all.
    const bool any_faces = file_.settings.number("max_faces") == 0.0 && wants_few_pieces();
    const bool stands = piece.reason == "part";
    const bool impossible = (certain && (stands ? follows && !has_free_part(share) : !follows)) ||
                            (piece.reason == "page" && !file_.pages[piece.page].bounded) ||
                            (piece.reason == "tabs" && !asks("all_tabs")) ||
                            (piece.reason == "faces" && any_faces) ||
                            (piece.reason == "request" && !asks("cuts") && !asks("keep") && !asks("from") &&
                             !asks("fold_linear") && !asks("page_by") && !asks("edits"));
    if (impossible) {
      add({{"piece", i}}, fmt::format("the reason of {} can't be {}", name(), quote(piece.reason)));
    }
  }

  void check_pages() {
    for (std::size_t p = 0; p < file_.pages.size(); ++p) {
      const Page& page = file_.pages[p];
      const double width = page.high.x - page.low.x;
      if (page.bounded &&
          (std::abs(page.low.x - static_cast<double>(p) * (width + page_gap_mm)) > page_tolerance_mm ||
           std::abs(page.low.y) > page_tolerance_mm)) {
        add({{"page", p}}, fmt::format("page {} isn't at its place in the row of pages", p));
      }
    }
  }

  void check_joins() {
    for (Index j = 0; j < file_.joins.size(); ++j) {
      if (j > 0 && file_.joins[j].number <= file_.joins[j - 1].number) {
        add({{"join", j}},
            fmt::format("{} doesn't come after {}", join_name(file_, j), join_name(file_, j - 1)));
      }
      if (file_.joins[j].tab != none && !file_.joins[j].why.empty()) {
        add({{"join", j}}, fmt::format("{} has a tab and says why it has none", join_name(file_, j)));
      }
    }
  }

  void check_tabs() {
    for (Index t = 0; t < file_.tabs.size(); ++t) {
      const std::vector<Vec2>& polygon = file_.tabs[t].polygon;
      if (!file_.tabs[t].slit && !is_convex(polygon)) {
        add({{"tab", t}}, fmt::format("{} isn't convex", tab_name(file_, t)));
      }
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        if (polygon[k] == polygon[(k + 1) % polygon.size()]) {
          add({{"tab", t}}, fmt::format("{} has a corner twice", tab_name(file_, t)));
        }
      }
      if ((file_.tabs[t].numbers.size() != 1 && !file_.tabs[t].additional) ||
          file_.tabs[t].edges.size() != 1) {
        add({{"tab", t}}, fmt::format("{} is for more than one edge", tab_name(file_, t)));
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

}  // namespace

void check_statements(const Case& given, Findings& findings) {
  StatementCheck(given, findings).run();
}

}  // namespace ridgecraft::verify
