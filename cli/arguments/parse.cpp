// SPDX-License-Identifier: GPL-3.0-or-later
// The arguments' first word decides which verb reads the others.
#include "cli/arguments/parse.hpp"

#include <filesystem>
#include <string_view>
#include <utility>

#include "base/option_values.hpp"
#include "base/text.hpp"
#include "base/version.hpp"
#include "cli/arguments/verbs.hpp"

namespace ridgecraft::cli {
namespace {

using Builder = Job (*)(const Arguments*, Manual*);

constexpr std::pair<std::string_view, Builder> verbs[] = {
    {"info", build_info},     {"segment", build_segment}, {"unfold", build_unfold},  {"verify", build_verify},
    {"hulls", build_hulls},   {"cage", build_cage},       {"shell", build_shell},    {"deform", build_deform},
    {"studio", build_studio}, {"batch", build_batch},     {"formats", build_formats}};

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
  return man_page(manual_of(build_make), manuals, program_and_version());
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

/// Null for a word that is no verb.
Builder builder_of(const std::string& word) {
  for (const auto& [name, build] : verbs) {
    if (word == name) {
      return build;
    }
  }
  return nullptr;
}

std::string nearest_verb(const std::string& word) {
  std::vector<std::string> known;
  for (const auto& [name, build] : verbs) {
    known.emplace_back(name);
  }
  return nearest_word(word, known);
}

[[noreturn]] void refuse_verb(const std::string& word, const std::string& nearest) {
  refuse("there is no verb '" + word + "'" +
         (nearest.empty() ? "; ridgecraft --help lists all" : ", did you mean '" + nearest + "'?"));
}

/// "help", "help unfold", "version".
Job print_asked(const Arguments& arguments) {
  const std::string verb = arguments.size() > 1 && arguments[0] == "help" ? arguments[1] : "";
  if (verb.empty() || verb.starts_with('-')) {
    const Arguments asked{"--" + arguments[0]};
    return build_make(&asked, nullptr);
  }
  const Builder build = builder_of(verb);
  if (build == nullptr) {
    refuse_verb(verb, nearest_verb(verb));
  }
  const Arguments asked{"--help"};
  return build(&asked, nullptr);
}

/// A first word that is no file was meant as a verb if it is nearly one, or if a file follows it.
void refuse_mistaken_verb(const Arguments& arguments) {
  const std::string nearest = nearest_verb(arguments[0]);
  if (!nearest.empty()) {
    refuse_verb(arguments[0], nearest);
  }
  if (arguments.size() == 1 || arguments[1].starts_with('-')) {
    return;
  }
  if (arguments[1].ends_with(".fold")) {
    refuse("there is no verb '" + arguments[0] + "'; pages of nets are made by: ridgecraft MODEL --from " +
           arguments[1]);
  }
  refuse_verb(arguments[0], "");
}

/// "the main job: ridgecraft MODEL --pieces few|parts|small", or the names of all verbs that have this option
/// ("--pieces"); empty where none has it.
std::string verbs_with(const std::string& option) {
  std::vector<std::string> names;
  std::string only;
  if (const std::string term = term_of(option, manual_of(build_make)); !term.empty()) {
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

Job built(Builder build, const Arguments& arguments) {
  try {
    return build(&arguments, nullptr);
  } catch (const UnknownOption& unknown) {
    if (const std::string owners = verbs_with(unknown.option()); !owners.empty()) {
      refuse("there is no option '" + unknown.option() + "' here; it belongs to " + owners);
    }
    throw;
  }
}

}  // namespace

Job parse_arguments(const std::vector<std::string>& arguments) {
  if (arguments.empty()) {
    refuse("name the model to turn into paper, as in: ridgecraft whale.obj; ridgecraft --help says the rest");
  }
  const std::string& first = arguments.front();
  if (const Builder build = builder_of(first); build != nullptr) {
    const Arguments rest(arguments.begin() + 1, arguments.end());
    return built(build, rest);
  }
  if ((first == "help" || first == "version") && !std::filesystem::exists(first)) {
    return print_asked(arguments);
  }
  if (first.find_first_of("./-") == std::string::npos && !std::filesystem::exists(first)) {
    refuse_mistaken_verb(arguments);
  }
  Job job = built(build_make, arguments);
  if (const auto* print = std::get_if<PrintJob>(&job); print != nullptr && print->text == man_page_wanted) {
    return PrintJob{whole_man_page()};
  }
  return job;
}

}  // namespace ridgecraft::cli
