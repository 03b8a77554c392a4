// SPDX-License-Identifier: GPL-3.0-or-later
// The arguments' first word decides which verb reads the others.
#include "cli/arguments/options.hpp"

#include <filesystem>
#include <string_view>
#include <utility>

#include "base/nearest_word.hpp"
#include "base/sentence.hpp"
#include "base/version.hpp"
#include "cli/arguments/option_values.hpp"
#include "cli/arguments/verbs.hpp"

namespace ridgecraft::cli {
namespace {

using Builder = Job (*)(const Arguments*, Manual*);

constexpr std::pair<std::string_view, Builder> verbs[] = {
    {"info", build_info},     {"segment", build_segment}, {"unfold", build_unfold},
    {"verify", build_verify}, {"hulls", build_hulls},     {"cage", build_cage},
    {"shell", build_shell},   {"deform", build_deform},   {"formats", build_formats}};

Manual manual_of(Builder build) {
  Manual manual;
  static_cast<void>(build(nullptr, &manual));
  return manual;
}

std::string whole_man_page() {
  std::vector<Manual> manuals;
  for (const auto& [name, build] : verbs) {
    manuals.push_back(manual_of(build));
  }
  return man_page(manual_of(build_paper), manuals, program_and_version());
}

/// "--size LENGTH" of the manual of a verb that has this option; empty where it hasn't.
std::string term_of(const std::string& option, const Manual& manual) {
  for (const ManualSection& section : manual.sections) {
    for (const ManualEntry& entry : section.entries) {
      const std::size_t at = entry.term.find(option);
      if (at != std::string::npos && (entry.term + " ")[at + option.size()] == ' ' &&
          (at == 0 || entry.term[at - 1] == ' ')) {
        return entry.term.substr(at);
      }
    }
  }
  return {};
}

}  // namespace

std::string verbs_with(const std::string& option) {
  std::vector<std::string> names;
  std::string only;
  if (const std::string term = term_of(option, manual_of(build_paper)); !term.empty()) {
    names.emplace_back("the main job");
    only = ": ridgecraft MODEL " + term;
  }
  for (const auto& [name, build] : verbs) {
    if (const std::string term = term_of(option, manual_of(build)); !term.empty()) {
      names.emplace_back(name);
      only = ": ridgecraft " + names.back() + " ... " + term;
    }
  }
  return listed(names, "and") + (names.size() == 1 ? only : "");
}

Job parse_arguments(const std::vector<std::string>& arguments) {
  if (arguments.empty()) {
    refuse(
        "name the model to turn into paper, as in: ridgecraft whale.obj; ridgecraft --help tells the rest");
  }
  std::vector<std::string> known;
  for (const auto& [name, build] : verbs) {
    known.emplace_back(name);
    if (arguments.front() == name) {
      const Arguments rest(arguments.begin() + 1, arguments.end());
      return build(&rest, nullptr);
    }
  }
  const std::string& first = arguments.front();
  if ((first == "help" || first == "version") && !std::filesystem::exists(first)) {
    const Arguments asked{"--" + first};
    return build_paper(&asked, nullptr);
  }
  if (first.find_first_of("./-") == std::string::npos && !std::filesystem::exists(first)) {
    if (const std::string verb = nearest_word(first, known); !verb.empty()) {
      refuse("there is no verb '" + first + "', did you mean '" + verb + "'?");
    }
  }
  Job job = build_paper(&arguments, nullptr);
  if (const auto* print = std::get_if<PrintJob>(&job); print != nullptr && print->text == man_page_wanted) {
    return PrintJob{whole_man_page()};
  }
  return job;
}

}  // namespace ridgecraft::cli
