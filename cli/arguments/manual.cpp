// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/arguments/manual.hpp"

#include <algorithm>
#include <cctype>

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

}  // namespace ridgecraft::cli
