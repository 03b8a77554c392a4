// SPDX-License-Identifier: GPL-3.0-or-later
#include "job/asked_options.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/encodings.hpp"
#include "base/option_values.hpp"

namespace ridgecraft::job {
namespace {

/// Old words come last in a row, so these have the indices of its choices.
std::vector<std::string> words_of(const Option& row) {
  std::vector<std::string> words;
  for (const OptionChoice& choice : row.choices) {
    if (choice.means.empty()) {
      words.emplace_back(choice.word);
    }
  }
  return words;
}

}  // namespace

double number_of(const Option& row, const std::string& called, const std::string& text) {
  if (row.kind == OptionKind::length) {
    return length_or_refuse(called, text, row.low, row.high);
  }
  const double number = number_or_refuse(called, text, row.low, row.high);
  return row.kind == OptionKind::angle ? number * (std::numbers::pi / 180.0) : number;
}

const AskedOptions::Typed& AskedOptions::as_typed(std::string_view name) const {
  static const Typed nothing;
  const auto found = typed_.find(name);
  return found == typed_.end() ? nothing : found->second;
}

bool AskedOptions::given(std::string_view name) const {
  const Typed& typed = as_typed(name);
  return typed.flag || typed.off || !typed.text.empty() || !typed.texts.empty();
}

bool AskedOptions::flag(std::string_view name) const {
  return as_typed(name).flag;
}

std::string AskedOptions::text(std::string_view name) const {
  const Typed& typed = as_typed(name);
  return typed.text.empty() ? std::string(option_row(name).usual) : typed.text;
}

const std::vector<std::string>& AskedOptions::texts(std::string_view name) const {
  return as_typed(name).texts;
}

double AskedOptions::number(std::string_view name) const {
  return number_of(option_row(name), called(name), text(name));
}

std::uint64_t AskedOptions::whole(std::string_view name) const {
  const Option& row = option_row(name);
  const std::uint64_t most =
      std::isinf(row.high) ? std::numeric_limits<std::uint64_t>::max() : static_cast<std::uint64_t>(row.high);
  return whole_number_or_refuse(called(name), text(name), static_cast<std::uint64_t>(row.low), most);
}

std::size_t AskedOptions::choice(std::string_view name) const {
  const Option& row = option_row(name);
  std::string word = text(name);
  for (const OptionChoice& choice : row.choices) {
    if (choice.word == word && !choice.means.empty()) {
      word = choice.means;
    }
  }
  return word_or_refuse(called(name), word, words_of(row));
}

std::string AskedOptions::called(std::string_view name) const {
  return naming_ == Naming::command_line ? "--" + std::string(name) : std::string(option_row(name).keyword);
}

/// "all-tabs": it is given; "numbers=back": it is this.
bool AskedOptions::holds(std::string_view condition) const {
  const std::size_t equals = condition.find('=');
  const std::string_view name = condition.substr(0, equals);
  const Typed& typed = as_typed(name);
  return equals == std::string_view::npos ? given(name) && !typed.off
                                          : typed.text == condition.substr(equals + 1);
}

/// "--numbers back" or "numbers='back'" as a value of a message.
MessageValue AskedOptions::named(std::string_view gap, std::string_view condition) const {
  const std::size_t equals = condition.find('=');
  const std::string_view name = condition.substr(0, equals);
  const std::string word(equals == std::string_view::npos ? "" : condition.substr(equals + 1));
  MessageValue value = option_value(gap, name, word);
  if (naming_ == Naming::keywords) {
    value.text = called(name) + (word.empty() ? "" : "='" + word + "'");
  }
  return value;
}

void AskedOptions::replace_aliases() {
  for (const Option& row : option_table()) {
    if (row.same_as.empty() || !flag(row.name)) {
      continue;
    }
    const std::size_t equals = row.same_as.find('=');
    const std::string name(row.same_as.substr(0, equals));
    const std::string value(row.same_as.substr(equals + 1));
    std::string& text = typed(name).text;
    if (!text.empty() && text != value) {
      refuse(Message("options_exclude", {named("a", row.name), named("b", name + "=" + text)}));
    }
    text = value;
    typed(row.name).flag = false;
  }
}

void AskedOptions::check_rules() const {
  for (const OptionRule& rule : option_rules()) {
    if (holds(rule.option) && holds(rule.other) != rule.needs) {
      std::vector<MessageValue> values{named("a", rule.option), named("b", rule.other)};
      if (!rule.why.empty()) {
        values.emplace_back("why", std::vector{Message(rule.why)});
      }
      refuse(Message(rule.needs         ? "options_need"
                     : rule.why.empty() ? "options_exclude"
                                        : "options_exclude_why",
                     std::move(values)));
    }
  }
}

namespace {

/// An enumeration whose values stand in the order of the option's choices; a flag is its second one.
struct AnyEnum {
  void* at;
  std::size_t (*get)(const void*);
  void (*set)(void*, std::size_t);
};
template <class Enum>
AnyEnum any_enum(Enum& value) {
  return {&value, [](const void* at) { return static_cast<std::size_t>(*static_cast<const Enum*>(at)); },
          [](void* at, std::size_t index) { *static_cast<Enum*>(at) = static_cast<Enum>(index); }};
}

using Place = std::variant<std::monostate, bool*, double*, std::vector<std::string>*, AnyEnum>;

struct Field {
  std::string_view option;
  Place (*place)(Options&);
};

/// Each option whose value stands in one place, as it is.
constexpr std::array fields{
    Field{"only", [](Options& o) -> Place { return &o.selection.only; }},
    Field{"without", [](Options& o) -> Place { return &o.selection.without; }},
    Field{"strict", [](Options& o) -> Place { return &o.strict; }},
    Field{"margin", [](Options& o) -> Place { return &o.paper->margin; }},
    Field{"page-by", [](Options& o) -> Place { return any_enum(o.page_by); }},
    Field{"pack", [](Options& o) -> Place { return any_enum(o.paper->packing); }},
    Field{"grain", [](Options& o) -> Place { return any_enum(o.paper->grain); }},
    Field{"tabs", [](Options& o) -> Place { return any_enum(o.tab_choice.sides); }},
    Field{"border-tabs", [](Options& o) -> Place { return &o.tab_choice.borders; }},
    Field{"tab-shadow", [](Options& o) -> Place { return &o.style.tab_shadows; }},
    Field{"all-tabs", [](Options& o) -> Place { return &o.tabs.split_pieces; }},
    Field{"tab-angle", [](Options& o) -> Place { return &o.tabs.angle; }},
    Field{"hide-folds", [](Options& o) -> Place { return &o.style.hidden_fold_angle; }},
    Field{"numbers", [](Options& o) -> Place { return any_enum(o.style.numbers); }},
    Field{"duplex", [](Options& o) -> Place { return any_enum(o.style.turned_over); }},
    Field{"ink", [](Options& o) -> Place { return any_enum(o.style.ink); }},
    Field{"details", [](Options& o) -> Place { return any_enum(o.style.details); }},
    Field{"dpi", [](Options& o) -> Place { return &o.style.dots_per_inch; }},
    Field{"keep-bodies", [](Options& o) -> Place { return any_enum(o.bodies); }},
    Field{"skins", [](Options& o) -> Place { return any_enum(o.simplify.skins); }},
    Field{"concavity", [](Options& o) -> Place { return &o.concavity; }},
    Field{"hours", [](Options& o) -> Place { return &o.simplify.budget.hours; }},
    Field{"thickness", [](Options& o) -> Place { return &o.board.thickness_mm; }},
    Field{"hinge", [](Options& o) -> Place { return any_enum(o.board.hinge); }},
    Field{"pieces", [](Options& o) -> Place { return any_enum(o.pieces.mode); }},
    Field{"rolled", [](Options& o) -> Place { return any_enum(o.simplify.rolls.which); }},
    Field{"fold-linear", [](Options& o) -> Place { return &o.pieces.fold_linear; }},
};

Place place_of(const Field& field, Options& options) {
  const bool of_pages = option_row(field.option).group == "Paper";
  return of_pages && !options.paper ? Place{} : field.place(options);
}

/// These say more than their place holds: read_tabs() reads them.
bool is_of_tabs(std::string_view option) {
  return option == "tabs" || option == "tab-angle";
}

struct Reader {
  const AskedOptions& asked;
  std::string_view option;
  void operator()(std::monostate /*none*/) const {}
  void operator()(bool* value) const { *value = asked.flag(option); }
  void operator()(double* value) const { *value = asked.number(option); }
  void operator()(std::vector<std::string>* value) const { *value = asked.texts(option); }
  void operator()(const AnyEnum& value) const {
    const bool is_flag = option_row(option).kind == OptionKind::flag;
    value.set(value.at, is_flag ? (asked.flag(option) ? 1 : 0) : asked.choice(option));
  }
};

/// The JSON of a value as its setting, or nothing where it is the usual one and that isn't noted.
struct Note {
  const Option& row;
  [[nodiscard]] std::optional<std::string> unless(bool usual, std::string text) const {
    return usual && row.noted == Noted::if_changed ? std::nullopt : std::optional(std::move(text));
  }
  std::optional<std::string> operator()(std::monostate /*none*/) const { return std::nullopt; }
  std::optional<std::string> operator()(const bool* value) const {
    return unless(!*value, *value ? "true" : "false");
  }
  std::optional<std::string> operator()(const double* value) const {
    const bool usual = row.noted == Noted::if_changed &&
                       *value == number_of(row, std::string(row.name), std::string(row.usual));
    return unless(usual, row.kind == OptionKind::angle
                             ? fmt::format("{:.10g}", *value * 180.0 / std::numbers::pi)
                             : fmt::format("{}", *value));
  }
  /// One text, each on a line of its own.
  std::optional<std::string> operator()(const std::vector<std::string>* value) const {
    return unless(value->empty(), json_string(fmt::format("{}", fmt::join(*value, "\n"))));
  }
  std::optional<std::string> operator()(const AnyEnum& value) const {
    const std::string_view word = row.choices.at(value.get(value.at)).word;
    return unless(word == row.usual, json_string(word));
  }
};

void read_size(const AskedOptions& asked, Options& options) {
  struct Way {
    std::string_view option;
    std::optional<ExtentKind> kind;
  };
  for (const Way& way : {Way{"size", {}}, Way{"width", ExtentKind::width}, Way{"depth", ExtentKind::depth},
                         Way{"height", ExtentKind::height}}) {
    if (asked.given(way.option)) {
      options.size.largest_extent_mm = asked.number(way.option);
      options.size.adapts = false;
      if (way.kind) {
        options.extent = Extent{*way.kind, options.size.largest_extent_mm};
      }
    }
  }
  if (asked.given("scale")) {
    const auto factor = parse_scale(asked.text("scale"));
    if (!factor) {
      refuse(Message("option_scale", {{"option", asked.called("scale")}, {"text", asked.text("scale")}}));
    }
    options.size.mm_per_unit = *factor * unit_or_refuse(asked.called("unit"), asked.text("unit"));
    options.size.adapts = false;
  }
  if (asked.given("up")) {
    options.up = asked.choice_as<mesh::Axis>("up");
  }
  if (const std::string faces = asked.text("faces"); asked.given("faces")) {
    options.simplify.mode = faces == "auto"   ? prepare::Simplification::automatic
                            : faces == "keep" ? prepare::Simplification::keep
                                              : prepare::Simplification::count;
    if (options.simplify.mode == prepare::Simplification::count) {
      options.simplify.faces = asked.whole("faces");
    }
  }
}

/// "4mm,20mm:5mm,60mm:8mm": the value of short edges, then lengths of edges from which on another one counts.
std::vector<unfold::FromLength> read_steps(const AskedOptions& asked, std::string_view option) {
  const std::string typed = asked.text(option);
  const std::string called = asked.called(option);
  const Option& row = option_row(option);
  std::vector<unfold::FromLength> steps;
  for (std::string_view text = typed;; text.remove_prefix(text.find(',') + 1)) {
    const std::string_view step = text.substr(0, text.find(','));
    const std::size_t colon = step.find(':');
    const bool first = steps.empty();
    const bool has_length = colon != std::string_view::npos;
    const double from =
        has_length ? length_or_refuse(called, std::string(step.substr(0, colon)), 0.0, row.high * 1e9) : 0.0;
    if (first == has_length || (!first && !(from > steps.back().length_mm))) {
      const char* const example = row.kind == OptionKind::angle ? "60,20mm:45" : "4mm,20mm:5mm,60mm:8mm";
      refuse(Message("option_steps", {{"option", called}, {"example", example}}));
    }
    steps.push_back({from, number_of(row, called, std::string(step.substr(has_length ? colon + 1 : 0)))});
    if (step.size() == text.size()) {
      return steps;
    }
  }
}

void read_tabs(const AskedOptions& asked, Options& options) {
  unfold::TabOptions& tabs = options.tabs;
  unfold::TabChoice& choice = options.tab_choice;
  if (asked.given("tabs")) {
    tabs.wanted = asked.text("tabs") != "none";
    choice.sides = tabs.wanted ? asked.choice_as<unfold::TabSides>("tabs") : unfold::TabSides::best;
  }
  if (asked.given("tab-height")) {
    choice.heights_mm = read_steps(asked, "tab-height");
    tabs.height_mm = choice.heights_mm.front().value;
  } else {
    tabs.height_mm += options.board.thickness_mm;  // which a tab loses to the board behind it
  }
  if (asked.given("tab-angle")) {
    choice.angles = read_steps(asked, "tab-angle");
    tabs.angle = choice.angles.front().value;
  }
  tabs.steepest_angle = std::max(tabs.steepest_angle, tabs.angle);
  // One value for all edges is what nets are searched with, too.
  for (auto* steps : {&choice.heights_mm, &choice.angles}) {
    if (steps->size() == 1) {
      steps->clear();
    }
  }
}

void read_pieces(const AskedOptions& asked, unfold::PieceRules& rules) {
  rules = unfold::rules_of(asked.choice_as<unfold::PieceMode>("pieces"));
  rules.fold_linear = asked.flag("fold-linear");
  if (asked.given("max-faces")) {
    rules.max_panels = asked.text("max-faces") == "any" ? 0 : asked.whole("max-faces");
    if (rules.max_panels == 0 && asked.text("max-faces") != "any") {
      refuse(Message("option_max_faces", {{"option", asked.called("max-faces")}}));
    }
  }
  const std::string called = asked.called("weigh");
  for (const std::string& text : asked.texts("weigh")) {
    const std::size_t equals = text.find('=');
    double* const weight = unfold::weight_named(rules.weights, std::string_view(text).substr(0, equals));
    if (equals == std::string::npos || weight == nullptr) {
      const auto names = unfold::term_names();
      refuse(Message(
          "option_weigh",
          {{"option", called}, {"words", plain_items({names.begin(), names.end()})}, {"text", text}}));
    }
    *weight = number_or_refuse(called + " " + text.substr(0, equals), text.substr(equals + 1), 0.0,
                               option_row("weigh").high);
  }
}

}  // namespace

Options options_of(AskedOptions asked, Options usual) {
  asked.replace_aliases();
  asked.check_rules();
  Options options = std::move(usual);
  if (options.paper && asked.given("paper")) {
    options.paper->size = export_::parse_paper(asked.text("paper")).size;
  }
  if (options.paper) {
    read_pieces(asked, options.pieces);
  }
  for (const Field& field : fields) {
    if (asked.given(field.option) && !is_of_tabs(field.option)) {
      std::visit(Reader{asked, field.option}, place_of(field, options));
    }
  }
  read_size(asked, options);
  read_tabs(asked, options);
  return options;
}

void note_fields(Options& options, export_::Settings& settings) {
  for (const Field& field : fields) {
    const Option& row = option_row(field.option);
    if (!row.setting.empty() && (row.noted != Noted::with_pages || options.paper)) {
      if (const auto json = std::visit(Note{row}, place_of(field, options))) {
        settings[std::string(row.setting)] = *json;
      }
    }
  }
}

}  // namespace ridgecraft::job
