// SPDX-License-Identifier: GPL-3.0-or-later
// Options that several verbs have: how they are added, and what they mean.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "cli/arguments/options.hpp"
#include "cli/arguments/verb.hpp"
#include "job/asked_options.hpp"

namespace ridgecraft::cli {

/// What --time-limit means to a verb.
enum class TimeUp {
  stops_program,  ///< there is a whole result or none
  ends_searches,  ///< what was found so far is finished
};

/// Refuses an argument that wasn't given: `what` to do, and whose --help tells more.
void require(const std::string& value, const std::string& what, const std::string& verb);

/// "OBJ, STL, PLY, OFF, GLB, glTF, 3MF or PDO"
[[nodiscard]] std::string model_formats();

/// The argument of the verbs that read one model.
void add_model(Verb& verb, std::string& model);

/// Adds rows of the table.
void add_options(Verb& verb, job::AskedOptions& asked, std::initializer_list<std::string_view> names);

/// What every verb takes.
void add_common(Verb& verb, job::AskedOptions& asked, TimeUp time_up = TimeUp::stops_program);
[[nodiscard]] CommonOptions common_of(const job::AskedOptions& asked);

/// How the size was asked for.
[[nodiscard]] SizeRequest size_of(const job::AskedOptions& asked);

/// --cuts, --keep and --from. Throws Error(usage) where edges are named of a model that is to be simplified
/// to a number of faces: it would have others.
[[nodiscard]] EdgeArguments edges_of(const job::AskedOptions& asked,
                                     const prepare::SimplifyOptions& simplify);

}  // namespace ridgecraft::cli
