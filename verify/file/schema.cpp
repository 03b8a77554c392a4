// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/file/schema.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "verify/file/tolerance.hpp"

namespace ridgecraft::verify {
namespace {

/// Builds the value as the library's own parser does, and looks at depth and keys on the way: reading every
/// file a second time for these would take as long again.
class Builder {
 public:
  bool null() { return leaf(nullptr); }
  bool boolean(bool value) { return leaf(value); }
  bool number_integer(std::int64_t value) { return leaf(value); }
  bool number_unsigned(std::uint64_t value) { return leaf(value); }
  bool number_float(double value, const std::string& /*unused*/) { return leaf(value); }
  bool string(std::string& value) { return leaf(std::move(value)); }
  bool binary(Json::binary_t& value) { return leaf(std::move(value)); }
  bool start_object(std::size_t /*unused*/) { return open(Json::object()); }
  bool key(std::string& key) {
    const auto [member, added] = open_.back()->get_ref<Json::object_t&>().try_emplace(key);
    if (!added) {
      refuse("the file has the key {} twice in one object", quote(key));
    }
    member_ = &member->second;
    return true;
  }
  bool end_object() {
    open_.pop_back();
    return true;
  }
  bool start_array(std::size_t /*unused*/) { return open(Json::array()); }
  bool end_array() { return end_object(); }
  template <class Exception>
  bool parse_error(std::size_t /*unused*/, const std::string& /*unused*/, const Exception& error) {
    throw error;
  }

  [[nodiscard]] Json take() { return std::move(root_); }

 private:
  /// Where the next value goes. Nothing that is open moves: only the last one of a list is.
  Json& add(Json value) {
    if (open_.size() > max_json_depth) {
      refuse("the file is not in the form of the contract: lists are nested deeper than {}", max_json_depth);
    }
    if (open_.empty()) {
      return root_ = std::move(value);
    }
    if (Json& parent = *open_.back(); parent.is_array()) {
      return parent.get_ref<Json::array_t&>().emplace_back(std::move(value));
    }
    return *member_ = std::move(value);
  }
  bool leaf(Json value) {
    add(std::move(value));
    return true;
  }
  bool open(Json value) {
    open_.push_back(&add(std::move(value)));
    return true;
  }

  Json root_;
  std::vector<Json*> open_;  ///< lists and objects, from the outermost on
  Json* member_ = nullptr;   ///< of the object that is open
};

struct Place {
  std::size_t line = 1, column = 1;
};

Place place_of(std::string_view bytes, std::size_t byte) {
  const std::string_view before = bytes.substr(0, byte > 0 ? std::min(byte - 1, bytes.size()) : 0);
  const auto lines = static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
  const std::size_t last = before.rfind('\n');
  return {lines + 1, last == std::string_view::npos ? before.size() + 1 : before.size() - last};
}

enum class Type : unsigned char { any, text, number, whole, one_of, list, object };
enum class Need : unsigned char { required, optional, ours };  ///< ours: required in files of this program
enum class Order : unsigned char { any, distinct, ascending };

/// Lists that indices point into, or that others are as long as.
enum class ListOf : unsigned char {
  nothing,
  model_vertices,
  model_faces,
  vertices,
  edges,
  faces,
  pages,
  pieces,
  tabs,
  joins,
  end
};

struct Member;

/// What a value has to be.
struct Rule {
  Type type = Type::any;
  bool or_null = false;
  double low = 0.0, high = 0.0;         ///< of a number, or of the number of entries of a list
  ListOf below = ListOf::nothing;       ///< of an index: the list that it points into
  ListOf as_long_as = ListOf::nothing;  ///< of a list: the one that has as many entries
  ListOf counts = ListOf::nothing;      ///< of a list: what its entries are
  Order order = Order::any;             ///< of the entries of a list of whole numbers
  std::vector<Json> words;              ///< one of these; of a list: among its entries
  std::vector<Rule> entries;            ///< of a list: of the first ones, the last of all that follow
  std::vector<Member> members;          ///< of an object; without any it may have all keys
  std::string_view watched;             ///< of an object: what its unknown keys begin with
};

struct Member {
  const char* key;
  Rule rule;
  Need need = Need::required;
};

constexpr double unlimited = std::numeric_limits<double>::infinity();
/// Every reader of JSON keeps whole numbers up to here.
constexpr double largest_exact = static_cast<double>((std::int64_t{1} << 53) - 1);
constexpr std::size_t most_unknown = 20;

Rule of_type(Type type, double low = 0.0, double high = 0.0) {
  Rule rule;
  rule.type = type;
  rule.low = low;
  rule.high = high;
  return rule;
}

Rule text() {
  return of_type(Type::text);
}

Rule number(double low, double high) {
  return of_type(Type::number, low, high);
}

Rule whole(double low, double high) {
  return of_type(Type::whole, low, high);
}

Rule index_of(ListOf list) {
  Rule rule = whole(0.0, unlimited);
  rule.below = list;
  return rule;
}

Rule one_of(std::vector<Json> words) {
  Rule rule = of_type(Type::one_of);
  rule.words = std::move(words);
  return rule;
}

Rule list(Rule entry, double least = 0.0, double most = unlimited) {
  Rule rule = of_type(Type::list, least, most);
  rule.entries.push_back(std::move(entry));
  return rule;
}

Rule list_as_long_as(ListOf other, Rule entry) {
  Rule rule = list(std::move(entry));
  rule.as_long_as = other;
  return rule;
}

/// FOLD leaves room for further classes and attributes; one of them must be this.
Rule words_with(const char* word) {
  Rule rule = list({});
  rule.words.emplace_back(word);
  return rule;
}

Rule object(std::vector<Member> members, std::string_view watched = "") {
  Rule rule = of_type(Type::object);
  rule.members = std::move(members);
  rule.watched = watched;
  return rule;
}

Rule or_null(Rule rule) {
  rule.or_null = true;
  return rule;
}

Rule counting(ListOf what, Rule rule) {
  rule.counts = what;
  return rule;
}

Rule in_order(Order order, Rule rule) {
  rule.order = order;
  return rule;
}

Rule point(double dimensions) {
  return list(number(-max_coordinate_mm, max_coordinate_mm), dimensions, dimensions);
}

Rule polygon() {
  return list(point(2), 3);
}

Rule part() {
  return whole(-largest_exact, largest_exact);
}

Rule faces(ListOf what, ListOf vertices) {
  return counting(what, list(in_order(Order::distinct, list(index_of(vertices), 3)), 1));
}

constexpr std::string_view own = "ridgecraft:";

Rule model_form() {
  using L = ListOf;
  return object({{"frame_classes", words_with("foldedForm")},
                 {"frame_attributes", words_with("3D")},
                 {"frame_unit", one_of({"mm"})},
                 {"frame_inherit", one_of({false}), Need::optional},
                 {"vertices_coords", counting(L::model_vertices, list(point(3)))},
                 {"faces_vertices", faces(L::model_faces, L::model_vertices)},
                 {"ridgecraft:faces_part", list_as_long_as(L::model_faces, part())}},
                own);
}

Rule page_form() {
  const Rule positive = number(std::numeric_limits<double>::min(), max_coordinate_mm);
  return object({{"origin", point(2)},
                 {"size", or_null(list(positive, 2, 2))},
                 {"margins", or_null(list(number(0.0, max_coordinate_mm), 4, 4)), Need::optional}});
}

Rule piece_form() {
  return object(
      {{"name", text()},
       {"part", or_null(part())},
       {"parts", list(part())},
       {"page", index_of(ListOf::pages)},
       {"holes", whole(0.0, 999'999'999.0), Need::optional},
       {"reason", one_of({"part", "page", "overlap", "tabs", "faces", "time", "request", "component"})}});
}

Rule join_number() {
  return whole(1.0, largest_exact);
}

Rule tab_form(double least_joins) {
  using L = ListOf;
  return object({{"edge", index_of(L::edges)},
                 {"edges", in_order(Order::distinct, list(index_of(L::edges), 1)), Need::optional},
                 {"polygon", polygon()},
                 {"slit", list(point(2), 2, 2), Need::optional},
                 {"foot", one_of({true, false}), Need::optional},
                 {"joins", list(join_number(), least_joins)}});
}

/// Promise 5 asks why a join has no tab.
Rule join_form() {
  return object({{"number", join_number()},
                 {"edges", list(index_of(ListOf::edges), 2, 2)},
                 {"tab", or_null(index_of(ListOf::tabs))},
                 {"why", {}, Need::optional}});
}

Rule chain_form() {
  return object(
      {{"number", join_number()}, {"joins", in_order(Order::distinct, list(index_of(ListOf::joins), 1))}});
}

Rule glue_form() {
  return object({{"piece", index_of(ListOf::pieces)},
                 {"other", index_of(ListOf::pieces)},
                 {"outlines", list(polygon(), 1)}});
}

Rule equal_piece_form() {
  return object({{"piece", index_of(ListOf::pieces)},
                 {"mirrored", one_of({true, false})},
                 {"other_tabs", one_of({true, false}), Need::optional}});
}

Rule assembly_step_form() {
  return object({{"pieces", in_order(Order::ascending, list(index_of(ListOf::pieces), 1))},
                 {"joins", in_order(Order::ascending, list(join_number()))}});
}

/// Sections 1 to 3 of the contract, and what docs/reference/formats.md adds. Lists come before what points
/// into them.
Rule file_form() {
  using L = ListOf;
  Rule frames = list(model_form(), 1);
  frames.entries.emplace_back();
  const Rule ends = in_order(Order::distinct, list(index_of(L::vertices), 2, 2));
  const Rule steps = list(list(index_of(L::edges), 1));
  return object({{"file_spec", one_of({1.2})},
                 {"file_creator", text()},
                 {"file_title", text()},
                 {"file_classes", words_with("multiModel")},
                 {"frame_classes", words_with("creasePattern")},
                 {"frame_attributes", words_with("2D")},
                 {"frame_unit", one_of({"mm"})},
                 {"file_frames", frames},
                 {"vertices_coords", counting(L::vertices, list(point(2)))},
                 {"faces_vertices", faces(L::faces, L::vertices)},
                 {"edges_vertices", counting(L::edges, list(ends))},
                 {"edges_assignment", list_as_long_as(L::edges, one_of({"B", "M", "V", "F"}))},
                 {"edges_foldAngle", list_as_long_as(L::edges, number(-180.0, 180.0))},
                 {"edges_ridgecraft:bent", list_as_long_as(L::edges, one_of({true, false})), Need::optional},
                 {"ridgecraft:pages", counting(L::pages, list(page_form()))},
                 {"ridgecraft:pieces", counting(L::pieces, list(piece_form()))},
                 {"ridgecraft:faces_model", list_as_long_as(L::faces, index_of(L::model_faces))},
                 {"ridgecraft:faces_piece", list_as_long_as(L::faces, index_of(L::pieces))},
                 {"ridgecraft:tabs", counting(L::tabs, list(tab_form(1)))},
                 {"ridgecraft:more_tabs", list(tab_form(0)), Need::optional},
                 {"ridgecraft:joins", counting(L::joins, list(join_form()))},
                 {"ridgecraft:chains", list(chain_form()), Need::ours},
                 {"ridgecraft:settings", object({})},
                 {"ridgecraft:model_digest", text(), Need::ours},
                 {"ridgecraft:up", one_of({"x", "y", "z"}), Need::optional},
                 {"ridgecraft:fold_order", list_as_long_as(L::pieces, steps), Need::ours},
                 {"ridgecraft:equal_pieces", list(list(equal_piece_form(), 2)), Need::optional},
                 {"ridgecraft:assembly", list(assembly_step_form()), Need::optional},
                 {"ridgecraft:glue", list(glue_form()), Need::optional}},
                own);
}

/// Goes through a value and its rule together, and remembers where it is.
class Walk {
 public:
  void check(const Json& value, const Rule& rule) {
    if (rule.or_null && value.is_null()) {
      return;
    }
    switch (rule.type) {
      case Type::any:
        return;
      case Type::text:
        return expect(value.is_string(), "a text");
      case Type::number:
        expect(value.is_number(), "a number");
        return check_range(value, rule.low, rule.high);
      case Type::whole:
        expect(value.is_number_integer(), "a whole number");
        return check_range(value, rule.low,
                           rule.below == ListOf::nothing ? rule.high : length(rule.below) - 1.0);
      case Type::one_of:
        return check_word(value, rule.words);
      case Type::list:
        return check_list(value, rule);
      case Type::object:
        return check_object(value, rule);
    }
  }

  [[nodiscard]] std::vector<std::string> take_remarks() { return std::move(remarks_); }

 private:
  /// A member of an object, or an entry of a list.
  struct Step {
    const char* key = nullptr;
    std::size_t index = 0;
  };

  [[nodiscard]] double& length(ListOf list) { return lengths_[static_cast<std::size_t>(list)]; }

  /// ridgecraft:tabs[3].polygon[0][1]
  [[nodiscard]] std::string place() const {
    std::string words;
    for (const Step& step : path_) {
      if (step.key == nullptr) {
        words += fmt::format("[{}]", step.index);
      } else {
        words += (words.empty() ? "" : ".") + std::string(step.key);
      }
    }
    return words.empty() ? "the file" : words;
  }

  static std::string words_of(const Json& value) {
    if (value.is_structured()) {
      return value.is_array() ? "a list" : "an object";
    }
    return value.is_string() ? quote(value.get_ref<const std::string&>()) : value.dump();
  }

  void expect(bool holds, const char* type) const {
    if (!holds) {
      refuse("{} is not {}", place(), type);
    }
  }

  void check_range(const Json& value, double low, double high) const {
    const auto number = value.get<double>();
    if (!(number >= low && number <= high)) {
      refuse("{} is {}, outside the range from {:g} to {:g}", place(), value.dump(), low, high);
    }
  }

  void check_word(const Json& value, const std::vector<Json>& words) const {
    if (std::find(words.begin(), words.end(), value) == words.end()) {
      std::string wanted;
      for (const Json& word : words) {
        wanted += (wanted.empty() ? "" : ", ") + word.dump();
      }
      refuse("{} is {}, not {}{}", place(), words_of(value), words.size() > 1 ? "one of " : "", wanted);
    }
  }

  void check_list(const Json& value, const Rule& rule) {
    expect(value.is_array(), "a list");
    const auto size = static_cast<double>(value.size());
    const bool fixed = rule.as_long_as != ListOf::nothing;
    const double least = fixed ? length(rule.as_long_as) : rule.low;
    const double most = fixed ? least : rule.high;
    if (size < least || size > most) {
      refuse("{} has {:.0f} entries, not {:.0f}{}", place(), size, least, least == most ? "" : " or more");
    }
    for (std::size_t i = 0; i < value.size(); ++i) {
      path_.push_back({nullptr, i});
      check(value[i], rule.entries[std::min(i, rule.entries.size() - 1)]);
      path_.pop_back();
    }
    for (const Json& word : rule.words) {
      if (std::find(value.begin(), value.end(), word) == value.end()) {
        refuse("{} lacks {}", place(), word.dump());
      }
    }
    if (rule.order != Order::any) {
      check_order(value, rule.order);
    }
    length(rule.counts) = size;
  }

  void check_order(const Json& value, Order order) {
    sorted_.clear();
    for (const Json& entry : value) {
      sorted_.push_back(entry.get<std::int64_t>());
    }
    if (order == Order::distinct) {
      std::sort(sorted_.begin(), sorted_.end());
    }
    const auto at = std::adjacent_find(sorted_.begin(), sorted_.end(), std::greater_equal<>());
    if (at != sorted_.end()) {
      refuse("{} {} {}", place(), order == Order::distinct ? "has twice the entry" : "doesn't ascend after",
             *at);
    }
  }

  void check_object(const Json& value, const Rule& rule) {
    expect(value.is_object(), "an object");
    std::size_t known = 0;
    for (const Member& member : rule.members) {
      const auto found = value.find(member.key);
      path_.push_back({member.key});
      if (found != value.end()) {
        ++known;
        check(*found, member.rule);
      } else if (member.need == Need::required) {
        refuse("{} is missing", place());
      } else if (member.need == Need::ours) {
        remarks_.push_back(place() + " is missing");
      }
      path_.pop_back();
    }
    if (!rule.members.empty() && known < value.size()) {
      note_unknown_keys(value, rule);
    }
  }

  void note_unknown_keys(const Json& value, const Rule& rule) {
    for (const auto& [key, entry] : value.items()) {
      const bool known = std::any_of(rule.members.begin(), rule.members.end(),
                                     [&name = key](const Member& member) { return name == member.key; });
      if (!known && key.starts_with(rule.watched) && unknown_ < most_unknown) {
        ++unknown_;
        remarks_.push_back(fmt::format("unknown key {} of {}", quote(key), place()));
      }
    }
  }

  std::vector<Step> path_;
  std::array<double, static_cast<std::size_t>(ListOf::end)> lengths_{};
  std::vector<std::int64_t> sorted_;
  std::vector<std::string> remarks_;
  std::size_t unknown_ = 0;
};

}  // namespace

Json parse_json(std::string_view bytes) {
  if (bytes.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    refuse("the file is empty");
  }
  if (bytes.substr(0, 3) == "\xEF\xBB\xBF") {
    refuse("the file begins with a byte order mark, which JSON doesn't allow");
  }
  try {
    Builder builder;
    Json::sax_parse(bytes.begin(), bytes.end(), &builder);
    return builder.take();
  } catch (const Json::parse_error& error) {
    const Place place = place_of(bytes, error.byte);
    refuse("the file is not JSON: {} at line {}, column {}",
           error.byte >= bytes.size() ? "it ends too early" : "it can't be read", place.line, place.column);
  } catch (const Json::exception&) {
    refuse("the file is not in the form of the contract: it has a number that is too large");
  }
}

std::string quote(std::string_view text) {
  constexpr std::size_t longest = 48;
  std::string result = "\"";
  for (const char c : text.substr(0, longest)) {
    const auto byte = static_cast<unsigned char>(c);
    result += byte < 0x20 || byte == 0x7f ? '?' : c;
  }
  if (text.size() > longest) {
    // Not in the middle of a character: its first byte goes with those that follow it.
    while (result.size() > 1 && (static_cast<unsigned char>(result.back()) & 0xC0U) == 0x80U) {
      result.pop_back();
    }
    if (result.size() > 1 && (static_cast<unsigned char>(result.back()) & 0x80U) != 0) {
      result.pop_back();
    }
    result += "...";
  }
  return result + "\"";
}

std::vector<std::string> check_form(const Json& file) {
  static const Rule form = file_form();
  Walk walk;
  walk.check(file, form);
  return walk.take_remarks();
}

}  // namespace ridgecraft::verify
