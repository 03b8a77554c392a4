// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/file/form_statements.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <span>
#include <utility>

namespace ridgecraft::verify {
namespace {

constexpr std::string_view whole_file = "the file";
constexpr std::string_view own_prefix = "ridgecraft:";
/// More unknown keys than this aren't listed.
constexpr std::size_t most_unknown = 20;

Setting setting_of(const Json& value) {
  if (value.is_boolean()) {
    return value.get<bool>();
  }
  if (value.is_number()) {
    return value.get<double>();
  }
  if (value.is_string()) {
    return value.get<std::string>();
  }
  if (value.is_array() &&
      std::all_of(value.begin(), value.end(), [](const Json& entry) { return entry.is_number(); })) {
    return value.get<std::vector<double>>();
  }
  return std::monostate{};
}

void read_settings(const Json& json, File& file) {
  const Json& settings = member(json, "ridgecraft:settings", whole_file);
  if (!settings.is_object()) {
    refuse("\"ridgecraft:settings\" of the file is not an object");
  }
  for (const auto& [name, value] : settings.items()) {
    file.settings.all.emplace_back(name, setting_of(value));
  }
}

/// Which axis points up; a file needn't tell.
void read_up(const Json& json) {
  if (!json.contains("ridgecraft:up")) {
    return;
  }
  const std::string& up = text_member(json, "ridgecraft:up", whole_file);
  if (up != "x" && up != "y" && up != "z") {
    refuse("\"ridgecraft:up\" of the file is {}, not x, y or z", quote(up));
  }
}

void read_digest(const Json& json, File& file) {
  if (json.contains("ridgecraft:model_digest")) {
    file.digest = text_member(json, "ridgecraft:model_digest", whole_file);
  }
}

std::vector<std::vector<Index>> read_steps(const Json& steps, std::size_t edges, const std::string& where) {
  std::vector<std::vector<Index>> result;
  if (!steps.is_array()) {
    refuse("{} is not a list of steps", where);
  }
  for (const Json& step : steps) {
    if (!step.is_array() || step.empty()) {
      refuse("step {} of {} is not a list of edges", result.size(), where);
    }
    std::vector<Index>& folds = result.emplace_back();
    for (const Json& edge : step) {
      folds.push_back(index_below(edge, edges, {where, "edge"}));
    }
  }
  return result;
}

void read_fold_order(const Json& json, File& file) {
  const auto found = json.find("ridgecraft:fold_order");
  if (found == json.end()) {
    return;
  }
  if (!found->is_array() || found->size() != file.pieces.size()) {
    refuse("\"ridgecraft:fold_order\" of the file is not a list with an entry for each piece");
  }
  file.fold_order.emplace();
  for (const Json& steps : *found) {
    const std::string where = fmt::format("the fold order of piece {}", file.fold_order->size());
    file.fold_order->push_back(read_steps(steps, file.edges.size(), where));
  }
}

/// Kinds of pieces that are said to be equal; a file needn't tell any.
void read_equal_pieces(const Json& json, File& file) {
  const auto found = json.find("ridgecraft:equal_pieces");
  if (found == json.end()) {
    return;
  }
  if (!found->is_array()) {
    refuse("\"ridgecraft:equal_pieces\" of the file is not a list");
  }
  std::vector<bool> named(file.pieces.size(), false);
  for (const Json& kind : *found) {
    const std::string where = fmt::format("kind {} of equal pieces", file.equal.size());
    if (!kind.is_array() || kind.size() < 2) {
      refuse("{} is not a list of two pieces or more", where);
    }
    std::vector<EqualPiece>& pieces = file.equal.emplace_back();
    for (const Json& entry : kind) {
      if (!entry.is_object()) {
        refuse("{} has an entry that is not an object", where);
      }
      const Json& mirrored = member(entry, "mirrored", where);
      if (!mirrored.is_boolean() || (pieces.empty() && mirrored.get<bool>())) {
        refuse("\"mirrored\" of {} is not true or false, false for the first", where);
      }
      const auto other_tabs = entry.find("other_tabs");
      const bool tells_of_tabs = other_tabs != entry.end();
      if (tells_of_tabs && (!other_tabs->is_boolean() || (pieces.empty() && other_tabs->get<bool>()))) {
        refuse("\"other_tabs\" of {} is not true or false, false for the first", where);
      }
      const Index piece = index_below(member(entry, "piece", where), file.pieces.size(), {where, "piece"});
      if (named[piece]) {
        refuse("piece {} is named twice among equal pieces", piece);
      }
      if (!pieces.empty() && piece < pieces.back().piece) {
        refuse("the pieces of {} are not in their order", where);
      }
      named[piece] = true;
      pieces.push_back({piece, mirrored.get<bool>(), tells_of_tabs && other_tabs->get<bool>()});
    }
  }
}

/// The order in which pieces are put together; a file needn't tell it.
void read_assembly(const Json& json, File& file) {
  const auto found = json.find("ridgecraft:assembly");
  if (found == json.end()) {
    return;
  }
  if (!found->is_array()) {
    refuse("\"ridgecraft:assembly\" of the file is not a list");
  }
  file.assembly.emplace();
  for (const Json& entry : *found) {
    const std::string where = fmt::format("step {} of the assembly", file.assembly->size());
    if (!entry.is_object()) {
      refuse("{} is not an object", where);
    }
    AssemblyStep step;
    for (const Json& piece : list_member(entry, "pieces", where)) {
      step.pieces.push_back(index_below(piece, file.pieces.size(), {where, "pieces"}));
    }
    for (const Json& number : list_member(entry, "joins", where)) {
      if (!number.is_number_integer()) {
        refuse("\"joins\" of {} has an entry that is no number of a join", where);
      }
      step.joins.push_back(number.get<std::int64_t>());
    }
    const auto rises = [](const auto& list) {
      return std::adjacent_find(list.begin(), list.end(), std::greater_equal<>()) == list.end();
    };
    if (step.pieces.empty() || !rises(step.pieces) || !rises(step.joins)) {
      refuse("{} has no pieces, or pieces or joins that are not in their order", where);
    }
    file.assembly->push_back(std::move(step));
  }
}

class KeyWatch {
 public:
  explicit KeyWatch(std::vector<std::string>& unknown) : unknown_(unknown) {}

  /// Notes the keys of the object that aren't known, of our namespace only where there are others, too.
  void look(const Json& object, std::span<const std::string_view> known, std::string_view prefix,
            const std::string& where) {
    for (const auto& [key, value] : object.items()) {
      if (key.starts_with(prefix) && std::find(known.begin(), known.end(), key) == known.end() &&
          unknown_.size() < most_unknown) {
        unknown_.push_back(fmt::format("{} of {}", quote(key), where));
      }
    }
  }

  void look_at_all(const Json& list, std::span<const std::string_view> known, const char* what) {
    std::size_t number = 0;
    for (const Json& object : list) {
      look(object, known, "", fmt::format("{} {}", what, number++));
    }
  }

 private:
  std::vector<std::string>& unknown_;
};

void note_unknown_keys(const Json& json, File& file) {
  constexpr std::array<std::string_view, 14> top = {"ridgecraft:faces_model", "ridgecraft:faces_piece",
                                                    "ridgecraft:pieces",      "ridgecraft:fold_order",
                                                    "ridgecraft:pages",       "ridgecraft:joins",
                                                    "ridgecraft:tabs",        "ridgecraft:model_digest",
                                                    "ridgecraft:settings",    "ridgecraft:equal_pieces",
                                                    "ridgecraft:assembly",    "ridgecraft:more_tabs",
                                                    "ridgecraft:glue",        "ridgecraft:up"};
  constexpr std::array<std::string_view, 3> equal = {"piece", "mirrored", "other_tabs"};
  constexpr std::array<std::string_view, 2> assembly = {"pieces", "joins"};
  constexpr std::array<std::string_view, 1> model = {"ridgecraft:faces_part"};
  constexpr std::array<std::string_view, 6> piece = {"name", "part", "parts", "page", "holes", "reason"};
  constexpr std::array<std::string_view, 3> page = {"origin", "size", "margins"};
  constexpr std::array<std::string_view, 4> join = {"number", "edges", "tab", "why"};
  constexpr std::array<std::string_view, 3> glue = {"piece", "other", "outlines"};
  constexpr std::array<std::string_view, 6> tab = {"edge", "edges", "polygon", "joins", "slit", "foot"};
  KeyWatch watch(file.unknown_keys);
  watch.look(json, top, own_prefix, "the file");
  watch.look(json.at("file_frames").at(0), model, own_prefix, "the model's frame");
  watch.look_at_all(json.at("ridgecraft:pieces"), piece, "piece");
  watch.look_at_all(json.at("ridgecraft:pages"), page, "page");
  watch.look_at_all(json.at("ridgecraft:joins"), join, "join");
  watch.look_at_all(json.at("ridgecraft:tabs"), tab, "tab");
  if (const auto more = json.find("ridgecraft:more_tabs"); more != json.end()) {
    watch.look_at_all(*more, tab, "additional tab");
  }
  if (const auto spots = json.find("ridgecraft:glue"); spots != json.end()) {
    watch.look_at_all(*spots, glue, "glue spot");
  }
  if (const auto steps = json.find("ridgecraft:assembly"); steps != json.end()) {
    watch.look_at_all(*steps, assembly, "assembly step");
  }
  if (const auto kinds = json.find("ridgecraft:equal_pieces"); kinds != json.end()) {
    for (const Json& kind : *kinds) {
      watch.look_at_all(kind, equal, "equal piece");
    }
  }
}

}  // namespace

const Setting* Settings::find(std::string_view name) const {
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& entry) { return entry.first == name; });
  return found == all.end() ? nullptr : &found->second;
}

std::optional<double> Settings::number(std::string_view name) const {
  const Setting* const setting = find(name);
  const double* const value = setting == nullptr ? nullptr : std::get_if<double>(setting);
  return value == nullptr ? std::nullopt : std::optional(*value);
}

void read_statements(const Json& json, File& file) {
  read_settings(json, file);
  read_digest(json, file);
  read_up(json);
  read_fold_order(json, file);
  read_equal_pieces(json, file);
  read_assembly(json, file);
  note_unknown_keys(json, file);
}

}  // namespace ridgecraft::verify
