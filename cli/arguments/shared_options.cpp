// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/arguments/shared_options.hpp"

#include <algorithm>
#include <thread>

#include "base/option_values.hpp"
#include "base/text.hpp"
#include "mesh/model/soup.hpp"

namespace ridgecraft::cli {

void require(const std::string& value, const std::string& what, const std::string& verb) {
  if (value.empty()) {
    refuse(what + "; see " + verb + " --help");
  }
}

std::string model_formats() {
  return listed(mesh::format_names(), "or");
}

void add_model(Verb& verb, std::string& model) {
  verb.option("Input", "MODEL", model, "MODEL", model_formats() + "; - reads standard input.");
}

void add_options(Verb& verb, job::AskedOptions& asked, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    verb.add(option_row(name), asked);
  }
}

void add_common(Verb& verb, job::AskedOptions& asked, TimeUp time_up) {
  add_options(verb, asked, {"json", "quiet", "verbose", "seed", "threads"});
  verb.add(
      option_row("time-limit"), asked, "",
      time_up == TimeUp::ends_searches
          ? ""
          : "Stop after this time, with exit code 130 and nothing written, unless all is done by then (no "
            "limit).");
}

CommonOptions common_of(const job::AskedOptions& asked) {
  constexpr std::uint64_t most_threads = 256;
  CommonOptions common;
  common.json = asked.flag("json");
  common.quiet = asked.flag("quiet");
  common.verbose = asked.flag("verbose");
  common.seed = asked.whole("seed");
  common.threads = asked.given("threads")
                       ? static_cast<unsigned>(std::min(asked.whole("threads"), most_threads))
                       : std::max(1U, std::thread::hardware_concurrency());
  if (asked.given("time-limit")) {
    common.time_limit_s = asked.number("time-limit");
  }
  return common;
}

SizeRequest size_of(const job::AskedOptions& asked) {
  SizeRequest size{"--size 150mm"};
  for (const std::string name : {"size", "width", "depth", "height"}) {
    if (asked.given(name)) {
      const std::string typed = asked.text(name);
      std::string_view text = typed;
      const auto length = take_length(text);
      size = {asked.called(name) + " " + typed, length && !length->mm_per_unit};
    }
  }
  if (asked.given("scale")) {
    size.words = "--scale " + asked.text("scale");
    if (asked.given("unit")) {
      size.words += " --unit " + asked.text("unit");
    } else {
      size.scale = parse_scale(asked.text("scale"));
    }
  }
  return size;
}

EdgeArguments edges_of(const job::AskedOptions& asked, const prepare::SimplifyOptions& simplify) {
  if ((asked.given("cuts") || asked.given("keep")) && simplify.mode == prepare::Simplification::count) {
    refuse(Message("edges_and_faces", {{"option", asked.called(asked.given("cuts") ? "cuts" : "keep")},
                                       option_value("faces", "faces", std::to_string(simplify.faces))}));
  }
  return {asked.text("cuts"), asked.text("keep"), asked.text("from")};
}

}  // namespace ridgecraft::cli
