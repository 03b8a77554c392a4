// SPDX-License-Identifier: GPL-3.0-or-later
// What a job tells, as one list of figures: the lines for a person and the object for a machine are two
// renderings of it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/message.hpp"
#include "cli/files/value.hpp"
#include "job/stage_clock.hpp"
#include "mesh/model/soup.hpp"
#include "prepare/prepared/prepared.hpp"

namespace ridgecraft::cli {

/// {"code": ..., "values": {...}, "text": ...}: a value is a text, {"option", "value"} or a list of
/// messages and texts.
[[nodiscard]] Value value_of(const Message& message);

/// "640 mm", "2.07 m"
[[nodiscard]] std::string metres(double mm);

/// "; the file counts in metres, y up: this is 1:13.3 of its size"; empty where the file tells no unit.
[[nodiscard]] std::string scale_text(const prepare::Prepared& prepared);

/// The lines of a summary in the order in which a person reads them.
enum class Line {
  brief,  ///< what is told without -v where there is such a line
  lengths,
  size,
  skin,
  simplified,
  nets,
  hint,
  pieces,
  equal,
  tabs,
  lines,
  numbers,
  slivers,
  folding,
  colours,
  lost_edges,
  bodies,
  guide,
  notes,
  time
};

struct Figure {
  std::string_view key;  ///< in the object; empty for what people alone are told
  Value value;
  std::string_view unit;  ///< "mm" and so on; the key ends with it. Empty for counts, names and texts
  Line line = Line::nets;
  std::string label;     ///< of the sentence's line: one word
  std::string sentence;  ///< empty for what machines alone are told; further lines of one label behind "\n"
};

enum class Detail { brief, all };

/// The report of one job.
class Summary {
 public:
  /// `title`: the first line.
  explicit Summary(std::string title) : title_(std::move(title)) {}

  /// A figure that machines alone are told.
  void add(std::string_view key, Value value, std::string_view unit = {});
  /// One that people are told, too, if the sentence isn't empty.
  void add(std::string_view key, Value value, Line line, std::string_view label, std::string sentence,
           std::string_view unit = {});
  /// A sentence for people alone.
  void say(Line line, std::string_view label, std::string sentence);

  // What the jobs have in common.
  void add_seconds(const job::StageSeconds& seconds);
  void add_repairs(const mesh::RepairReport& report);
  void add_notes(const std::vector<Message>& notes);
  /// `silent`: nothing is said where nothing was written.
  void add_files(const std::vector<std::string>& files, bool silent = false);
  /// A line at the end, behind all others and without a label, for people alone.
  void end_with(const std::string& line);

  /// Lines for a person: all, or those of Line::brief alone, if there are such.
  [[nodiscard]] std::string text(Detail detail) const;
  /// One object, its keys in the order in which they were added.
  [[nodiscard]] std::string json() const;

 private:
  std::string title_;
  std::vector<Figure> figures_;
  std::vector<std::string> files_;
  bool tells_files_ = false;
  std::string end_;  ///< lines about what was found
};

}  // namespace ridgecraft::cli
