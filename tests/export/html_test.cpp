// SPDX-License-Identifier: GPL-3.0-or-later
// Pages for browsers: what a model's name can't do to them, what they promise about the network, and that
// their documents are the nets and what else stands on the sheets.
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "base/random.hpp"
#include "sample_pages.hpp"
#include "support/page_document.hpp"
#include "support/shapes.hpp"

namespace ridgecraft {
namespace {

using test::drawings;
using test::mark;
using test::page_document;
using Json = nlohmann::json;

std::size_t count(std::string_view text, std::string_view what) {
  std::size_t found = 0;
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string_view::npos; at += what.size()) {
    ++found;
  }
  return found;
}

test::SamplePages cube_pages() {
  return test::sample_pages(test::cube(), 40.0, 5.0, {}, "Cube", {}, 0.3);
}

}  // namespace

TEST_CASE("nothing in a document ends it", "[html]") {
  const std::string nasty = "</script><script>alert(1)</script><!--\xe2\x80\xa8\xe2\x80\xa9\\u003c";
  const std::string fold = Json{{"file_title", nasty}}.dump();
  export_::Drawing page;
  page.groups.push_back({"page", {}, {}, {{export_::Layer::mark, nasty, {10.0, 10.0}}}, {}, {}, {}});
  const std::string html = export_::write_html(fold, std::vector{page}, mark);
  const std::string plain = export_::write_html("{}", {}, mark);
  for (const char* part : {"<script", "</script", "<!--"}) {
    CHECK(count(html, part) == count(plain, part));
  }
  CHECK(count(html, "\xe2\x80\xa8") == 0);
  CHECK(Json::parse(page_document(html, "fold")) == Json::parse(fold));
  CHECK(Json::parse(page_document(html, "sheets"))
            .at("pages")
            .at(0)
            .at("groups")
            .at(0)
            .at("texts")
            .at(0)
            .at(1) == nasty);
}

TEST_CASE("whatever bytes a document has, the page gives them back", "[html]") {
  Random random(7);
  for (std::size_t size = 0; size < 3000; size = size * 5 / 4 + 1) {
    std::string bytes;
    while (bytes.size() < size) {
      bytes.push_back(static_cast<char>(random.below(256)));
    }
    const std::string html = export_::write_html(bytes, {}, mark);
    INFO(size << " bytes");
    CHECK(page_document(html, "fold") == bytes);
    CHECK(count(html, std::string_view("\0", 1)) == 0);
    CHECK(count(html, "\r") == 0);
  }
}

TEST_CASE("a name is words, whatever it is", "[html]") {
  const export_::Mark named{"ridgecraft <1>", "</title><b>\"&'@FOLD@\n", "0123456789abcdef"};
  const std::string html = export_::write_html("{}", {}, named);
  CHECK(count(html, "<b>") == 0);
  CHECK(html.find("<title>&lt;/title&gt;&lt;b&gt;&quot;&amp;'@FOLD@") != std::string::npos);
  CHECK(page_document(html, "fold") == "{}");
  CHECK(export_::read_mark_digest(html) == "0123456789abcdef");
}

TEST_CASE("a page loads nothing, and runs nothing but its own script", "[html]") {
  const test::SamplePages sample = cube_pages();
  const std::string html = export_::write_html("{}", drawings(sample), mark);
  const std::size_t policy = html.find("http-equiv=\"Content-Security-Policy\"");
  REQUIRE(policy != std::string::npos);
  CHECK(policy < html.find("<style"));
  CHECK(policy < html.find("<script"));
  for (const char* part :
       {"default-src 'none'", "script-src 'sha256-", "style-src 'sha256-", "base-uri 'none'"}) {
    CHECK(html.find(part, policy) != std::string::npos);
  }
  for (const char* part : {"unsafe", "https:", "//www.w3.org/1999", " src=", "@import", "url(\""}) {
    INFO(part);
    CHECK(count(html, part) == 0);
  }
  // The name of SVG's elements is the only address, and nobody follows it.
  CHECK(count(html, "http:") == count(html, "http://www.w3.org/2000/svg"));
}

TEST_CASE("the second document has the texts of all pages", "[html]") {
  const test::SamplePages sample = cube_pages();
  const std::vector<export_::Drawing> pages = drawings(sample);
  const std::string html = export_::write_html("{}", pages, mark);
  const Json sheets = Json::parse(page_document(html, "sheets"));
  REQUIRE(sheets.at("pages").size() == pages.size());
  for (std::size_t p = 0; p < pages.size(); ++p) {
    const Json& page = sheets["pages"][p];
    CHECK(page.at("size").at(0).get<double>() == Approx(pages[p].size.x).margin(0.005));
    REQUIRE(page.at("groups").size() == pages[p].groups.size());
    for (std::size_t g = 0; g < pages[p].groups.size(); ++g) {
      const export_::Group& group = pages[p].groups[g];
      CHECK(page["groups"][g].at("id") == group.id);
      const Json texts = page["groups"][g].value("texts", Json::array());
      REQUIRE(texts.size() == group.texts.size());
      for (std::size_t t = 0; t < texts.size(); ++t) {
        CHECK(texts[t].at(1) == group.texts[t].text);
        CHECK(texts[t].at(2).get<double>() == Approx(group.texts[t].centre.x).margin(0.051));
        CHECK(texts[t].at(3).get<double>() == Approx(group.texts[t].centre.y).margin(0.051));
      }
    }
  }
}

TEST_CASE("colours and pictures stand in the second document as they are drawn", "[html]") {
  export_::Drawing page;
  export_::Group group;
  group.id = "piece-A";
  group.fills.push_back({{0x12, 0xab, 0xff}, {{{0, 0}, {10.006, 0}, {0, 10}}}});
  group.ground.push_back({{1, 2, 3}, {{{0, 0}, {2, 0}, {0, 2}}}});
  export_::Image image;
  image.place.add({1.0, 2.0});
  image.place.add({3.0, 4.0});
  image.jpeg = std::make_shared<const std::string>("\xff\xd8jpeg");
  image.clip = {{{1, 2}, {3, 2}, {1, 4}}};
  group.images.push_back(image);
  page.groups.push_back(group);
  const Json told = Json::parse(page_document(export_::write_html("{}", std::vector{page}, mark), "sheets"))
                        .at("pages")
                        .at(0)
                        .at("groups")
                        .at(0);
  CHECK(told.at("fills") == Json::parse(R"([["#12abff",[[0,0,10.01,0,0,10]]]])"));
  CHECK(told.at("ground") == Json::parse(R"([["#010203",[[0,0,2,0,0,2]]]])"));
  CHECK(told.at("images") == Json::parse(R"([[[1,2,3,4],"/9hqcGVn",[[1,2,3,2,1,4]]]])"));
}

TEST_CASE("the same result gives the same page", "[html]") {
  const test::SamplePages sample = cube_pages();
  CHECK(export_::write_html("{}", drawings(sample), mark) ==
        export_::write_html("{}", drawings(sample), mark));
}

}  // namespace ridgecraft
