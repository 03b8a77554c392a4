// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/report/figures.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/text.hpp"

namespace ridgecraft::cli {
namespace {

/// "6.67", "1500".
std::string three_digits(double ratio) {
  return ratio < 999.5 ? fmt::format("{:.3g}", ratio) : fmt::format("{:.0f}", ratio);
}

double micro(double seconds) {
  return std::round(seconds * 1e6) / 1e6;
}

/// "1.25 s (read 0.20, segment 1.05)"
std::string seconds_text(const job::StageSeconds& seconds) {
  std::string text = fmt::format("{:.2f} s", job::total(seconds));
  const char* separator = " (";
  for (const auto& [name, value] : seconds) {
    if (value >= 0.005) {
      text += fmt::format("{}{} {:.2f}", separator, name, value);
      separator = ", ";
    }
  }
  return text + (*separator == ',' ? ")" : "");
}

/// A line for each file; the middle of a long list is left out.
std::string written_text(const std::vector<std::string>& files) {
  // Hundreds of pages would push everything else off the screen.
  constexpr std::size_t most = 12;
  if (files.empty()) {
    return "nothing was written: -o says where to\n";
  }
  std::string text;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (files.size() <= most || i < 4 || i + 2 >= files.size()) {
      text += "wrote " + files[i] + "\n";
    } else if (i == 4) {
      text += fmt::format("wrote {} more\n", files.size() - 6);
    }
  }
  return text;
}

/// Whether the name is that of one page of several: "whale-1.svg".
bool is_numbered(const std::string& file) {
  const std::string stem = std::filesystem::path(file).stem().string();
  const std::size_t last = stem.find_last_not_of("0123456789");
  return last != std::string::npos && last + 1 < stem.size() && stem[last] == '-';
}

/// "wrote whale.pdf, whale-1.svg to whale-12.svg and whale.fold", "wrote into out: whale.pdf and whale.fold",
/// where all lie in one folder.
std::string written_in_brief(const std::vector<std::string>& files) {
  namespace fs = std::filesystem;
  const bool together =
      !files.empty() && std::all_of(files.begin(), files.end(), [&](const std::string& file) {
        return fs::path(file).parent_path() == fs::path(files.front()).parent_path();
      });
  if (!together) {
    return written_text(files);
  }
  std::vector<std::string> words;
  for (std::size_t i = 0; i < files.size();) {
    std::size_t end = i + 1;
    while (end < files.size() && fs::path(files[end]).extension() == fs::path(files[i]).extension() &&
           is_numbered(files[end]) == is_numbered(files[i])) {
      ++end;
    }
    const std::string first = fs::path(files[i]).filename().string();
    const std::string last = fs::path(files[end - 1]).filename().string();
    words.push_back(end - i > 2 ? first + " to " + last : end - i == 2 ? first + ", " + last : first);
    i = end;
  }
  const std::string folder = fs::path(files.front()).parent_path().string();
  return (folder.empty() ? "wrote " : "wrote into " + folder + ": ") + listed(words, "and") + "\n";
}

Value filling_of(const MessageValue& value) {
  if (!value.option.empty()) {
    return Value::Object{{"option", value.option}, {"value", value.value}};
  }
  if (value.items.empty()) {
    return value.text;
  }
  Value list(Value::List{});
  for (const Message& item : value.items) {
    list.add(item.code == "plain" ? Value(english(item)) : value_of(item));
  }
  return list;
}

}  // namespace

Value value_of(const Message& message) {
  Value values(Value::Object{});
  for (const MessageValue& value : message.values) {
    values.set(value.name, filling_of(value));
  }
  return Value::Object{{"code", message.code}, {"values", std::move(values)}, {"text", english(message)}};
}

std::string metres(double mm) {
  return mm < 1000.0 ? fmt::format("{:.0f} mm", mm) : fmt::format("{:.2f} m", mm / 1000.0);
}

std::string scale_text(const prepare::Prepared& prepared) {
  const mesh::FileFrame& frame = prepared.model.frame;
  if (!frame.mm_per_unit) {
    return {};
  }
  const double scale = prepared.mm_per_unit / *frame.mm_per_unit;
  return fmt::format("; the file counts in {}{}: this is {} of its size",
                     mesh::unit_names(*frame.mm_per_unit),
                     frame.up ? fmt::format(", {} up", mesh::axis_name(*frame.up)) : "",
                     scale >= 1.0 ? three_digits(scale) + ":1" : "1:" + three_digits(1.0 / scale));
}

void Summary::add(std::string_view key, Value value, std::string_view unit) {
  add(key, std::move(value), Line::nets, {}, {}, unit);
}

void Summary::add(std::string_view key, Value value, Line line, std::string_view label, std::string sentence,
                  std::string_view unit) {
  RIDGECRAFT_ASSERT(unit.empty() || key.ends_with(fmt::format("_{}", unit)));
  figures_.push_back({key, std::move(value), unit, line, std::string(label), std::move(sentence)});
}

void Summary::say(Line line, std::string_view label, std::string sentence) {
  figures_.push_back({{}, {}, {}, line, std::string(label), std::move(sentence)});
}

void Summary::add_seconds(const job::StageSeconds& seconds) {
  Value value(Value::Object{});
  for (const auto& [name, stage] : seconds) {
    value.set(name, micro(stage));
  }
  value.set("total", micro(job::total(seconds)));
  add("seconds", std::move(value), Line::time, "time", seconds_text(seconds));
}

void Summary::add_repairs(const mesh::RepairReport& report) {
  Value list(Value::List{});
  for (const mesh::Repair& repair : report.entries()) {
    list.add(Value::Object{{"kind", mesh::name(repair.kind)}, {"count", repair.count}});
  }
  add("repairs", std::move(list));
}

void Summary::add_notes(const std::vector<Message>& notes) {
  Value list(Value::List{});
  for (const Message& note : notes) {
    list.add(value_of(note));
    say(Line::notes, "note", english(note));
  }
  add("notes", std::move(list));
}

void Summary::add_files(const std::vector<std::string>& files, bool silent) {
  add("files", list_of(files));
  files_ = files;
  tells_files_ = !silent || !files.empty();
}

void Summary::end_with(const std::string& line) {
  end_ += line + "\n";
}

std::string Summary::text(Detail detail) const {
  const bool brief =
      detail == Detail::brief && std::any_of(figures_.begin(), figures_.end(),
                                             [](const Figure& figure) { return figure.line == Line::brief; });
  std::vector<const Figure*> lines;
  for (const Figure& figure : figures_) {
    if (!figure.sentence.empty() && (!brief || figure.line == Line::brief)) {
      lines.push_back(&figure);
    }
  }
  std::stable_sort(lines.begin(), lines.end(),
                   [](const Figure* a, const Figure* b) { return a->line < b->line; });
  std::string text = title_ + "\n";
  for (const Figure* const figure : lines) {
    text += fmt::format("  {:<11} {}\n", figure->label, figure->sentence);
  }
  return text + (tells_files_ ? (brief ? written_in_brief(files_) : written_text(files_)) : "") + end_;
}

std::string Summary::json() const {
  Value object(Value::Object{});
  for (const Figure& figure : figures_) {
    if (!figure.key.empty()) {
      object.set(std::string(figure.key), figure.value);
    }
  }
  return json_text(object) + "\n";
}

}  // namespace ridgecraft::cli
