// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/files/set/temporary_names.hpp"

#include <algorithm>
#include <array>
#include <fstream>

#include <unistd.h>

#include "base/error.hpp"

namespace ridgecraft::cli {
namespace {

constexpr std::string_view prefix = ".ridgecraft-";
constexpr std::size_t kernel_digits = 8;
constexpr std::size_t random_bytes = 12;  // 96 bits: no two runs ever draw the same
constexpr std::size_t id_digits = kernel_digits + 2 * random_bytes;

bool is_hexadecimal(std::string_view text) {
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

/// As std::to_string writes it, and fits an unsigned.
bool is_number(std::string_view text) {
  return !text.empty() && text.size() <= 9 && (text.size() == 1 || text[0] != '0') &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::string hidden_name(const RunId& id, const std::string& rest) {
  return std::string(prefix) + id + rest;
}

}  // namespace

const std::string& this_kernel() {
  static const std::string kernel = [] {
    std::ifstream in("/proc/sys/kernel/random/boot_id");
    std::string digits(kernel_digits, '\0');
    in.read(digits.data(), static_cast<std::streamsize>(digits.size()));
    return in && is_hexadecimal(digits) ? digits : std::string(unknown_kernel);
  }();
  return kernel;
}

RunId new_run_id(std::string_view kernel) {
  std::array<unsigned char, random_bytes> bytes{};
  if (::getentropy(bytes.data(), bytes.size()) != 0) {
    throw Error(ErrorKind::internal, "the system gives no random numbers for names of temporary files");
  }
  constexpr std::string_view digits = "0123456789abcdef";
  RunId id(kernel);
  for (const unsigned char byte : bytes) {
    id += digits[byte >> 4U];
    id += digits[byte & 15U];
  }
  return id;
}

std::string_view kernel_of(const RunId& id) {
  return std::string_view(id).substr(0, kernel_digits);
}

std::string part_name(const RunId& id, unsigned number) {
  return hidden_name(id, "-" + std::to_string(number) + ".part");
}

std::string old_name(const RunId& id, unsigned number) {
  return hidden_name(id, "-" + std::to_string(number) + ".old");
}

std::string journal_name(const RunId& id) {
  return hidden_name(id, ".journal");
}

std::optional<RunId> run_of(std::string_view name) {
  if (!name.starts_with(prefix) || name.size() < prefix.size() + id_digits) {
    return std::nullopt;
  }
  const std::string_view id = name.substr(prefix.size(), id_digits);
  std::string_view rest = name.substr(prefix.size() + id_digits);
  if (!is_hexadecimal(id)) {
    return std::nullopt;
  }
  if (rest == ".journal") {
    return RunId(id);
  }
  for (const std::string_view ending : {".part", ".old"}) {
    if (rest.starts_with('-') && rest.ends_with(ending) &&
        is_number(rest.substr(1, rest.size() - 1 - ending.size()))) {
      return RunId(id);
    }
  }
  return std::nullopt;
}

}  // namespace ridgecraft::cli
