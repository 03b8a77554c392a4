// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/arguments/verb.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string_view>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/option_values.hpp"
#include "base/text.hpp"

namespace ridgecraft::cli {
namespace {

constexpr std::size_t page_width = 100;
constexpr std::size_t text_column = 30;

/// Appends one paragraph broken into lines from `column` on; the cursor already stands there.
void append_paragraph(std::string& out, std::string_view text, std::size_t column) {
  std::size_t at = column;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    if (at > column && at + 1 + end > page_width) {
      out += '\n';
      out.append(column, ' ');
      at = column;
    } else if (at > column) {
      out += ' ';
      ++at;
    }
    out += text.substr(0, end);
    at += end;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  out += '\n';
}

/// Paragraphs of `text` are its lines.
void append_wrapped(std::string& out, std::string_view text, std::size_t column) {
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    append_paragraph(out, text.substr(0, end), column);
    out.append(column, ' ');
    text.remove_prefix(end + 1);
  }
  append_paragraph(out, text, column);
}

void append_entry(std::string& out, const ManualEntry& entry) {
  out += "  " + entry.term;
  std::size_t column = 2 + entry.term.size();
  if (column + 2 > text_column) {
    out += '\n';
    column = 0;
  }
  out.append(text_column - column, ' ');
  append_wrapped(out, entry.text, text_column);
}

/// Text in which troff sees no request, escape or hyphenation point.
std::string troff(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else if (c == '\n') {
      out += "\n.br\n";
    } else {
      out += c;
    }
  }
  if (!out.empty() && (out.front() == '.' || out.front() == '\'')) {
    out.insert(0, "\\&");
  }
  return out;
}

std::string capitals(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return out;
}

void append_man_sections(std::string& out, const Manual& manual, std::string_view request) {
  for (const ManualSection& section : manual.sections) {
    out +=
        std::string(request) + " " + troff(request == ".SH" ? capitals(section.title) : section.title) + "\n";
    for (const ManualEntry& entry : section.entries) {
      out += ".TP\n.B " + troff(entry.term) + "\n" + troff(entry.text) + "\n";
    }
  }
}

}  // namespace

std::string help_text(const Manual& manual) {
  std::string out = manual.name + ": " + manual.purpose + "\n\nExamples:\n";
  for (const ManualEntry& example : manual.examples) {
    out += "  " + example.term + "\n      ";
    append_wrapped(out, example.text, 6);
  }
  out += "\nUsage:\n";
  for (const std::string& line : manual.usage) {
    out += "  " + line + "\n";
  }
  for (const ManualSection& section : manual.sections) {
    out += "\n" + section.title + ":\n";
    for (const ManualEntry& entry : section.entries) {
      append_entry(out, entry);
    }
  }
  return out;
}

std::string man_page(const Manual& program, const std::vector<Manual>& verbs, std::string_view version) {
  std::string out = ".TH RIDGECRAFT 1 \"\" \"" + std::string(version) + "\" \"User Commands\"\n";
  out += ".SH NAME\n" + program.name + " \\- " + troff(program.purpose) + "\n.SH SYNOPSIS\n";
  for (const std::string& line : program.usage) {
    out += ".B " + troff(line) + "\n.br\n";
  }
  out += ".SH EXAMPLES\n";
  for (const ManualEntry& example : program.examples) {
    out += ".TP\n.B " + troff(example.term) + "\n" + troff(example.text) + "\n";
  }
  append_man_sections(out, program, ".SH");
  for (const Manual& verb : verbs) {
    out += ".SH " + troff(capitals(verb.name)) + "\n" + troff(verb.purpose) + "\n";
    for (const std::string& line : verb.usage) {
      out += ".br\n.B " + troff(line) + "\n";
    }
    append_man_sections(out, verb, ".SS");
  }
  return out;
}

// The only file that includes CLI11.

struct Verb::Parser {
  CLI::App app;
};

Verb::Verb(std::string name, std::string purpose) : parser_(std::make_unique<Parser>()) {
  manual_.name = std::move(name);
  manual_.purpose = std::move(purpose);
  parser_->app.set_help_flag();
}

Verb::~Verb() = default;

Verb& Verb::usage(std::string line) {
  manual_.usage.push_back(std::move(line));
  return *this;
}

Verb& Verb::example(std::string command, std::string what) {
  manual_.examples.push_back({std::move(command), std::move(what)});
  return *this;
}

Verb& Verb::section(ManualSection section) {
  extra_sections_.push_back(std::move(section));
  return *this;
}

Verb& Verb::option(const std::string& group, const std::string& names, std::string& value,
                   const std::string& type, const std::string& text) {
  parser_->app.add_option(names, value, text)
      ->group(group)
      ->type_name(type)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  return *this;
}

Verb& Verb::list(const std::string& group, const std::string& names, std::vector<std::string>& values,
                 const std::string& type, const std::string& text) {
  parser_->app.add_option(names, values, text)
      ->group(group)
      ->type_name(type)
      ->expected(1)
      ->allow_extra_args(false)  // one value each time: what follows is the model, or another file
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  return *this;
}

Verb& Verb::takes_several(const std::string& name) {
  parser_->app.get_option(name)->allow_extra_args(true);
  return *this;
}

Verb& Verb::flag(const std::string& group, const std::string& names, bool& value, const std::string& text) {
  parser_->app.add_flag(names, value, text)->group(group);
  return *this;
}

Verb& Verb::add(const Option& row, job::AskedOptions& asked, const std::string& group,
                const std::string& help) {
  const std::string& heading = group.empty() ? std::string(row.group) : group;
  const std::string& text = help.empty() ? std::string(row.help) : help;
  const std::string names =
      (row.letter.empty() ? "" : fmt::format("-{},", row.letter)) + fmt::format("--{}", row.name);
  job::AskedOptions::Typed& typed = asked.typed(row.name);
  switch (row.kind) {
    case OptionKind::flag:
      return flag(heading, names, typed.flag, text);
    case OptionKind::list:
      return list(heading, names, typed.texts, value_name(row), text);
    default:
      return option(heading, names, typed.text, value_name(row), text);
  }
}

Job Verb::finish(const Arguments* arguments, Manual* manual, const std::function<Job()>& checked) {
  if (arguments == nullptr) {
    *manual = this->manual();
    return PrintJob{};
  }
  if (parse(*arguments)) {
    return PrintJob{help_text(this->manual())};
  }
  return checked();
}

/// "--size 30 cm" are three arguments; the shell doesn't know that two of them are one length.
void refuse_divided_length(const Arguments& arguments) {
  for (std::size_t i = 0; i + 2 < arguments.size(); ++i) {
    const std::string& option = arguments[i];
    std::string_view number = arguments[i + 1];
    const std::string& unit = arguments[i + 2];
    const auto length = take_length(number);
    if (option.starts_with("--") && option.find('=') == std::string::npos && length && number.empty() &&
        !length->mm_per_unit && unit_mm(unit) && !std::filesystem::exists(unit)) {
      refuse("a length has no blank before its unit: " + option + " " + arguments[i + 1] + unit);
    }
  }
}

/// True when --help was asked for.
bool Verb::parse(Arguments arguments) {
  bool help = false;
  flag("Common", "-h,--help", help, "Print this text.");
  // By hand, since CLI11 takes a -- behind an option that may have several values for the end of these.
  const auto end = std::find(arguments.begin(), arguments.end(), "--");
  const Arguments no_options(end == arguments.end() ? end : end + 1, arguments.end());
  arguments.erase(end, arguments.end());
  given_ = arguments;
  refuse_divided_length(arguments);
  std::reverse(arguments.begin(), arguments.end());
  try {
    parser_->app.parse(arguments);
    take_positional(no_options);
  } catch (const CLI::ExtrasError&) {
    refuse_unexpected(parser_->app.remaining());
  } catch (const CLI::ParseError& error) {
    if (!help) {
      refuse(std::string(error.what()));
    }
  }
  return help;
}

/// What follows --: the verb's one argument, unless it was there before.
void Verb::take_positional(const Arguments& words) {
  for (const std::string& word : words) {
    const auto free =
        parser_->app.get_options([](const CLI::Option* o) { return o->get_positional() && o->count() == 0; });
    if (free.empty()) {
      refuse("'" + word + "' is one argument too many behind --, where options end; see " + manual_.name +
             " --help");
    }
    free.front()->add_result(word);
    free.front()->run_callback();
  }
}

Manual Verb::manual() const {
  Manual whole = manual_;
  const CLI::App& app = parser_->app;
  for (const std::string& group : app.get_groups()) {
    if (group.empty()) {
      continue;  // hidden options
    }
    ManualSection section{group, {}};
    for (const CLI::Option* o :
         app.get_options([&](const CLI::Option* x) { return x->get_group() == group; })) {
      std::string term = o->get_positional() ? o->get_single_name() : o->get_name(false, true);
      for (std::size_t at = term.find(','); at != std::string::npos; at = term.find(',', at + 2)) {
        term.replace(at, 1, ", ");
      }
      if (!o->get_positional() && !o->get_type_name().empty() && o->get_expected_max() > 0) {
        term += " " + o->get_type_name();
      }
      section.entries.push_back({term, o->get_description()});
    }
    if (!section.entries.empty()) {
      whole.sections.push_back(std::move(section));
    }
  }
  whole.sections.insert(whole.sections.end(), extra_sections_.begin(), extra_sections_.end());
  return whole;
}

void Verb::refuse_unexpected(const std::vector<std::string>& remaining) const {
  const std::string word = as_given(remaining.empty() ? "" : remaining.front());
  if (!word.starts_with("-")) {
    refuse("'" + word + "' is one argument too many" + takes() + "; see " + manual_.name + " --help");
  }
  const std::string option = word.starts_with("--") ? word.substr(0, word.find('=')) : "";
  const std::string sentence = "there is no option '" + word + "'" + instead_of(word, option);
  if (option.size() > 2) {
    throw UnknownOption(sentence, option);
  }
  refuse(sentence);
}

/// How a sentence about an unknown word goes on; `option` is empty where the word is no long option.
std::string Verb::instead_of(const std::string& word, const std::string& option) const {
  std::vector<std::string> known;
  for (const CLI::Option* o : parser_->app.get_options({})) {
    for (const std::string& name : o->get_lnames()) {
      known.push_back("--" + name);
    }
  }
  if (const std::string nearest = option.empty() ? "" : nearest_word(option, known); !nearest.empty()) {
    return ", did you mean '" + nearest + "'?";
  }
  if (word.find('.') != std::string::npos) {
    return "; a file of this name stands behind --, as in: " + manual_.name + " -- " + word;
  }
  return "; see " + manual_.name + " --help";
}

/// CLI11 takes "-h.obj" for "-h" and a rest, which it tells as "-.obj".
std::string Verb::as_given(const std::string& word) const {
  if (word.starts_with("-") && !word.starts_with("--")) {
    for (const std::string& argument : given_) {
      if (argument.starts_with("-") && !argument.starts_with("--") && argument.ends_with(word.substr(1))) {
        return argument;
      }
    }
  }
  return word;
}

/// What the verb takes of arguments that are no options, where that is one.
std::string Verb::takes() const {
  const auto arguments = parser_->app.get_options([](const CLI::Option* o) { return o->get_positional(); });
  return arguments.empty()                                 ? ""
         : arguments.front()->get_single_name() == "MODEL" ? ": a run takes one model"
                                                           : ": a run takes one file";
}

}  // namespace ridgecraft::cli
