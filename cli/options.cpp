// SPDX-License-Identifier: GPL-3.0-or-later
// The arguments' first word decides which verb reads the others.
#include "cli/options.hpp"

#include <filesystem>
#include <string_view>
#include <utility>

#include "cli/option_values.hpp"
#include "cli/verbs.hpp"
#include "cli/version.hpp"
#include "mesh/foundation/nearest_word.hpp"

namespace ridgecraft::cli {
namespace {

using Builder = Job (*)(const Arguments*, Manual*);

constexpr std::pair<std::string_view, Builder> verbs[] = {
    {"info", build_info},     {"segment", build_segment}, {"unfold", build_unfold},
    {"verify", build_verify}, {"hulls", build_hulls},     {"cage", build_cage},
    {"shell", build_shell},   {"deform", build_deform},   {"formats", build_formats}};

std::string whole_man_page() {
  Manual program;
  static_cast<void>(build_paper(nullptr, &program));
  std::vector<Manual> manuals;
  for (const auto& [name, build] : verbs) {
    static_cast<void>(build(nullptr, &manuals.emplace_back()));
  }
  return man_page(program, manuals, program_and_version());
}

}  // namespace

std::string program_and_version() {
  return std::string("ridgecraft ") + RIDGECRAFT_VERSION;
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
