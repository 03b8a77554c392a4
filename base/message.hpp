// SPDX-License-Identifier: GPL-3.0-or-later
// What the program says to people, as data: a code and the values that fill the gaps of its text. English
// (english(), the command line) and German (the studio) are renderings of message_table(); nothing reads a
// rendered sentence again.
#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <vector>

namespace ridgecraft {

struct Message;

/// What fills one gap: a text, an option with a value, or further messages.
struct MessageValue {
  MessageValue(std::string_view gap, std::string filling);
  template <std::integral Number>
  MessageValue(std::string_view gap, Number number) : MessageValue(gap, std::to_string(number)) {}
  MessageValue(std::string_view gap, std::vector<Message> messages);

  std::string name;            ///< of the gap; "try": an option that would help
  std::string text;            ///< as the command line or Python has it
  std::string option;          ///< "size" where the text is this option, with ...
  std::string value;           ///< ... this value, or none
  std::vector<Message> items;  ///< instead of the text

  friend bool operator==(const MessageValue&, const MessageValue&) = default;
};

/// One message. Its texts have no full stop.
struct Message {
  explicit Message(std::string_view of_table, std::vector<MessageValue> filling = {});

  std::string code;  ///< a row of message_table()
  std::vector<MessageValue> values;

  friend bool operator==(const Message&, const Message&) = default;
};

/// "--size 200mm" as a value.
[[nodiscard]] MessageValue option_value(std::string_view gap, std::string_view option,
                                        std::string_view value);

/// Words as items.
[[nodiscard]] std::vector<Message> plain_items(const std::vector<std::string>& words);

/// A text that has no code, such as those of the readers of files: it is the same in all languages.
[[nodiscard]] Message plain_message(std::string text);

/// The English text with its gaps filled. Throws std::out_of_range for an unknown code.
[[nodiscard]] std::string english(const Message& message);

/// A row of the table. A gap is {name}; {name|one|many} is the word that fits the number, which # in it
/// stands for; {name, and} joins items, which "; " does without a word.
struct MessageRow {
  std::string_view code;
  std::string_view english;
  std::string_view german;
};

/// All messages, by subject.
[[nodiscard]] const std::vector<MessageRow>& message_table();

}  // namespace ridgecraft
