// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/geometry.hpp"
#include "base/option_table.hpp"
#include "verify/checks/checks.hpp"
#include "verify/file/relations.hpp"
#include "verify/file/schema.hpp"
#include "verify/file/tolerance.hpp"
#include "verify/geometry/geometry.hpp"

namespace ridgecraft::verify {
namespace {

/// Which jobs have the setting: those with pages, those without, both; or whoever asked for it.
enum class Needed { always, with_pages, without_pages, never };

struct Known {
  Needed needed;
  bool (*fits)(const Setting& value, const Option* row);
  const Option* row = nullptr;  ///< of the option that it is the setting of, where it is that of one
};

constexpr double any = std::numeric_limits<double>::infinity();

bool is_number(const Setting& value, double low, double high) {
  const double* const number = std::get_if<double>(&value);
  return number != nullptr && *number >= low && *number <= high;
}

bool is_yes_or_no(const Setting& value, const Option* /*row*/) {
  return std::holds_alternative<bool>(value);
}

bool is_text(const Setting& value, const Option* /*row*/) {
  const std::string* const text = std::get_if<std::string>(&value);
  return text != nullptr && !text->empty();
}

bool is_hash_text(const Setting& value, const Option* /*row*/) {
  const std::string* const hash = std::get_if<std::string>(&value);
  return hash != nullptr && is_hash(*hash);
}

bool is_length(const Setting& value, const Option* /*row*/) {
  return is_number(value, 0.0, max_coordinate_mm);
}

bool is_scale(const Setting& value, const Option* /*row*/) {
  return is_number(value, std::numeric_limits<double>::min(), any);
}

bool is_sheet(const Setting& value, const Option* /*row*/) {
  const auto* const size = std::get_if<std::vector<double>>(&value);
  return size != nullptr && size->size() == 2 && (*size)[0] > 0.0 && (*size)[1] > 0.0;
}

template <const char* word>
bool is_word(const Setting& value, const Option* /*row*/) {
  const std::string* const text = std::get_if<std::string>(&value);
  return text != nullptr && *text == word;
}

bool is_choice(const Setting& value, const Option* row) {
  const std::string* const word = std::get_if<std::string>(&value);
  return word != nullptr && std::any_of(row->choices.begin(), row->choices.end(),
                                        [&](const OptionChoice& choice) { return choice.word == *word; });
}

/// A value of the option, as a setting holds it.
bool is_of_option(const Setting& value, const Option* row) {
  constexpr double angle_tolerance_deg = 1e-6;  // ten digits of what is kept in radians
  switch (row->kind) {
    case OptionKind::flag:
      return is_yes_or_no(value, row);
    case OptionKind::choice:
      return is_choice(value, row);
    case OptionKind::file:
      return is_hash_text(value, row);
    case OptionKind::length:
    case OptionKind::number:
      return is_number(value, row->low, row->high);
    case OptionKind::angle:
      return is_number(value, row->low - angle_tolerance_deg, row->high + angle_tolerance_deg);
    case OptionKind::whole: {
      const double* const number = std::get_if<double>(&value);
      return is_choice(value, row) ||
             (is_number(value, row->low, row->high) && std::floor(*number) == *number);
    }
    case OptionKind::text:
    case OptionKind::list:
      return is_text(value, row);
  }
  return false;
}

/// The setting of a list of weights begins so, and goes on with the term's name, which is the program's
/// affair.
constexpr std::string_view weight_prefix = "weigh_";

bool is_weight(const Setting& value, const Option* row) {
  return is_number(value, row->low, row->high);
}

constexpr char united_word[] = "united";
constexpr char apart_word[] = "apart";

/// Those of options, and those that no option gives.
const std::map<std::string_view, Known>& known_settings() {
  static const std::map<std::string_view, Known> all = [] {
    std::map<std::string_view, Known> known{
        {"bodies", {Needed::never, is_word<united_word>}}, {"standing", {Needed::never, is_word<apart_word>}},
        {"tabs", {Needed::always, is_yes_or_no}},          {"tab_heights", {Needed::never, is_text}},
        {"tab_angles", {Needed::never, is_text}},          {"judged_at_mm", {Needed::never, is_length}},
        {"mm_per_unit", {Needed::never, is_scale}},        {"edits", {Needed::never, is_text}},
        {"paper_mm", {Needed::with_pages, is_sheet}},      {"gap_mm", {Needed::with_pages, is_length}},
        {"whole", {Needed::without_pages, is_yes_or_no}}};
    for (const Option& row : option_table()) {
      if (row.setting == weight_prefix) {
        known[row.setting] = {Needed::with_pages, is_weight, &row};
      } else if (!row.setting.empty()) {
        known[row.setting] = {row.noted == Noted::always       ? Needed::always
                              : row.noted == Noted::with_pages ? Needed::with_pages
                                                               : Needed::never,
                              is_of_option, &row};
      }
    }
    return known;
  }();
  return all;
}

/// Nets may have got other tabs and pages since they were searched: before the name of what was another then.
constexpr std::string_view searched_prefix = "searched_";

/// None for an unknown setting.
const Known* find_known(std::string_view name) {
  const bool weight = name.starts_with(weight_prefix) && name.size() > weight_prefix.size() &&
                      std::all_of(name.begin() + weight_prefix.size(), name.end(),
                                  [](char c) { return c >= 'a' && c <= 'z'; });
  const auto found = known_settings().find(weight ? weight_prefix : name);
  return found == known_settings().end() || (name == weight_prefix) ? nullptr : &found->second;
}

bool has(const Settings& settings, std::string_view name) {
  return settings.find(name) != nullptr;
}

bool is_needed(const Known& known, bool with_pages) {
  return known.needed == Needed::always ||
         known.needed == (with_pages ? Needed::with_pages : Needed::without_pages);
}

bool is_allowed(const Known& known, bool with_pages) {
  return known.needed == Needed::never || is_needed(known, with_pages);
}

/// Settings that exclude or need each other.
void check_together(const Settings& settings, std::vector<std::string>& faults) {
  if (has(settings, "size_mm") == has(settings, "mm_per_unit")) {
    faults.emplace_back("the settings have to tell the size or the scale, and only one of them");
  }
  if (is_true(settings, "all_tabs") && !is_true(settings, "tabs")) {
    faults.emplace_back("the settings ask for all tabs and for none");
  }
  // Nets made before hold the faces that they were simplified to.
  const bool named_edges = has(settings, "cuts") || has(settings, "keep");
  const Setting* const faces = settings.find("faces");
  if (named_edges && faces != nullptr && *faces != Setting(std::string("keep"))) {
    faults.emplace_back("the settings name edges of the model, but don't keep its faces");
  }
}

/// The nets against settings that are known to be right by themselves.
class Contradictions {
 public:
  explicit Contradictions(const Case& given)
      : given_(given), file_(given.file), settings_(given.file.settings) {}

  std::vector<std::string> find() {
    check_size();
    check_pages();
    check_gaps();
    check_tabs();
    check_faces();
    check_whole();
    return std::move(faults_);
  }

 private:
  template <typename... Args>
  void add(fmt::format_string<Args...> text, Args&&... args) {
    faults_.push_back(fmt::format(text, std::forward<Args>(args)...));
  }

  static bool differ(double a, double b) {
    return std::abs(a - b) > setting_tolerance_fraction * std::max(std::abs(a), std::abs(b));
  }

  void check_size() {
    const std::optional<double> asked = settings_.number("size_mm");
    Box3 box;
    for (Index side = 0; side < file_.model.faces.sides(); ++side) {
      box.add(file_.model.points[file_.model.faces.tail(side)]);
    }
    const Vec3 size = box.size();
    const double largest = std::max({size.x, size.y, size.z});
    if (asked && differ(*asked, largest)) {
      add("the settings ask for a size of {:.9g} mm, the model is {:.9g} mm large", *asked, largest);
    }
  }

  void check_pages() {
    const auto* const setting = settings_.find("paper_mm");
    if (setting == nullptr) {
      return;
    }
    const auto& paper = std::get<std::vector<double>>(*setting);
    const double margin = settings_.number("margin_mm").value_or(0.0);
    for (std::size_t p = 0; p < file_.pages.size(); ++p) {
      const Page& page = file_.pages[p];
      if (!page.bounded || differ(page.high.x - page.low.x, paper[0]) ||
          differ(page.high.y - page.low.y, paper[1])) {
        add("page {} isn't as large as the paper of the settings", p);
      } else if (std::any_of(page.margins.begin(), page.margins.end(),
                             [&](double m) { return differ(m, margin); })) {
        add("the margins of page {} aren't those of the settings", p);
      }
    }
  }

  /// Pieces of one page are as far apart as the settings say.
  void check_gaps() {
    const double gap = settings_.number("gap_mm").value_or(0.0) - gap_tolerance_mm;
    if (!(gap > 0.0)) {
      return;
    }
    std::vector<PieceLine> lines = lines_of_pieces();
    std::vector<Box2> boxes;
    for (const PieceLine& line : lines) {
      boxes.push_back(box_of(line.ends));
    }
    const BoxFinder tree(boxes);
    std::set<std::pair<Index, Index>> close;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      given_.context.check();
      tree.for_each_overlapping(grown(boxes[i], gap), [&](std::size_t k) {
        const auto pair = std::minmax(lines[i].piece, lines[k].piece);
        if (pair.first != pair.second && file_.pieces[pair.first].page == file_.pieces[pair.second].page &&
            !close.contains(pair) &&
            segment_distance(lines[i].ends[0], lines[i].ends[1], lines[k].ends[0], lines[k].ends[1]) < gap) {
          close.insert(pair);
        }
      });
    }
    for (const auto& [one, other] : close) {
      add("{} and {} are less than {:.6g} mm apart, which the settings ask for", piece_name(file_, one),
          piece_name(file_, other), gap + gap_tolerance_mm);
    }
  }

  struct PieceLine {
    std::array<Vec2, 2> ends;
    Index piece;
  };
  /// Cut edges and the sides of tabs.
  [[nodiscard]] std::vector<PieceLine> lines_of_pieces() const {
    std::vector<PieceLine> lines;
    for (Index e = 0; e < file_.edges.size(); ++e) {
      if (file_.edges[e].assignment == Assignment::cut) {
        const auto [a, b] = file_.edges[e].ends;
        lines.push_back({{file_.points[a], file_.points[b]}, piece_of_edge(file_, given_.relations, e)});
      }
    }
    for (const Tab& tab : file_.tabs) {
      const Index piece = piece_of_edge(file_, given_.relations, tab.edge);
      for (std::size_t k = 0; k < tab.polygon.size(); ++k) {
        lines.push_back({{tab.polygon[k], tab.polygon[(k + 1) % tab.polygon.size()]}, piece});
      }
    }
    return lines;
  }

  void check_tabs() {
    if (!is_true(settings_, "tabs") && !file_.tabs.empty()) {
      add("the settings ask for no tabs, and there are {}", file_.tabs.size());
      return;
    }
    const double height = settings_.number("tab_height_mm").value_or(std::numeric_limits<double>::infinity());
    for (Index t = 0; t < file_.tabs.size(); ++t) {
      const std::vector<Vec2>& polygon = file_.tabs[t].polygon;
      const Vec2 base = polygon[1] - polygon[0];
      double highest = 0.0;
      for (const Vec2 p : polygon) {
        highest = std::max(highest, std::abs(cross(base, p - polygon[0])) / length(base));
      }
      if (highest > height + tab_base_tolerance_mm) {
        add("{} is {:.6g} mm high, the settings allow {:.6g} mm", tab_name(file_, t), highest, height);
      }
    }
  }

  /// How often pieces were joined by hand.
  [[nodiscard]] std::size_t joins_by_hand() const {
    const Setting* const edits = settings_.find("edits");
    const auto* const text = edits == nullptr ? nullptr : std::get_if<std::string>(edits);
    std::size_t joins = 0;
    if (text != nullptr) {
      constexpr std::string_view join = "join ";
      for (std::size_t at = text->find(join); at != std::string::npos;
           at = text->find(join, at + join.size())) {
        ++joins;
      }
    }
    return joins;
  }

  /// Flat regions of a piece can't be more than its plates: what lies in one region is folded by less. Each
  /// join by hand may add a piece that has as many as are allowed.
  void check_faces() {
    const double allowed =
        settings_.number("max_faces").value_or(0.0) * static_cast<double>(1 + joins_by_hand());
    const auto most = static_cast<Index>(std::min(allowed, 4e9));
    if (most == 0 || settings_.find("keep") != nullptr || settings_.find("from") != nullptr) {
      return;
    }
    const Plates plates = find_plates(file_, given_.relations, flat_region_fold_deg);
    std::vector<std::set<Index>> of_piece(file_.pieces.size());
    for (Index face = 0; face < file_.faces.faces(); ++face) {
      of_piece[file_.face_piece[face]].insert(plates.plate[face]);
    }
    for (Index piece = 0; piece < file_.pieces.size(); ++piece) {
      if (of_piece[piece].size() > most) {
        add("{} has {} flat faces, the settings allow {}", piece_name(file_, piece), of_piece[piece].size(),
            most);
      }
    }
  }

  /// Without parts each component is one.
  void check_whole() {
    if (!is_true(settings_, "whole")) {
      return;
    }
    const Model& model = file_.model;
    for (Index side = 0; side < model.faces.sides(); ++side) {
      const Index twin = model.twin[side];
      if (twin != none &&
          model.face_part[model.faces.face(side)] != model.face_part[model.faces.face(twin)]) {
        add("the settings ask for whole components, and faces {} and {} of the model are of two parts",
            model.faces.face(side), model.faces.face(twin));
        return;
      }
    }
  }

  const Case& given_;
  const File& file_;
  const Settings& settings_;
  std::vector<std::string> faults_;
};

}  // namespace

bool is_true(const Settings& settings, std::string_view name) {
  const Setting* const value = settings.find(name);
  const bool* const answer = value == nullptr ? nullptr : std::get_if<bool>(value);
  return answer != nullptr && *answer;
}

const Setting* searched_with(const Settings& settings, std::string_view name) {
  return settings.find(std::string(searched_prefix) + std::string(name));
}

bool is_hash(std::string_view text) {
  constexpr std::size_t fewest = 8;
  constexpr std::size_t most = 64;
  return text.size() >= fewest && text.size() <= most &&
         text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

std::vector<std::string> faults_of_settings(const Settings& settings) {
  std::vector<std::string> faults;
  const bool with_pages = !has(settings, "whole");
  for (const auto& [name, value] : settings.all) {
    const bool earlier = name.starts_with(searched_prefix);
    const Known* const known =
        find_known(std::string_view(name).substr(earlier ? searched_prefix.size() : 0));
    if (known == nullptr) {
      faults.push_back(fmt::format("unknown setting {}", quote(name)));
      continue;
    }
    if (!known->fits(value, known->row)) {
      faults.push_back(fmt::format("the setting \"{}\" has a value that no option takes", name));
    }
    if (!earlier && !is_allowed(*known, with_pages)) {
      faults.push_back(fmt::format("the settings can't have \"{}\"", name));
    }
  }
  for (const auto& [name, known] : known_settings()) {
    if (name != weight_prefix && is_needed(known, with_pages) && !has(settings, name)) {
      faults.push_back(fmt::format("the settings lack \"{}\"", name));
    }
  }
  check_together(settings, faults);
  return faults;
}

std::vector<std::string> contradictions(const Case& given) {
  return Contradictions(given).find();
}

}  // namespace ridgecraft::verify
