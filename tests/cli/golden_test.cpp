// SPDX-License-Identifier: GPL-3.0-or-later
// Each format that is written, each verb's --help and --json, as they were when somebody last looked at them.
#include "support/golden.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/program_checks.hpp"
#include "support/page_document.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft::test;
namespace fs = std::filesystem;
using OrderedJson = nlohmann::ordered_json;

namespace {

using Words = std::vector<std::string>;

const fs::path golden_folder = fs::path(RIDGECRAFT_SOURCE_DIR) / "tests" / "golden";

/// The house, and a tent beside it: two components, so two parts.
void write_model(const TemporaryFolder& folder) {
  write_bytes(folder / "house.obj", std::string(house) +
                                        "v 6 0 0\nv 8 0 0\nv 7 2 0\nv 7 1 2\n"
                                        "f 13 12 11\nf 11 12 14\nf 12 13 14\nf 13 11 14\n");
  write_bytes(folder / "house.seg", "0\n0\n0\n0\n0\n0\n0\n1\n1\n1\n1\n");
}

Outcome run_well(const Words& words, const TemporaryFolder& folder) {
  Outcome outcome = run_program(words, in(folder));
  INFO(words.front() << ": " << outcome.err);
  REQUIRE(outcome.exit_code == 0);
  return outcome;
}

/// All objects of a PDF as text: pages and layers with their unpacked content, catalogue, information. Packed
/// bytes follow zlib's version, and the table of offsets says nothing more.
std::string pdf_text(const std::string& name, const TemporaryFolder& folder) {
  const Outcome qpdf = run_command(
      {"qpdf", "--qdf", "--static-id", "--no-original-object-ids", name, "plain.pdf"}, in(folder));
  INFO(qpdf.err);
  REQUIRE(qpdf.exit_code == 0);
  std::istringstream lines(read_bytes(folder / "plain.pdf"));
  std::string text;
  for (std::string line; std::getline(lines, line) && line != "xref";) {
    // The second line is four bytes that tell mail programs that this isn't text.
    if (line.size() < 2 || line[0] != '%' || static_cast<unsigned char>(line[1]) < 0x80) {
      text += line + "\n";
    }
  }
  return text;
}

/// A picture's size, scale and words: how strokes become pixels is Cairo's.
std::string png_text(const std::string& bytes) {
  const auto number = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      value = value << 8U | static_cast<unsigned char>(bytes[at + i]);
    }
    return value;
  };
  std::ostringstream text;
  for (std::size_t at = 8; at + 12 <= bytes.size(); at += 12 + number(at)) {
    const std::string type = bytes.substr(at + 4, 4);
    std::string data = bytes.substr(at + 8, number(at));
    text << type;
    if (type == "IHDR" || type == "pHYs") {
      text << ' ' << number(at + 8) << ' ' << number(at + 12);
    } else if (type == "tEXt" || type == "iTXt") {
      for (char& c : data) {
        c = c == '\0' ? '|' : c;
      }
      text << ' ' << data;
    }
    text << '\n';
  }
  // However many chunks the pixels take.
  std::string chunks = text.str();
  for (std::size_t at = 0; (at = chunks.find("IDAT\nIDAT\n")) != std::string::npos;) {
    chunks.erase(at, 5);
  }
  return chunks;
}

/// From the man page, where each has a section: ".SH RIDGECRAFT SEGMENT".
std::vector<std::string> all_verbs(const TemporaryFolder& folder) {
  constexpr std::string_view heading = ".SH RIDGECRAFT ";
  std::istringstream lines(run_well({"--man-page"}, folder).out);
  std::vector<std::string> verbs;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(heading)) {
      std::string& verb = verbs.emplace_back(line.substr(heading.size()));
      std::transform(verb.begin(), verb.end(), verb.begin(), [](unsigned char c) { return std::tolower(c); });
    }
  }
  REQUIRE_FALSE(verbs.empty());
  return verbs;
}

/// What --json prints, but for the times.
std::string json_text(const Words& words, const TemporaryFolder& folder) {
  Words with_json = words;
  with_json.emplace_back("--json");
  OrderedJson json = OrderedJson::parse(run_well(with_json, folder).out);
  json.erase("seconds");
  return json.dump(2) + "\n";
}

}  // namespace

TEST_CASE("printed nets are as they were", "[golden]") {
  const TemporaryFolder folder;
  write_model(folder);
  for (const std::string name : {"house.pdf", "house.svg", "house.png", "house.fold"}) {
    run_well({"house.obj", "--size", "45mm", "--paper", "A6", "-o", name}, folder);
  }
  check_golden("files/house.pdf.txt", pdf_text("house.pdf", folder));
  check_golden("files/house.png.txt", png_text(read_bytes(folder / "house.png")));
  // Without numbers, whose strokes would make ten thousand lines.
  run_well({"house.obj", "--size", "45mm", "--paper", "A6", "--preset", "plotter", "--dxf", "r2000", "-o",
            "house.dxf"},
           folder);
  check_golden("files/house.dxf", read_bytes(folder / "house.dxf"));
  for (const std::string name : {"house.lbrn2", "house.eps", "house.plt"}) {
    run_well({"house.obj", "--size", "45mm", "--paper", "A6", "--preset", "plotter", "-o", name}, folder);
    check_golden("files/" + name, read_bytes(folder / name));
  }
  check_golden("files/house.svg", read_bytes(folder / "house.svg"));
  check_golden("files/house.fold", read_bytes(folder / "house.fold"));
  // Of the archive, what is stored: packed bytes follow zlib's version.
  run_well({"house.obj", "--size", "45mm", "--paper", "A6", "-o", "house.ridgecraft"}, folder);
  const std::string project = read_bytes(folder / "house.ridgecraft");
  const std::size_t begin = project.find('{');
  check_golden("files/house.ridgecraft.txt", project.substr(begin, project.find("PK", begin) - begin));
  run_well({"house.obj", "--size", "45mm", "--paper", "A6", "-o", "house.html"}, folder);
  // Of the page, what of the sheets can't be told from the nets; its program isn't made from the model.
  check_golden("files/house.html.txt", page_document(read_bytes(folder / "house.html"), "sheets"));
}

TEST_CASE("parts, nets without pages, hulls, cages and shells are as they were", "[golden]") {
  const TemporaryFolder folder;
  write_model(folder);
  const std::vector<std::pair<Words, Words>> jobs{
      {{"segment", "house.obj", "-o", "parts.ply"}, {"parts.ply"}},
      {{"segment", "house.obj", "-o", "parts.off"}, {"parts.off"}},
      {{"segment", "house.obj", "--labels", "parts.seg", "--hierarchy", "parts.json"},
       {"parts.seg", "parts.json"}},
      {{"unfold", "house.obj", "--tabs", "-o", "nets.fold"}, {"nets.fold"}},
      {{"hulls", "house.obj", "-o", "hulls.obj"}, {"hulls.obj"}},
      {{"hulls", "house.obj", "-o", "robot.urdf"},
       {"robot.urdf", "robot-visual.obj", "robot-hull-1.obj", "robot-hull-2.obj"}},
      {{"hulls", "house.obj", "-o", "robot.xml"}, {"robot.xml"}},
      {{"hulls", "house.obj", "-o", "robot.sdf"}, {"robot.sdf"}},
      {{"hulls", "house.obj", "-o", "robot.usda"}, {"robot.usda"}},
      {{"hulls", "house.obj", "-o", "robot.glb"}, {"robot.glb"}},
      {{"cage", "house.obj", "--faces", "20", "-o", "cage.obj"}, {"cage.obj"}},
      {{"cage", "house.obj", "--faces", "20", "-o", "cage.ply"}, {"cage.ply"}},
      {{"cage", "house.obj", "--faces", "20", "-o", "cage.off"}, {"cage.off"}},
      {{"shell", "house.obj", "--opening", "20%", "-o", "shell.ply"}, {"shell.ply"}},
      {{"deform", "house.obj", "--cage", "cage.off", "--to", "cage.off", "-o", "same.obj"}, {"same.obj"}}};
  for (const auto& [words, names] : jobs) {
    run_well(words, folder);
    for (const std::string& name : names) {
      check_golden("files/" + name, read_bytes(folder / name));
    }
  }
}

TEST_CASE("what --json prints is as it was, but for the times", "[golden]") {
  const TemporaryFolder folder;
  write_model(folder);
  const std::vector<std::pair<std::string, Words>> jobs{
      {"paper", {"house.obj", "--size", "45mm", "--paper", "A6", "-o", "house.fold"}},
      {"info", {"info", "house.obj"}},
      {"segment", {"segment", "house.obj", "--compare", "house.seg", "-o", "parts.off"}},
      {"unfold", {"unfold", "house.obj", "--tabs"}},
      {"verify", {"verify", "house.fold", "--model", "house.obj"}},
      {"hulls", {"hulls", "house.obj", "-o", "hulls.obj"}},
      {"cage", {"cage", "house.obj", "--faces", "20", "-o", "cage.off"}},
      {"shell", {"shell", "house.obj", "--opening", "20%", "-o", "shell.ply"}},
      {"deform", {"deform", "house.obj", "--cage", "cage.off", "--to", "cage.off", "-o", "same.obj"}},
      {"batch", {"batch", "hulls", "house.obj", "-o", "batch"}},
      {"formats", {"formats"}}};
  for (const auto& [verb, words] : jobs) {
    check_golden("json/" + verb + ".json", json_text(words, folder));
  }
}

TEST_CASE("what --help prints is as it was", "[golden]") {
  const TemporaryFolder folder;
  check_golden("help/ridgecraft.txt", run_well({"--help"}, folder).out);
  for (const std::string& verb : all_verbs(folder)) {
    check_golden("help/" + verb + ".txt", run_well({verb, "--help"}, folder).out);
  }
}

TEST_CASE("each format that is written has a golden file, and what each verb prints", "[golden]") {
  const TemporaryFolder folder;
  std::set<std::string> suffixes;
  for (const auto& entry : fs::directory_iterator(golden_folder / "files")) {
    // What isn't text stands there as text: house.pdf.txt.
    const fs::path name = entry.path().filename();
    suffixes.insert((name.extension() == ".txt" ? name.stem() : name).extension().string());
  }
  const OrderedJson formats = OrderedJson::parse(run_well({"formats", "--json"}, folder).out);
  for (const OrderedJson& format : formats.at("written")) {
    CAPTURE(format);
    CHECK(suffixes.contains(format.at("suffix").get<std::string>()));
  }
  for (const std::string& verb : all_verbs(folder)) {
    CAPTURE(verb);
    // The studio prints where its page lies, and no more.
    CHECK((verb == "studio" || fs::exists(golden_folder / "json" / (verb + ".json"))));
  }
}
