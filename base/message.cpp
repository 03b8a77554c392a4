// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/message.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace ridgecraft {
namespace {

const MessageRow& row_of(std::string_view code) {
  const auto& table = message_table();
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const MessageRow& row) { return row.code == code; });
  if (found == table.end()) {
    throw std::out_of_range("no message " + std::string(code));
  }
  return *found;
}

/// Items in a row: "a; b", or with a word before the last one: "a, b and c".
std::string joined(const std::vector<Message>& items, std::string_view word) {
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) {
      text += word.empty() ? "; " : i + 1 < items.size() ? ", " : " " + std::string(word) + " ";
    }
    text += english(items[i]);
  }
  return text;
}

/// What fills a gap: "n", "n|one|many", "items, and".
std::string filled(std::string_view gap, const Message& message) {
  const std::size_t end = std::min(gap.find_first_of("|,"), gap.size());
  const std::string_view name = gap.substr(0, end);
  const std::string_view rest = gap.substr(end);
  const auto found = std::find_if(message.values.begin(), message.values.end(),
                                  [&](const MessageValue& value) { return value.name == name; });
  if (found == message.values.end()) {
    throw std::out_of_range(message.code + " has no value " + std::string(name));
  }
  if (rest.starts_with('|')) {
    const std::size_t between = rest.find('|', 1);
    std::string words(found->text == "1" ? rest.substr(1, between - 1) : rest.substr(between + 1));
    if (const std::size_t number = words.find('#'); number != std::string::npos) {
      words.replace(number, 1, found->text);
    }
    return words;
  }
  return found->items.empty() ? found->text : joined(found->items, rest.empty() ? "" : rest.substr(2));
}

}  // namespace

MessageValue::MessageValue(std::string_view gap, std::string filling) : name(gap), text(std::move(filling)) {}

MessageValue::MessageValue(std::string_view gap, std::vector<Message> messages)
    : name(gap), items(std::move(messages)) {}

Message::Message(std::string_view of_table, std::vector<MessageValue> filling)
    : code(of_table), values(std::move(filling)) {}

MessageValue option_value(std::string_view gap, std::string_view option, std::string_view value) {
  MessageValue made(gap, "--" + std::string(option) + (value.empty() ? "" : " ") + std::string(value));
  made.option = option;
  made.value = value;
  return made;
}

std::vector<Message> plain_items(const std::vector<std::string>& words) {
  std::vector<Message> items;
  items.reserve(words.size());
  for (const std::string& word : words) {
    items.push_back(plain_message(word));
  }
  return items;
}

Message plain_message(std::string text) {
  return Message("plain", {{"text", std::move(text)}});
}

std::string english(const Message& message) {
  std::string_view text = row_of(message.code).english;
  std::string result;
  while (!text.empty()) {
    const std::size_t open = std::min(text.find('{'), text.size());
    result += text.substr(0, open);
    text.remove_prefix(open);
    if (!text.empty()) {
      const std::size_t close = text.find('}');
      result += filled(text.substr(1, close - 1), message);
      text.remove_prefix(close + 1);
    }
  }
  return result;
}

}  // namespace ridgecraft
