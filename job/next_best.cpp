// SPDX-License-Identifier: GPL-3.0-or-later
#include "job/next_best.hpp"

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/message.hpp"

namespace ridgecraft::job {
namespace {

/// A change, which the next ones come on top of.
struct Change {
  const char* code;  ///< of the message that says it
  /// False where the options are like that already.
  bool (*make)(Options& options, Context& context);
};

constexpr std::array changes{
    Change{"instead_seed",
           [](Options&, Context& context) {
             ++context.seed;
             return true;
           }},
    Change{"instead_bodies",
           [](Options& options, Context&) {
             return std::exchange(options.bodies, prepare::Bodies::keep) != prepare::Bodies::keep;
           }},
    Change{"instead_regions",
           [](Options& options, Context&) { return std::exchange(options.pieces.max_panels, 1U) != 1U; }},
    Change{"instead_tabs",
           [](Options& options, Context&) { return std::exchange(options.tabs.wanted, false); }},
};

bool ends_attempts(const Error& error) {
  return error.kind() == ErrorKind::interrupted || error.kind() == ErrorKind::out_of_time;
}

/// What was wrong, without the sentence around it.
std::string fault_of(const Message& message) {
  return message.code == "failed_check" ? message.values.front().text : english(message);
}

void add_note(Result& made, Message note) {
  made.nets.notes.insert(made.nets.notes.begin(), note);
  made.early_notes.insert(made.early_notes.begin(), std::move(note));
}

}  // namespace

Result next_best(const Options& options, const Context& context, const Attempt& attempt) {
  std::optional<Message> fault;
  try {
    return attempt(options, context);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::internal) {
      throw;
    }
    fault = error.message();
  }
  Options changed = options;
  Context changed_context = context;
  for (const Change& change : changes) {
    if (!change.make(changed, changed_context)) {
      continue;
    }
    try {
      Result made = attempt(changed, changed_context);
      add_note(made, Message("instead",
                             {{"what", std::vector{Message(change.code)}}, {"fault", fault_of(*fault)}}));
      return made;
    } catch (const Error& error) {
      if (ends_attempts(error)) {
        throw;
      }
    }
  }
  throw Error(ErrorKind::internal, *fault);
}

}  // namespace ridgecraft::job
