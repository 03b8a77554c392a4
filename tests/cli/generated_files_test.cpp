// SPDX-License-Identifier: GPL-3.0-or-later
// What is written from the tables of options and messages: docs/reference/options.md, the studio's controls
// and texts, and Python's functions. RIDGECRAFT_UPDATE_GOLDEN=1 writes these files.
#include <algorithm>
#include <array>
#include <cmath>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/encodings.hpp"
#include "base/message.hpp"
#include "base/option_table.hpp"
#include "export/machine/presets.hpp"
#include "job/asked_options.hpp"
#include "support/golden.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft;
using namespace ridgecraft::test;

namespace {

/// In the order of the studio's panel.
constexpr std::array<const char*, 5> panel_groups{"size", "paper", "pieces", "tabs", "machine"};

constexpr const char* note = "made from base/option_table.cpp by tests/cli/generated_files_test.cpp";

std::string keyword_of(const Option& row) {
  std::string key(row.name);
  std::replace(key.begin(), key.end(), '-', '_');
  return key;
}

/// Lines of at most 120 columns; `first` and `next` stand before them.
std::string wrapped(const std::string& text, const std::string& first, const std::string& next) {
  constexpr std::size_t width = 120;
  std::string out = first;
  std::size_t column = first.size();
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    if (column + end - at > width) {
      out.back() = '\n';
      out += next;
      column = next.size();
    }
    out += text.substr(at, end - at) + " ";
    column += end - at + 1;
    at = end + 1;
  }
  out.back() = '\n';
  return out;
}

/// "1.5mm to 50mm", "4 and more"; empty where anything goes.
std::string range_of(const Option& row) {
  const char* unit = row.kind == OptionKind::length ? "mm" : row.kind == OptionKind::angle ? "°" : "";
  if (row.kind == OptionKind::list || (row.low == 0.0 && row.high >= 1e6)) {
    return "";
  }
  return std::isinf(row.high) ? fmt::format("{}{} and more", row.low, unit)
                              : fmt::format("{}{} to {:.0f}{}", row.low, unit, row.high, unit);
}

std::string listed_facts(const std::vector<std::string>& facts) {
  return fmt::format("{}", fmt::join(facts, "; "));
}

/// "with `--scale`", "not with `--tabs none`"
std::string rule_text(const OptionRule& rule) {
  std::string other = "--" + std::string(rule.other);
  std::replace(other.begin(), other.end(), '=', ' ');
  const bool of_value = rule.option.find('=') != std::string_view::npos;
  const std::string value =
      of_value ? "`" + std::string(rule.option.substr(rule.option.find('=') + 1)) + "` " : "";
  return fmt::format("{}{}with `{}`", value, rule.needs ? "only " : "not ", other);
}

std::string option_entry(const Option& row) {
  const std::string takes = value_name(row);
  std::string help(row.help);
  std::replace(help.begin(), help.end(), '\n', ' ');
  constexpr std::string_view excluded = "not with ";
  std::vector<std::string> facts;
  if (const std::string range = range_of(row); !range.empty()) {
    facts.push_back(range);
  }
  for (const OptionRule& rule : option_rules()) {
    if (rule.option.substr(0, rule.option.find('=')) == row.name) {
      const std::string text = rule_text(rule);
      if (text.starts_with(excluded) && !facts.empty() && facts.back().starts_with(excluded)) {
        facts.back() += ", " + text.substr(excluded.size());
      } else {
        facts.push_back(text);
      }
    }
  }
  if (!row.setting.empty()) {
    facts.push_back(fmt::format("setting `{}{}`", row.setting, row.setting.ends_with('_') ? "TERM" : ""));
  }
  if (!row.keyword.empty()) {
    facts.push_back(fmt::format("Python `{}`", row.keyword));
  }
  const std::string text = fmt::format("**`--{}{}{}`** {}{}", row.name, takes.empty() ? "" : " ", takes, help,
                                       facts.empty() ? "" : " *" + listed_facts(facts) + ".*");
  return wrapped(text, "- ", "  ");
}

std::string reference_page() {
  std::string page =
      "# Options\n\n"
      "The options of `ridgecraft MODEL`. Defaults stand in parentheses at the end of a text. After it, in "
      "italics: the range,\nwhat it goes with or not, the key in `ridgecraft:settings` of FOLD files "
      "([formats.md](formats.md)), and the keyword\nargument in Python. The studio has most of them, too. "
      "Verbs have further options: `ridgecraft VERB --help`.\n\n"
      "This page is " +
      std::string(note) + ".\n";
  std::string_view group;
  for (const Option& row : option_table()) {
    if (row.group != group) {
      group = row.group;
      page += fmt::format("\n## {}\n\n", group);
    }
    page += option_entry(row);
  }
  return page;
}

// ---- the studio

/// What stands behind the number, and isn't typed.
std::string usual_of(const Option& row) {
  std::string usual(row.usual);
  if (row.kind == OptionKind::length && usual.ends_with("mm")) {
    usual.resize(usual.size() - 2);
  }
  return usual;
}

bool is_select(const Option& row) {
  return !row.choices.empty() && row.kind != OptionKind::whole;
}

std::string kind_of(const Option& row) {
  switch (row.kind) {
    case OptionKind::flag:
      return "flag";
    case OptionKind::length:
      return "length";
    case OptionKind::list:
      return "list";
    case OptionKind::number:
      return "number";
    default:
      return is_select(row) ? "choice" : "text";
  }
}

std::string control_js(const Option& row) {
  std::string line = fmt::format("  {{key: \"{}\", group: \"{}\", kind: \"{}\", word: \"--{}\", usual: {}",
                                 keyword_of(row), row.studio.group, kind_of(row), row.name,
                                 row.kind == OptionKind::flag ? "false" : json_string(usual_of(row)));
  if (is_select(row)) {
    line += ", choices: [";
    line += row.usual.empty() ? "\"\", " : "";
    std::vector<std::string> words;
    for (const OptionChoice& choice : row.choices) {
      if (choice.means.empty()) {
        words.push_back(json_string(choice.word));
      }
    }
    line += fmt::format("{}]", fmt::join(words, ", "));
  }
  line += row.kind == OptionKind::angle ? ", unit: \"°\"" : "";
  line += row.studio.more ? ", more: true" : "";
  return line + "},\n";
}

std::string studio_module() {
  std::string controls;
  std::string aliases;
  for (const Option& row : option_table()) {
    if (!row.same_as.empty()) {
      aliases += fmt::format("  \"--{}\": \"--{}\",\n", row.name, row.same_as);
    }
  }
  // Groups stand together in the panel.
  for (const char* group : panel_groups) {
    for (const Option& row : option_table()) {
      if (row.studio.group == group) {
        controls += control_js(row);
      }
    }
  }
  return fmt::format(
      "// SPDX-License-Identifier: GPL-3.0-or-later\n"
      "// The controls of the studio, whose texts web/languages/ has: {}.\n\n"
      "/**\n"
      " * @typedef {{object}} Option\n"
      " * @property {{string}} key of the option, and of its texts: option_KEY, and option_KEY_help below "
      "it\n"
      " * @property {{string}} group of the panel: its text is group_GROUP\n"
      " * @property {{\"length\" | \"number\" | \"choice\" | \"flag\" | \"text\" | \"list\"}} kind\n"
      " * @property {{string}} word of the command line\n"
      " * @property {{string | boolean}} usual value, for which nothing is said to the program\n"
      " * @property {{string[]}} [choices] texts are option_KEY_CHOICE\n"
      " * @property {{string}} [unit] behind the number\n"
      " * @property {{boolean}} [more] lies behind \"more\"\n"
      " */\n\n"
      "/** @type {{Option[]}} */\nexport const optionTable = [\n{}];\n\n"
      "/** Options that stand for others. @type {{Record<string, string>}} */\nexport const aliases = "
      "{{\n{}}};\n",
      note, controls, aliases);
}

using Words = nlohmann::ordered_json;
/// The language of a label or a message.
using Chosen = std::string_view Label::*;

void add_text(Words& out, const std::string& key, std::string_view text) {
  if (!text.empty()) {
    out[key] = text;
  }
}

Words option_words(Chosen language) {
  Words out = Words::object();
  for (const char* group : panel_groups) {
    for (const Option& row : option_table()) {
      if (row.studio.group != group) {
        continue;
      }
      const std::string key = "option_" + keyword_of(row);
      add_text(out, key, row.studio.label.*language);
      add_text(out, key + (is_select(row) ? "_" : "_usual"), row.studio.usual.*language);
      add_text(out, key + "_help", row.studio.help.*language);
      for (const OptionChoice& choice : row.choices) {
        add_text(out, key + "_" + std::string(choice.word), choice.label.*language);
      }
    }
  }
  return out;
}

/// A file of web/languages/ with what the tables say; the page's own texts stay. The page of a finished
/// result shows why joins have no tab, the studio all messages.
std::string language_file(const std::string& code, Chosen language, std::string_view MessageRow::*message) {
  Words file =
      Words::parse(read_bytes(std::string(RIDGECRAFT_SOURCE_DIR) + "/web/languages/" + code + ".json"));
  Words seams = Words::object();
  Words messages = Words::object();
  for (const MessageRow& row : message_table()) {
    (row.code.starts_with("no_tab_") ? seams : messages)[std::string(row.code)] = row.*message;
  }
  file["options"] = option_words(language);
  file["seams"] = std::move(seams);
  file["messages"] = std::move(messages);
  return file.dump(1) + "\n";
}

// ---- Python

std::string python_type(const Option& row) {
  const auto literal = [&] {
    std::vector<std::string> words;
    for (const OptionChoice& choice : row.choices) {
      if (choice.means.empty()) {
        words.push_back(json_string(choice.word));
      }
    }
    return fmt::format("Literal[{}]", fmt::join(words, ", "));
  };
  switch (row.kind) {
    case OptionKind::flag:
      return "bool";
    case OptionKind::length:
    case OptionKind::angle:
    case OptionKind::number:
      return "Union[float, str]";
    case OptionKind::whole:
      return "Union[int, str]";
    case OptionKind::list:
      return "Sequence[str]";
    case OptionKind::choice:
      return row.name == "tabs" ? "Union[bool, " + literal() + "]" : literal();
    default:
      return row.name == "scale" ? "Union[float, str]" : "str";
  }
}

bool is_of_pages(const Option& row) {
  static const std::set<std::string_view> names{"numbers", "duplex", "tab-shadow", "hide-folds", "strict"};
  return names.contains(row.name) || row.group == "Paper" || row.group == "Colours" ||
         (row.group == "Pieces" && row.name != "fold-linear");
}

/// As Python calls options.
std::string python_help(const Option& row) {
  std::string help(row.help);
  std::replace(help.begin(), help.end(), '\n', ' ');
  for (const Option& other : option_table()) {
    if (!other.keyword.empty()) {
      help = std::regex_replace(help, std::regex("--" + std::string(other.name) + "(?![a-z-])"),
                                std::string(other.keyword));
    }
  }
  return help;
}

std::string in_docstring(const std::string& text) {
  return wrapped(text, "    ", "        ");
}

std::string python_function(const std::string& name, bool pages, const std::string& result,
                            const std::string& purpose) {
  std::string arguments;
  std::string options;
  std::string help;
  for (const Option& row : option_table()) {
    if (!row.keyword.empty() && (pages || !is_of_pages(row))) {
      arguments += fmt::format("    {}: Optional[{}] = None,\n", row.keyword, python_type(row));
      options += fmt::format("        \"{}\": {},\n", row.keyword, row.keyword);
      help += in_docstring(fmt::format("{}: {}", row.keyword, python_help(row)));
    }
  }
  return fmt::format(
      "\n\ndef {}(\n    vertices: npt.ArrayLike,\n    faces: Any,\n    *,\n{}"
      "    unite: Optional[bool] = None,\n"
      "    whole: bool = False,\n    title: str = \"model\",\n    threads: int = 0,\n    seed: int = 1,\n"
      "    time_limit: Optional[float] = None,\n    progress: Optional[Progress] = None,\n) -> {}:\n"
      "    \"\"\"{}\n\n{}{}{}{}{}\n"
      "    The result has passed its check: lengths, overlaps, coverage, joins and refolding.\n    \"\"\"\n"
      "    options = {{\n{}    }}\n"
      "    if unite is not None:\n        options[\"keep_bodies\"] = not unite\n"
      "    return _core.{}(vertices, faces, options, (whole, title), (threads, seed, time_limit, "
      "progress))\n",
      name, arguments, result, purpose, help, in_docstring("unite: the contrary of keep_bodies."),
      in_docstring(
          "whole: don't cut the model into parts first, and cut a flat region before a piece is added."),
      in_docstring("title: what pages and files call the model."),
      in_docstring(
          "time_limit: seconds after which searches end with the best they have. Raises OutOfTime where "
          "there is nothing yet."),
      options, name);
}

std::string python_module() {
  return fmt::format(
             "# SPDX-License-Identifier: GPL-3.0-or-later\n"
             "\"\"\"unfold() and run(): {}.\"\"\"\n\n"
             "from __future__ import annotations\n\n"
             "from typing import Any, Callable, Literal, Optional, Sequence, Union\n\n"
             "import numpy.typing as npt\n\n"
             "from . import _core\nfrom ._core import Nets, Paper\n\n"
             "Progress = Callable[[str, float], Any]\n",
             note) +
         python_function(
             "unfold", false, "Nets",
             "Unfolds a model into nets without overlap, without pages: pieces may be as large as "
             "they like.\n\n    Bodies stay as they are, faces are kept and there are no tabs, unless "
             "asked for. Lengths are mm.") +
         python_function("run", true, "Paper",
                         "Turns a model into pages of paper, as the program does. Lengths are mm, angles "
                         "degrees.");
}

}  // namespace

TEST_CASE("what is written from the tables of options and messages is current", "[options][generated]") {
  check_golden("../../docs/reference/options.md", reference_page());
  check_golden("../../web/option_words.js", studio_module());
  check_golden("../../web/languages/en.json", language_file("en", &Label::english, &MessageRow::english));
  check_golden("../../web/languages/de.json", language_file("de", &Label::german, &MessageRow::german));
  check_golden("../../python/ridgecraft/_run.py", python_module());
}

TEST_CASE("the usual values of options are those of the program", "[options]") {
  job::Options plain;
  plain.pieces = unfold::rules_of(unfold::PieceMode::parts);
  job::AskedOptions asked;
  for (const char* name : {"margin", "page-by", "pack", "grain", "tabs", "tab-angle", "hide-folds", "numbers",
                           "ink", "dpi", "skins", "concavity", "thickness", "pieces", "paper"}) {
    asked.typed(name).text = std::string(option_row(name).usual);
  }
  const job::Options read = job::options_of(asked, plain);
  export_::Settings from_plain;
  export_::Settings from_read;
  job::Options copy = read;
  job::note_fields(plain, from_plain);
  job::note_fields(copy, from_read);
  CHECK(from_plain == from_read);
  CHECK(read.style.hidden_fold_angle == Approx(plain.style.hidden_fold_angle));
  CHECK(read.style.dots_per_inch == plain.style.dots_per_inch);
  CHECK(read.style.numbers == plain.style.numbers);
  CHECK(read.style.turned_over == plain.style.turned_over);
  CHECK(read.style.ink == plain.style.ink);
  CHECK(read.tabs.angle == plain.tabs.angle);
  CHECK(read.tab_choice.sides == plain.tab_choice.sides);
  CHECK(read.paper->size == plain.paper->size);
}

TEST_CASE("the table of options names every preset, and each name once", "[options]") {
  std::vector<std::string_view> known{"print"};
  for (const export_::Preset& preset : export_::presets()) {
    known.push_back(preset.name);
  }
  std::vector<std::string_view> named;
  for (const OptionChoice& choice : option_row("preset").choices) {
    named.push_back(choice.word);
  }
  CHECK(named == known);
  std::set<std::string_view> names;
  for (const Option& row : option_table()) {
    CAPTURE(row.name);
    CHECK(names.insert(row.name).second);
    CHECK_FALSE(row.help.empty());
  }
  for (const OptionRule& rule : option_rules()) {
    CHECK(names.contains(rule.option.substr(0, rule.option.find('='))));
    CHECK(names.contains(rule.other.substr(0, rule.other.find('='))));
  }
}

TEST_CASE("choices are in the order of the enumerations that they set", "[options]") {
  using namespace unfold;
  struct Meaning {
    const char* option;
    std::vector<std::pair<const char*, int>> words;
  };
  const auto meaning = [](const char* option, std::initializer_list<std::pair<const char*, int>> words) {
    return Meaning{option, words};
  };
  const auto value = [](auto enumerator) { return static_cast<int>(enumerator); };
  using export_::DxfKind, export_::Grain, export_::Hinge, export_::Ink, export_::Numbers,
      export_::PackingEffort, export_::Scores, export_::TurnedOver;
  for (const Meaning& row :
       {meaning("up",
                {{"x", value(mesh::Axis::x)}, {"y", value(mesh::Axis::y)}, {"z", value(mesh::Axis::z)}}),
        meaning("page-by", {{"any", value(job::PageBy::any)},
                            {"material", value(job::PageBy::material)},
                            {"object", value(job::PageBy::object)}}),
        meaning("pack", {{"fast", value(PackingEffort::fast)}, {"good", value(PackingEffort::good)}}),
        meaning("grain", {{"any", value(Grain::any)},
                          {"long", value(Grain::long_side)},
                          {"short", value(Grain::short_side)}}),
        meaning("tabs", {{"auto", value(TabSides::best)},
                         {"one-side", value(TabSides::one_side)},
                         {"alternate", value(TabSides::alternate)},
                         {"both", value(TabSides::both)},
                         {"slots", value(TabSides::slots)}}),
        meaning("numbers", {{"inside", value(Numbers::inside)},
                            {"tabs", value(Numbers::tabs)},
                            {"outside", value(Numbers::outside)},
                            {"back", value(Numbers::back)}}),
        meaning("duplex", {{"long", value(TurnedOver::long_edge)}, {"short", value(TurnedOver::short_edge)}}),
        meaning("ink",
                {{"colour", value(Ink::colour)}, {"pale", value(Ink::pale)}, {"lines", value(Ink::lines)}}),
        meaning("skins", {{"outer", value(prepare::Skins::outer)},
                          {"middle", value(prepare::Skins::middle)},
                          {"both", value(prepare::Skins::both)}}),
        meaning("dxf", {{"r2000", value(DxfKind::r2000)},
                        {"r12", value(DxfKind::r12)},
                        {"plain", value(DxfKind::plain)}}),
        meaning("score", {{"solid", value(Scores::solid)},
                          {"dashes", value(Scores::dashes)},
                          {"perforate", value(Scores::perforate)},
                          {"ends", value(Scores::ends)},
                          {"none", value(Scores::none)}}),
        meaning(
            "hinge",
            {{"back", value(Hinge::back)}, {"middle", value(Hinge::middle)}, {"front", value(Hinge::front)}}),
        meaning("pieces", {{"few", value(PieceMode::few)},
                           {"parts", value(PieceMode::parts)},
                           {"small", value(PieceMode::small)}})}) {
    for (const auto& [word, enumerator] : row.words) {
      CAPTURE(row.option, word);
      job::AskedOptions asked;
      asked.typed(row.option).text = word;
      CHECK(static_cast<int>(asked.choice(row.option)) == enumerator);
    }
  }
}

TEST_CASE("a flag that stands for another option is that one", "[options]") {
  job::AskedOptions asked;
  asked.typed("no-tabs").flag = true;
  CHECK_FALSE(job::options_of(asked, {}).tabs.wanted);
  asked.typed("tabs").text = "both";
  CHECK_THROWS_WITH(job::options_of(asked, {}), "--no-tabs and --tabs both exclude each other");
}
