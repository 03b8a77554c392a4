// SPDX-License-Identifier: GPL-3.0-or-later
// Options that several verbs have: as typed, and what they mean.
#pragma once

#include <string>

#include "cli/arguments/options.hpp"
#include "cli/arguments/verb.hpp"
#include "prepare/selection/selection.hpp"

namespace ridgecraft::cli {

/// What --time-limit means to a verb.
enum class TimeUp {
  stops_program,  ///< there is a whole result or none
  ends_searches,  ///< what was found so far is finished
};

/// "OBJ, STL, PLY, OFF, GLB, glTF, 3MF or PDO"
[[nodiscard]] std::string model_formats();

/// The argument of the verbs that read one model.
void add_model(Verb& verb, std::string& model);

/// --only and --without.
void add_selection(Verb& verb, prepare::Selection& selection);

/// What every verb takes.
struct CommonTexts {
  CommonOptions values;
  std::string time_limit, seed, threads;

  void add_to(Verb& verb, TimeUp time_up = TimeUp::stops_program);
  [[nodiscard]] CommonOptions checked() const;
};

/// How a model is brought to paper size.
struct SizeTexts {
  std::string size, width, depth, height, up, scale, unit, faces;
  bool adapts = false;  ///< without --size and --scale the model decides

  void add_to(Verb& verb, const std::string& default_faces);
  /// Sets the size and how the model is simplified. Throws Error(usage).
  void check_into(job::Options& options, AskedSize& asked) const;
};

}  // namespace ridgecraft::cli
