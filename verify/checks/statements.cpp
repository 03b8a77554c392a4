// SPDX-License-Identifier: GPL-3.0-or-later
// Promise 8: what a file says of itself is so. Most of it is asked of files that this program says to have
// made; others need not have our keys, nor our way to name things.
#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "verify/checks/checks.hpp"
#include "verify/checks/settings.hpp"
#include "verify/file/settings_form.hpp"
#include "verify/file/tolerance.hpp"
#include "verify/geometry/polygon.hpp"

namespace ridgecraft::verify {
namespace {

class StatementCheck {
 public:
  StatementCheck(const Case& given, Findings& findings)
      : given_(given), file_(given.file), findings_(findings) {}

  void run() {
    check_shared_numbers();
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

}  // namespace

void check_statements(const Case& given, Findings& findings) {
  StatementCheck(given, findings).run();
}

}  // namespace ridgecraft::verify
