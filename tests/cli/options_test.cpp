// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/net/options.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "base/error.hpp"
#include "cli/arguments/parse.hpp"
#include "cli/program_checks.hpp"

using namespace ridgecraft;
using namespace ridgecraft::cli;

namespace {

std::string refusal(const std::vector<std::string>& arguments) {
  try {
    static_cast<void>(parse_arguments(arguments));
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::usage);
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("what --pack says counts for pages", "[options]") {
  const auto packing = [](const std::string& word) {
    return std::get<MakeJob>(parse_arguments({"whale.obj", "--pack", word})).options.paper->packing;
  };
  CHECK(packing("fast") == export_::PackingEffort::fast);
  CHECK(packing("good") == export_::PackingEffort::good);
  CHECK(packing("best") == export_::PackingEffort::good);
  CHECK(refusal({"whale.obj", "--pack", "slow"}).find("--pack") != std::string::npos);
}

TEST_CASE("what --grain says counts for pages", "[options]") {
  const auto grain = [](const std::string& word) {
    return std::get<MakeJob>(parse_arguments({"whale.obj", "--grain", word})).options.paper->grain;
  };
  CHECK(grain("any") == export_::Grain::any);
  CHECK(grain("long") == export_::Grain::long_side);
  CHECK(grain("short") == export_::Grain::short_side);
  CHECK(refusal({"whale.obj", "--grain", "up"}).find("--grain") != std::string::npos);
}

TEST_CASE("a model alone gets the defaults that a maker would choose", "[options]") {
  const Job job = parse_arguments({"whale.obj"});
  const auto& paper = std::get<MakeJob>(job);
  CHECK(paper.model == "whale.obj");
  CHECK(paper.outputs.empty());
  CHECK(paper.options.size.largest_extent_mm == 150.0);
  CHECK(paper.options.simplify.mode == prepare::Simplification::automatic);
  CHECK(paper.options.paper->size == Vec2{210.0, 297.0});
  CHECK(paper.options.paper->margin == 10.0);
  CHECK(paper.options.paper->packing == export_::PackingEffort::fast);
  CHECK(paper.options.tabs.wanted);
  CHECK(paper.options.tabs.height_mm == 5.0);
  CHECK(paper.options.concavity == 0.1);
  CHECK(paper.common.seed == 1);
  CHECK(paper.common.threads >= 1);
}

TEST_CASE("options may stand anywhere, and -o is repeatable", "[options]") {
  const Job job =
      parse_arguments({"-o", "a.pdf", "--size", "20cm", "whale.obj", "-o", "b.svg", "--paper=letter"});
  const auto& paper = std::get<MakeJob>(job);
  CHECK(paper.model == "whale.obj");
  CHECK(paper.outputs == std::vector<std::string>{"a.pdf", "b.svg"});
  CHECK(paper.options.size.largest_extent_mm == 200.0);
  CHECK(paper.options.paper->size.x == Approx(215.9));
}

TEST_CASE("an option that is repeated takes one value each time", "[options]") {
  const auto model = [](const std::vector<std::string>& words) {
    return std::get<MakeJob>(parse_arguments(words)).model;
  };
  CHECK(model({"-o", "out", "whale.obj"}) == "whale.obj");
  CHECK(model({"--only", "roof", "whale.obj"}) == "whale.obj");
  CHECK(model({"--weigh", "pieces=2", "whale.obj"}) == "whale.obj");
  const Job job = parse_arguments({"verify", "--pages", "a.pdf", "nets.fold", "--pages", "b.svg"});
  CHECK(std::get<VerifyJob>(job).file == "nets.fold");
  CHECK(std::get<VerifyJob>(job).pages == std::vector<std::string>{"a.pdf", "b.svg"});
  const Job parts = parse_arguments({"segment", "--compare", "a.seg", "b.seg", "whale.obj"});
  CHECK(std::get<SegmentJob>(parts).model == "whale.obj");
  CHECK(std::get<SegmentJob>(parts).compare == std::vector<std::string>{"a.seg", "b.seg"});
  CHECK(refusal({"-o", "out", "whale.obj", "fish.obj"}).find("fish.obj") != std::string::npos);
}

TEST_CASE("folds are hidden below an angle in degrees", "[options]") {
  const Job job = parse_arguments({"whale.obj", "--hide-folds", "10"});
  const auto& options = std::get<MakeJob>(job).options;
  CHECK(options.style.hidden_fold_angle == Approx(0.17453).epsilon(1e-4));
}

TEST_CASE("a scale says how large one unit becomes", "[options]") {
  const Job job = parse_arguments({"house.obj", "--scale", "1:50", "--unit", "m"});
  CHECK(*std::get<MakeJob>(job).options.size.mm_per_unit == Approx(20.0));
}

TEST_CASE("verbs get their jobs", "[options]") {
  CHECK(std::get<InfoJob>(parse_arguments({"info", "a.obj"})).model == "a.obj");
  CHECK(std::get<SegmentJob>(parse_arguments({"segment", "a.obj", "--labels", "a.seg"})).labels == "a.seg");
  CHECK(std::get<UnfoldJob>(parse_arguments({"unfold", "a.obj", "--whole", "-o", "a.fold"})).options.parts ==
        job::PartsFrom::components);
  CHECK(std::get<UnfoldJob>(parse_arguments({"unfold", "a.obj"})).options.simplify.mode ==
        prepare::Simplification::keep);
  CHECK(std::get<VerifyJob>(parse_arguments({"verify", "a.fold", "--json"})).common.json);
  CHECK(std::holds_alternative<FormatsJob>(parse_arguments({"formats"})));
}

TEST_CASE("a model named like a verb is reached by its path", "[options]") {
  CHECK(std::get<MakeJob>(parse_arguments({"./info"})).model == "./info");
}

TEST_CASE("help opens with examples and names every option", "[options]") {
  const std::string help = std::get<PrintJob>(parse_arguments({"--help"})).text;
  CHECK(help.find("Examples:") < help.find("Usage:"));
  for (const char* word :
       {"--size", "--faces", "--paper", "--margin", "--tab-height", "--concavity", "--json", "--seed",
        "--threads", "--time-limit", "--overwrite", "-o", "verify FILE.fold", "130"}) {
    CAPTURE(word);
    CHECK(help.find(word) != std::string::npos);
  }
  CHECK(help.find("--man-page") == std::string::npos);
  CHECK(std::get<PrintJob>(parse_arguments({"unfold", "--help"})).text.find("--whole") != std::string::npos);
}

TEST_CASE("the man page has the same texts as --help", "[options]") {
  const std::string man = std::get<PrintJob>(parse_arguments({"--man-page"})).text;
  CHECK(man.starts_with(".TH RIDGECRAFT 1"));
  CHECK(man.find("simplifies a model whose edges would be too short to fold") != std::string::npos);
  CHECK(man.find("\\-\\-whole") != std::string::npos);
}

TEST_CASE("wrong arguments are refused in one sentence", "[options]") {
  const std::vector<std::vector<std::string>> wrong = {
      {},
      {"--size", "150mm"},
      {"a.obj", "b.obj"},
      {"a.obj", "--size", "0"},
      {"a.obj", "--size", "huge"},
      {"a.obj", "--size"},
      {"a.obj", "--size", "10cm", "--scale", "2"},
      {"a.obj", "--unit", "m"},
      {"a.obj", "--scale", "1:2", "--unit", "elephant"},
      {"a.obj", "--faces", "3"},
      {"a.obj", "--faces", "some"},
      {"a.obj", "--paper", "a44"},
      {"a.obj", "--margin", "200mm"},
      {"a.obj", "--margin", "-1"},
      {"a.obj", "--concavity", "0"},
      {"a.obj", "--concavity", "nan"},
      {"a.obj", "--seed", "-1"},
      {"a.obj", "--seed", "x"},
      {"a.obj", "--threads", "0"},
      {"a.obj", "--time-limit", "-3"},
      {"a.obj", "--tab-height", "0"},
      {"a.obj", "--frobnicate"},
      {"segment"},
      {"segment", "a.obj", "--concavity", "-1"},
      {"segment", "a.obj", "--parts", "0"},
      {"segment", "a.obj", "--parts", "3", "--concavity", "0.1"},
      {"segment", "a.obj", "--effort", "4"},
      {"segment", "a.obj", "--holes", "some"},
      {"segment", "a.obj", "--components", "loose"},
      {"segment", "a.obj", "--reading", "c"},
      {"segment", "a.obj", "--parts", "3", "--reading", "a"},
      {"unfold"},
      {"verify"},
      {"formats", "x"},
  };
  for (const auto& arguments : wrong) {
    CAPTURE(arguments);
    const std::string sentence = refusal(arguments);
    CHECK_FALSE(sentence.empty());
    CHECK(sentence.find('\n') == std::string::npos);
  }
}

TEST_CASE("an option that is given twice counts as it stands last", "[options]") {
  CHECK(
      std::get<MakeJob>(parse_arguments({"a.obj", "--paper", "A4", "--paper", "A3"})).options.paper->size.x ==
      297.0);
}

TEST_CASE("no entry of the help is without a name", "[options]") {
  const std::string help = std::get<PrintJob>(parse_arguments({"--help"})).text;
  CHECK(help.find("\n:") == std::string::npos);
  CHECK(help.find("Print the manual page") == std::string::npos);
  CHECK(help.find("-o, --output") != std::string::npos);
}

TEST_CASE("a near miss gets a suggestion", "[options]") {
  CHECK(refusal({"unfoldd", "whale.obj"}).find("'unfold'") != std::string::npos);
  CHECK(refusal({"a.obj", "--siez", "3cm"}).find("--size") != std::string::npos);
  CHECK(refusal({"a.obj", "--paper", "a44"}).find("A4") != std::string::npos);
}

TEST_CASE("what isn't a number is refused by its option's name", "[options]") {
  for (const char* option :
       {"--tab-angle", "--hide-folds", "--concavity", "--time-limit", "--seed", "--threads"}) {
    for (const char* value : {"x", "", "1e", "5 5", "0x10", "1,5", "nan"}) {
      CAPTURE(option, value);
      CHECK(refusal({"a.obj", std::string(option) + "=" + value}).find(option) != std::string::npos);
    }
  }
}

TEST_CASE("an option of another verb is told as such", "[options]") {
  CHECK(refusal({"unfold", "m.obj", "--pieces", "few"}) ==
        "there is no option '--pieces' here; it belongs to the main job: ridgecraft MODEL --pieces "
        "few|parts|small");
  CHECK(
      refusal({"m.obj", "--labels=parts.seg"}) ==
      "there is no option '--labels' here; it belongs to segment: ridgecraft segment ... --labels FILE.seg");
  CHECK(refusal({"info", "m.obj", "--cuts", "x"}) ==
        "there is no option '--cuts' here; it belongs to the main job and unfold");
  // What no verb has may be a slip; and a part of a name is no name.
  CHECK(refusal({"m.obj", "--fases", "300"}) == "there is no option '--fases', did you mean '--faces'?");
  CHECK(refusal({"verify", "m.fold", "--label", "x"}).find("belongs") == std::string::npos);
  CHECK(refusal({"verify", "m.fold", "--", "x"}).find("belongs") == std::string::npos);
}

TEST_CASE("a name that begins with a dash is told as it was typed, and where it may stand", "[options]") {
  for (const std::string name : {"-h.obj", "-x.obj", "-qx.obj", "--house.obj"}) {
    CHECK(refusal({name}) == "there is no option '" + name +
                                 "'; a file of this name stands behind --, as in: ridgecraft -- " + name);
  }
  CHECK(refusal({"info", "-h.obj"}).ends_with("as in: ridgecraft info -- -h.obj"));
  CHECK(refusal({"a.obj", "-x"}) == "there is no option '-x'; see ridgecraft --help");
  CHECK(std::get<MakeJob>(parse_arguments({"--", "-h.obj"})).model == "-h.obj");
}

TEST_CASE("a second model is refused with what a run takes", "[options]") {
  CHECK(refusal({"a.obj", "b.obj"}) ==
        "'b.obj' is one argument too many: a run takes one model; see ridgecraft --help");
  CHECK(refusal({"info", "a.obj", "b.obj"}).find("a run takes one model") != std::string::npos);
  CHECK(refusal({"verify", "a.fold", "b.fold"}).find("a run takes one file") != std::string::npos);
  CHECK(refusal({"formats", "x"}) == "'x' is one argument too many; see ridgecraft formats --help");
}

TEST_CASE("help for a verb is that verb's", "[options]") {
  const auto text = [](const std::vector<std::string>& arguments) {
    return std::get<PrintJob>(parse_arguments(arguments)).text;
  };
  CHECK(text({"help"}) == text({"--help"}));
  CHECK(text({"help", "unfold"}) == text({"unfold", "--help"}));
  CHECK(text({"help", "--json"}) == text({"--help"}));
  CHECK(refusal({"help", "unfoldd"}) == "there is no verb 'unfoldd', did you mean 'unfold'?");
  CHECK(refusal({"help", "export"}) == "there is no verb 'export'; ridgecraft --help lists all");
}

TEST_CASE("a word before a file is told to be no verb", "[options]") {
  CHECK(refusal({"export", "nets.fold", "-o", "x.pdf"}) ==
        "there is no verb 'export'; pages of nets are made by: ridgecraft MODEL --from nets.fold");
  CHECK(refusal({"export", "a.obj"}) == "there is no verb 'export'; ridgecraft --help lists all");
  CHECK(std::get<MakeJob>(parse_arguments({"export"})).model == "export");
  CHECK(std::get<MakeJob>(parse_arguments({"export", "-o", "x.pdf"})).model == "export");
}

TEST_CASE("each help says what a time limit does there", "[options]") {
  const auto help = [](const std::vector<std::string>& verb) {
    std::vector<std::string> arguments = verb;
    arguments.emplace_back("--help");
    std::string text = std::get<PrintJob>(parse_arguments(arguments)).text;
    text = text.substr(text.find("--time-limit"));
    return text.substr(0, text.find(')'));
  };
  for (const std::vector<std::string>& verb : {std::vector<std::string>{}, {"unfold"}}) {
    CHECK(help(verb).find("searches stop with the best") != std::string::npos);
  }
  for (const char* verb : {"info", "segment", "verify", "hulls", "cage", "shell", "deform"}) {
    CAPTURE(verb);
    CHECK(help({verb}).find("exit code 130") != std::string::npos);
    CHECK(help({verb}).find("searches") == std::string::npos);
  }
}

TEST_CASE("help tells the weights that hold", "[options]") {
  const std::string help = test::run_program({"--help"}, {}).out;
  unfold::Weights weights = unfold::rules_of(unfold::PieceMode::parts).weights;
  for (const std::string_view term : unfold::term_names()) {
    CAPTURE(std::string(term));
    CHECK(help.find(fmt::format(" {}={:g}: ", term, *unfold::weight_named(weights, term))) !=
          std::string::npos);
  }
}
