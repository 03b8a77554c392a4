// SPDX-License-Identifier: GPL-3.0-or-later
// Documents name what exists: pages, headings, pictures, and files of the sources. The journal may name what
// is gone.
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

namespace {

namespace fs = std::filesystem;

const fs::path& source_root() {
  static const fs::path root(RIDGECRAFT_SOURCE_DIR);
  return root;
}

std::string whole_text(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// All text files of the sources with one of these suffixes.
std::vector<fs::path> source_files(const std::set<std::string>& suffixes) {
  std::vector<fs::path> found;
  for (auto at = fs::recursive_directory_iterator(source_root()); at != fs::recursive_directory_iterator();
       ++at) {
    const std::string name = at->path().filename().string();
    if (at->is_directory() && (name.starts_with(".") || name.starts_with("build") || name == "golden")) {
      at.disable_recursion_pending();
    } else if (at->is_regular_file() && suffixes.contains(at->path().extension().string())) {
      found.push_back(at->path());
    }
  }
  return found;
}

bool is_journal(const fs::path& file) {
  return file.parent_path().filename() == "journal";
}

/// The pages that readers rely on.
std::vector<fs::path> pages() {
  std::vector<fs::path> found = source_files({".md"});
  std::erase_if(found, is_journal);
  return found;
}

/// All matches of a pattern in a text.
std::vector<std::smatch> all_matches(const std::string& text, const std::regex& pattern) {
  return {std::sregex_iterator(text.begin(), text.end(), pattern), std::sregex_iterator()};
}

/// The anchor that a heading gets: small letters, digits and hyphens.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_') {
      anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else if (c == ' ' || c == '-') {
      anchor += '-';
    }
  }
  return anchor;
}

std::vector<std::string> headings_of(const fs::path& page) {
  std::vector<std::string> found;
  std::ifstream in(page);
  for (std::string line; std::getline(in, line);) {
    const std::size_t text = line.find_first_not_of('#');
    if (text > 0 && text != std::string::npos && line[text] == ' ') {
      found.push_back(line.substr(text + 1));
    }
  }
  return found;
}

/// A file's text with the lines of each comment joined.
std::string with_joined_comments(const fs::path& file) {
  return std::regex_replace(whole_text(file), std::regex(R"(\n[ \t]*//+<?[ \t]*)"), " ");
}

/// Whether a path of the sources exists, as it is or as the name of a header or module without its suffix.
bool exists_in_sources(const std::string& path) {
  for (const char* const suffix : {"", ".hpp", ".cpp", ".js", ".mjs", ".py"}) {
    if (fs::exists(source_root() / (path + suffix))) {
      return true;
    }
  }
  return false;
}

}  // namespace

TEST_CASE("pages and pictures that sources name exist", "[docs]") {
  const std::regex named(R"(docs/[A-Za-z0-9_/.-]+\.(?:md|png))");
  std::size_t seen = 0;
  for (const fs::path& file : source_files({".hpp", ".cpp", ".js", ".mjs", ".py", ".in", ".cmake", ".md"})) {
    if (is_journal(file)) {
      continue;
    }
    const std::string text = whole_text(file);
    for (const std::smatch& match : all_matches(text, named)) {
      INFO(file << " names " << match[0]);
      CHECK(fs::exists(source_root() / match[0].str()));
      ++seen;
    }
    if (file.extension() != ".md" && file.filename() != "docs_test.cpp") {
      INFO(file << " names the journal");
      CHECK(text.find("docs/journal") == std::string::npos);
    }
  }
  CHECK(seen > 50);
}

TEST_CASE("headings that comments name exist", "[docs]") {
  const std::regex named(R"re(docs/([a-z/-]+\.md), "([^"]+)")re");
  std::size_t seen = 0;
  for (const fs::path& file : source_files({".hpp", ".cpp"})) {
    const std::string text = with_joined_comments(file);
    for (const std::smatch& match : all_matches(text, named)) {
      INFO(file << " names " << match[0]);
      bool found = false;
      for (const std::string& heading : headings_of(source_root() / "docs" / match[1].str())) {
        found = found || heading.starts_with(match[2].str());
      }
      CHECK(found);
      ++seen;
    }
  }
  CHECK(seen > 20);
}

TEST_CASE("links of documents lead somewhere", "[docs]") {
  const std::regex link(R"(\]\(([^)\s]+)\))");
  std::size_t seen = 0;
  for (const fs::path& page : pages()) {
    const std::string text = whole_text(page);
    for (const std::smatch& match : all_matches(text, link)) {
      const std::string target = match[1].str();
      if (target.starts_with("http")) {
        continue;
      }
      INFO(page << " links to " << target);
      const std::size_t hash = target.find('#');
      const fs::path file = hash == 0 ? page : page.parent_path() / target.substr(0, hash);
      CHECK(fs::exists(file));
      if (hash != std::string::npos) {
        std::set<std::string> anchors;
        for (const std::string& heading : headings_of(file)) {
          anchors.insert(anchor_of(heading));
        }
        CHECK(anchors.contains(target.substr(hash + 1)));
      }
      ++seen;
    }
  }
  CHECK(seen > 50);
}

TEST_CASE("source files that documents name exist", "[docs]") {
  // A path in backticks whose first folder is one of the sources.
  const std::regex path(R"(`([a-z]+)(/[A-Za-z0-9_./-]*[A-Za-z0-9_/])`)");
  std::size_t seen = 0;
  for (const fs::path& page : pages()) {
    if (page.filename() == "glossary.md") {
      continue;
    }
    const std::string text = whole_text(page);
    for (const std::smatch& match : all_matches(text, path)) {
      if (match[1] == "build" || !fs::is_directory(source_root() / match[1].str())) {
        continue;
      }
      INFO(page << " names " << match[0]);
      CHECK(exists_in_sources(match[1].str() + match[2].str()));
      ++seen;
    }
  }
  CHECK(seen > 20);
}
