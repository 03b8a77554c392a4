// SPDX-License-Identifier: GPL-3.0-or-later
// What can go wrong at the edges of the program, as a closed list, and the check of invariants inside it.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/message.hpp"

namespace ridgecraft {

/// Why the program can't do what it was asked. Each kind is one exit code (cli/exit_code.hpp,
/// docs/reference/exit-codes.md).
enum class ErrorKind {
  internal,          ///< a broken promise of our own; never the user's fault
  usage,             ///< an option or argument is wrong
  unreadable_input,  ///< the file is missing, can't be opened, is cut off or isn't in the format it claims
  unusable_mesh,     ///< the file was read, but what it holds can't be made into a surface
  no_nets,           ///< no net of this model can be cut from the paper that was asked for
  unbuildable,       ///< too fine to fold at this size, and --strict was asked for
  cant_write,        ///< a result can't be written
  interrupted,       ///< the user stopped the work
  out_of_time,       ///< the time given passed while there was no result yet
};

/// One message for a person, thrown where files and options meet the program, and caught once, in cli/.
/// what() is its English sentence; it names the file, option or face concerned and ends without a full stop.
class Error : public std::runtime_error {
 public:
  /// `about` is the file that the sentence names. Where a stage knows no files it stays empty: then whoever
  /// knows which model the stage worked on can put its name before the sentence.
  Error(ErrorKind kind, Message message, std::string about = {})
      : std::runtime_error(english(message)),
        kind_(kind),
        message_(std::move(message)),
        about_(std::move(about)) {}
  /// A sentence without a code, such as those of the readers of files.
  Error(ErrorKind kind, const std::string& sentence, std::string about = {})
      : Error(kind, plain_message(sentence), std::move(about)) {}
  [[nodiscard]] ErrorKind kind() const { return kind_; }
  [[nodiscard]] const Message& message() const { return message_; }
  [[nodiscard]] const std::string& about() const { return about_; }

 private:
  ErrorKind kind_;
  Message message_;
  std::string about_;
};

}  // namespace ridgecraft

/// An invariant of our own code: checked in tests, sanitizer and fuzz builds, free of cost in release builds.
#ifdef RIDGECRAFT_ASSERTIONS
#define RIDGECRAFT_ASSERT(condition)                                                         \
  do {                                                                                       \
    if (!(condition)) {                                                                      \
      std::fprintf(stderr, "%s:%d: invariant broken: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                          \
    }                                                                                        \
  } while (false)
#else
#define RIDGECRAFT_ASSERT(condition) static_cast<void>(sizeof(!(condition)))
#endif
