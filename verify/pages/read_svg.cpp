// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <string>
#include <utility>

#include <pugixml.hpp>

#include "base/elementary.hpp"
#include "verify/file/tolerance.hpp"
#include "verify/pages/readers.hpp"

namespace ridgecraft::verify {
namespace {

constexpr std::string_view separators = " \t\r\n\f,";

class PathReader {
 public:
  explicit PathReader(std::string_view data) : rest_(data) {}

  std::vector<std::vector<Vec2>> read() {
    skip_separators();
    while (!rest_.empty()) {
      const char first = rest_.front();
      const bool is_letter = (first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z');
      if (is_letter) {
        command_ = first;
        rest_.remove_prefix(1);
      } else if (command_ == 'M' || command_ == 'm') {
        command_ = command_ == 'M' ? 'L' : 'l';  // further points of a move are lines
      } else if (command_ == 'z' || command_ == 'Z' || command_ == '\0') {
        cannot_check("a path has numbers without a command");
      }
      draw();
      skip_separators();
    }
    end_line();
    return std::move(lines_);
  }

 private:
  void draw() {
    const bool relative = command_ >= 'a';
    const Vec2 origin = relative ? at_ : Vec2{};
    switch (command_) {
      case 'M':
      case 'm':
        end_line();
        at_ = origin + point();
        line_ = {at_};
        break;
      case 'L':
      case 'l':
        line_to(origin + point());
        break;
      case 'H':
      case 'h':
        line_to({origin.x + number(), at_.y});
        break;
      case 'V':
      case 'v':
        line_to({at_.x, origin.y + number()});
        break;
      case 'Z':
      case 'z':
        close();
        break;
      default:
        cannot_check("a path has the command {}, and only straight lines can be checked",
                     command_ >= ' ' ? command_ : '?');
    }
  }

  void line_to(Vec2 p) {
    if (line_.empty()) {
      cannot_check("a path draws before it has a place");
    }
    line_.push_back(p);
    at_ = p;
  }

  void close() {
    if (line_.empty()) {
      cannot_check("a path closes a line that it hasn't begun");
    }
    at_ = line_.front();
    line_.push_back(at_);
    end_line();
    line_ = {at_};
  }

  void end_line() {
    if (line_.size() > 1) {
      lines_.push_back(std::move(line_));
    }
    line_.clear();
  }

  void skip_separators() { rest_.remove_prefix(std::min(rest_.find_first_not_of(separators), rest_.size())); }

  Vec2 point() {
    const double x = number();
    return {x, number()};
  }

  double number() {
    skip_separators();
    if (!rest_.empty() && rest_.front() == '+') {
      rest_.remove_prefix(1);
    }
    double value = 0.0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error != std::errc{} || !(std::abs(value) <= max_coordinate_mm)) {
      cannot_check("a path has something that is no length");
    }
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return value;
  }

  std::string_view rest_;
  char command_ = '\0';
  Vec2 at_;
  std::vector<Vec2> line_;
  std::vector<std::vector<Vec2>> lines_;
};

// SVG pages: layers, groups and paths. Attributes that could move, hide or restyle a line are refused: a line
// that is overlooked or read at a wrong place would be worse than a file that can't be checked.

/// How a path is drawn where it doesn't say so itself.
struct Look {
  std::string_view stroke = "none";
  std::string_view width = "1";
  std::string_view dashes = "none";
  std::string_view fill = "black";
};

std::optional<double> plain_number(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool all = end == text.data() + text.size();
  return error == std::errc{} && all && std::abs(value) <= max_coordinate_mm ? std::optional(value)
                                                                             : std::nullopt;
}

std::vector<double> numbers(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n,";
  std::vector<double> result;
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    if (text.empty()) {
      return result;
    }
    const std::string_view word = text.substr(0, text.find_first_of(blanks));
    const auto number = plain_number(word);
    if (!number || *number < 0.0) {
      cannot_check("a list of lengths isn't one: {}", word.substr(0, 40));
    }
    result.push_back(*number);
    text.remove_prefix(word.size());
  }
}

/// White lines are no lines; a colour by another way than its bytes counts as one that can be seen.
bool is_white(std::string_view color) {
  if (color == "white") {
    return true;
  }
  if (color.size() != 7 || color[0] != '#') {
    return false;
  }
  unsigned value = 0;
  const auto [end, error] = std::from_chars(color.data() + 1, color.data() + color.size(), value, 16);
  if (error != std::errc{} || end != color.data() + color.size()) {
    return false;
  }
  const auto bright = [&](unsigned shift) { return ((value >> shift) & 0xffU) >= white * 255.0; };
  return bright(0) && bright(8) && bright(16);
}

bool may_have(std::string_view attribute) {
  constexpr std::array<std::string_view, 9> known = {"id",
                                                     "d",
                                                     "fill",
                                                     "stroke",
                                                     "stroke-width",
                                                     "stroke-linecap",
                                                     "stroke-linejoin",
                                                     "aria-label",
                                                     "stroke-dasharray"};
  return attribute.starts_with("inkscape:") || attribute.starts_with("sodipodi:") ||
         std::find(known.begin(), known.end(), attribute) != known.end();
}

/// Before the number in the ids of pages' layers, where a file has several.
constexpr std::string_view page_prefix = "page-";

class SvgReader {
 public:
  explicit SvgReader(PrintedFile& file) : file_(file) {}

  void read(pugi::xml_node root) {
    expect_plain_root(root);
    const Vec2 size = read_size(root);
    const std::string_view words = root.child_value("metadata");
    file_.digest = digest_in(words);
    // Words of ours stand before the settings.
    file_.preset = preset_in(words.substr(0, words.find('{')));
    file_.thickness_mm = thickness_in(words);
    if (!file_.shows_nets()) {
      return;
    }
    if (const pugi::xml_node view = root.child("sodipodi:namedview"); view.child("inkscape:page")) {
      read_pages(root, view);
    } else {
      PrintedPage page;
      page.name = file_.name;
      page.size = size;
      read_page_words(std::string_view(root.child_value("title")), page);
      read_layers(root, {}, std::move(page));
    }
    undo_calibration(root.child_value("metadata"), file_);
  }

 private:
  /// The root says how large the page is and names what it uses; texts about the file hold nothing else.
  static void expect_plain_root(pugi::xml_node root) {
    constexpr std::array<std::string_view, 6> known = {"width",   "height", "viewBox",
                                                       "version", "id",     "xmlns"};
    for (const pugi::xml_attribute attribute : root.attributes()) {
      const std::string_view name = attribute.name();
      if (std::find(known.begin(), known.end(), name) == known.end() && !name.starts_with("xmlns:") &&
          !name.starts_with("inkscape:") && !name.starts_with("sodipodi:")) {
        cannot_check("its root has the attribute \"{}\", which may change what is printed", name);
      }
    }
    for (const pugi::xml_node node : root.children()) {
      for (const pugi::xml_node inner : is_silent(node) ? node.children() : pugi::xml_node().children()) {
        const std::string_view name = inner.name();
        if (inner.type() == pugi::node_element && !name.starts_with("inkscape:")) {
          cannot_check("its <{}> has a <{}>, which may change what is printed", node.name(), name);
        }
      }
    }
  }

  static double millimetres(pugi::xml_node root, const char* attribute) {
    const std::string_view text = root.attribute(attribute).value();
    const auto value = text.ends_with("mm") ? plain_number(text.substr(0, text.size() - 2)) : std::nullopt;
    if (!value || !(*value > 0.0)) {
      cannot_check("its {} isn't in millimetres", attribute);
    }
    return *value;
  }

  Vec2 read_size(pugi::xml_node root) {
    const Vec2 size{millimetres(root, "width"), millimetres(root, "height")};
    const std::vector<double> box = numbers(root.attribute("viewBox").value());
    if (box.size() != 4 || !(box[2] > 0.0 && box[3] > 0.0)) {
      cannot_check("it has no viewBox, so its unit isn't known");
    }
    origin_ = {box[0], box[1]};
    mm_ = {size.x / box[2], size.y / box[3]};
    return size;
  }

  static double unit(pugi::xml_node node, const char* attribute) {
    const auto value = plain_number(node.attribute(attribute).value());
    if (!value) {
      cannot_check("the {} of one of its pages is no number", attribute);
    }
    return *value;
  }

  /// All pages of a model side by side: what is drawn on each lies in a layer of its own.
  void read_pages(pugi::xml_node root, pugi::xml_node view) {
    file_.whole = true;
    std::map<std::string, pugi::xml_node, std::less<>> layers;
    for (const pugi::xml_node node : root.children()) {
      if (node.type() != pugi::node_element || is_silent(node)) {
        continue;
      }
      const std::string_view id = node.attribute("id").value();
      if (!is_layer(node) || !id.starts_with(page_prefix) || !layers.emplace(id, node).second) {
        cannot_check("it has <{}{}{}> on no page of its own", node.name(), id.empty() ? "" : " ", id);
      }
      expect_plain(node);
    }
    for (const pugi::xml_node sheet : view.children("inkscape:page")) {
      const std::size_t number = file_.pages.size() + 1;
      const auto found = layers.find(fmt::format("{}{}", page_prefix, number));
      if (found == layers.end()) {
        cannot_check("its page {} has no layer", number);
      }
      PrintedPage page;
      page.name = fmt::format("page {} of {}", number, file_.name);
      page.size = {mm_.x * unit(sheet, "width"), mm_.y * unit(sheet, "height")};
      page.number = number;
      origin_ = {unit(sheet, "x"), unit(sheet, "y")};
      read_layers(found->second, found->first + "-", std::move(page));
      layers.erase(found);
    }
    if (!layers.empty()) {
      cannot_check("its layer {} belongs to no page", layers.begin()->first);
    }
    for (PrintedPage& page : file_.pages) {
      page.count = file_.pages.size();
    }
  }

  /// The page whose layers lie in this node, with this before their ids.
  void read_layers(pugi::xml_node parent, std::string_view prefix, PrintedPage page) {
    page_ = &page;
    for (const pugi::xml_node node : parent.children()) {
      if (node.type() == pugi::node_element && !is_silent(node)) {
        read_layer(node, prefix);
      }
    }
    file_.pages.push_back(std::move(page));
  }

  static bool is_silent(pugi::xml_node node) {
    constexpr std::array<std::string_view, 4> silent = {"title", "metadata", "sodipodi:namedview", "desc"};
    return std::find(silent.begin(), silent.end(), std::string_view(node.name())) != silent.end();
  }

  static bool is_layer(pugi::xml_node node) {
    return std::strcmp(node.name(), "g") == 0 &&
           std::strcmp(node.attribute("inkscape:groupmode").value(), "layer") == 0;
  }

  void read_layer(pugi::xml_node node, std::string_view prefix) {
    const std::string_view id = node.attribute("id").value();
    const auto layer =
        is_layer(node) && id.starts_with(prefix) ? layer_with_id(id.substr(prefix.size())) : std::nullopt;
    if (!layer) {
      cannot_check("it has <{}{}{}> in no layer of ours", node.name(), id.empty() ? "" : " ", id);
    }
    if (is_checked(*layer)) {
      read_group(node, *layer, {}, 0);
    } else if (has_words(*layer)) {
      read_words(node, *layer, 0);
    }
  }

  /// Texts, and straight lines that lead from them.
  void read_words(pugi::xml_node group, PrintedLayer layer, int depth) {
    for (const pugi::xml_node node : group.children()) {
      const std::string_view name = node.name();
      if (name == "g" && depth < max_group_depth) {
        read_words(node, layer, depth + 1);
      } else if (name == "text") {
        read_text(node, layer);
      } else if (name == "path") {
        for (std::vector<Vec2>& points : path_lines(node.attribute("d").value())) {
          for (Vec2& p : points) {
            p = place(p);
          }
          page_->leaders.push_back({layer, Pattern::solid, std::move(points)});
        }
      }
    }
  }

  /// Turned around its own start or not at all, as this program sets texts.
  void read_text(pugi::xml_node node, PrintedLayer layer) {
    const auto value = [&](const char* attribute) {
      return plain_number(node.attribute(attribute).value()).value_or(0.0);
    };
    const Vec2 from{value("x"), value("y")};
    std::string_view turned = node.attribute("transform").value();
    double angle = 0.0;  // clockwise, as y runs down
    if (constexpr std::string_view keyword = "rotate("; turned.starts_with(keyword)) {
      turned.remove_prefix(keyword.size());
      angle = plain_number(turned.substr(0, turned.find(' '))).value_or(0.0) * 3.14159265358979323846 / 180.0;
    }
    const Vec2 to = from + value("textLength") * Vec2{elementary::cos(angle), elementary::sin(angle)};
    page_->texts.push_back({layer, node.child_value(), place(from), place(to)});
  }

  [[nodiscard]] Vec2 place(Vec2 p) const {
    return {mm_.x * (p.x - origin_.x), page_->size.y - mm_.y * (p.y - origin_.y)};
  }

  static Look look_of(pugi::xml_node node, Look look) {
    const auto take = [&](const char* attribute, std::string_view& value) {
      if (const pugi::xml_attribute found = node.attribute(attribute)) {
        value = found.value();
      }
    };
    take("stroke", look.stroke);
    take("stroke-width", look.width);
    take("stroke-dasharray", look.dashes);
    take("fill", look.fill);
    return look;
  }

  void read_group(pugi::xml_node group, PrintedLayer layer, const Look& outer, int depth) {
    if (depth > max_group_depth) {
      cannot_check("its groups are nested deeper than {}", max_group_depth);
    }
    expect_plain(group);
    const Look look = look_of(group, outer);
    for (const pugi::xml_node node : group.children()) {
      if (node.type() != pugi::node_element) {
        continue;
      }
      const std::string_view name = node.name();
      if (name == "g") {
        read_group(node, layer, look, depth + 1);
      } else if (name == "path") {
        expect_plain(node);
        read_path(node, layer, look_of(node, look));
      } else if (name == "text" && layer == PrintedLayer::mark) {
        read_text(node, layer);
      } else if (name != "text" || layer != PrintedLayer::glue) {
        cannot_check("its layer {} has a <{}>", group.attribute("id").value(), name);
      }
    }
  }

  static void expect_plain(pugi::xml_node node) {
    for (const pugi::xml_attribute attribute : node.attributes()) {
      if (!may_have(attribute.name())) {
        cannot_check("a <{}> has the attribute \"{}\", which may change what is printed", node.name(),
                     attribute.name());
      }
    }
  }

  void read_path(pugi::xml_node node, PrintedLayer layer, const Look& look) {
    if (look.fill != "none" && layer != PrintedLayer::mark) {
      cannot_check("a line of its layers is an area");
    }
    const auto width = plain_number(look.width);
    if (!width) {
      cannot_check("a line's width isn't a length: {}", look.width.substr(0, 40));
    }
    if (look.stroke == "none" || is_white(look.stroke) || !(*width > 0.0)) {
      return;
    }
    const Pattern pattern = look.dashes == "none" ? Pattern::solid : pattern_of(numbers(look.dashes));
    for (std::vector<Vec2>& points : path_lines(node.attribute("d").value())) {
      for (Vec2& p : points) {
        p = place(p);
      }
      page_->lines.push_back({layer, pattern, std::move(points)});
    }
  }

  PrintedFile& file_;
  PrintedPage* page_ = nullptr;
  Vec2 origin_;  ///< upper left corner of the page, in the file's unit
  Vec2 mm_;      ///< of the file's unit in x and y
};

}  // namespace

std::vector<std::vector<Vec2>> path_lines(std::string_view data) {
  return PathReader(data).read();
}

bool is_svg(std::string_view bytes) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  bytes.remove_prefix(bytes.starts_with(byte_order_mark) ? byte_order_mark.size() : 0);
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && bytes[first] == '<' &&
         bytes.find("<svg") != std::string_view::npos;
}

PrintedFile read_svg(const std::string& name, std::string_view bytes) {
  PrintedFile file;
  file.name = name;
  try {
    pugi::xml_document document;
    const pugi::xml_parse_result result = document.load_buffer(
        bytes.data(), bytes.size(), pugi::parse_default | pugi::parse_pi | pugi::parse_doctype);
    if (!result) {
      cannot_check("it isn't XML: {} at byte {}", result.description(), result.offset);
    }
    for (const pugi::xml_node node : document.children()) {
      if (node.type() == pugi::node_pi || node.type() == pugi::node_doctype) {
        cannot_check("it has a {} before its root, which may change what is printed",
                     node.type() == pugi::node_pi ? "processing instruction" : "document type");
      }
    }
    const pugi::xml_node root = document.document_element();
    if (std::strcmp(root.name(), "svg") != 0) {
      cannot_check("its root is <{}> and not <svg>", root.name());
    }
    SvgReader(file).read(root);
  } catch (const NotInForm& reason) {
    file.pages.clear();
    file.defect = reason.message;
  }
  return file;
}

}  // namespace ridgecraft::verify
