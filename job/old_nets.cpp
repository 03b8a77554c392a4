// SPDX-License-Identifier: GPL-3.0-or-later
#include "job/old_nets.hpp"

#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "mesh/reading/pdo/read_pdo.hpp"

namespace ridgecraft::job {
namespace {

std::vector<std::string> names_in(const verify::Settings& settings, std::string_view key) {
  const verify::Setting* const value = settings.find(key);
  const auto* const text = value == nullptr ? nullptr : std::get_if<std::string>(value);
  std::vector<std::string> names;
  std::istringstream lines(text == nullptr ? "" : *text);
  for (std::string line; std::getline(lines, line);) {
    names.push_back(line);
  }
  return names;
}

}  // namespace

bool is_fold_file(const OldNets& old) {
  return !mesh::may_have_seams(old.bytes);
}

verify::File read_fold_file(const OldNets& old) {
  try {
    return verify::read_file(old.bytes);
  } catch (const verify::NotInForm& reason) {
    throw Error(ErrorKind::unreadable_input, old.name + ": " + reason.message, old.name);
  }
}

prepare::Selection selection_of(std::string_view fold_file) {
  try {
    const verify::Settings settings = verify::read_file(fold_file).settings;
    return {names_in(settings, "only"), names_in(settings, "without")};
  } catch (const verify::NotInForm&) {
    return {};  // the check says what is wrong with it
  }
}

}  // namespace ridgecraft::job
