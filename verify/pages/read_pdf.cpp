// SPDX-License-Identifier: GPL-3.0-or-later
// PDF pages: qpdf finds the objects, content_stream.cpp says what they draw.
#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

#include <pugixml.hpp>
#include <qpdf/Pipeline.hh>
#include <qpdf/QPDF.hh>
#include <qpdf/QPDFPageDocumentHelper.hh>
#include <qpdf/QPDFPageLabelDocumentHelper.hh>
#include <qpdf/QPDFPageObjectHelper.hh>

#include "verify/file/tolerance.hpp"
#include "verify/pages/readers.hpp"

namespace ridgecraft::verify {
namespace {

constexpr double mm_per_point = 25.4 / 72.0;

/// Takes what qpdf unpacks, up to the limit: a small file can unpack to very much.
class LimitedText : public Pipeline {
 public:
  explicit LimitedText(std::size_t& left) : Pipeline("content", nullptr), left_(left) {}

  void write(const unsigned char* data, std::size_t size) override {
    if (size > left_) {
      cannot_check("its content is larger than {} bytes", max_content_bytes);
    }
    left_ -= size;
    text.append(reinterpret_cast<const char*>(data), size);
  }
  void finish() override {}

  std::string text;

 private:
  std::size_t& left_;
};

std::vector<double> numbers_of(QPDFObjectHandle list) {
  std::vector<double> numbers;
  for (int i = 0; list.isArray() && i < list.getArrayNItems(); ++i) {
    QPDFObjectHandle item = list.getArrayItem(i);
    numbers.push_back(item.isNumber() ? item.getNumericValue() : 0.0);
  }
  return numbers;
}

class PageReader {
 public:
  PageReader(QPDFPageObjectHelper& page, const std::vector<std::string>& off, std::size_t& bytes_left,
             PrintedPage& result)
      : page_(page), off_(off), bytes_left_(bytes_left), result_(result) {}

  void read() {
    read_size();
    if (QPDFObjectHandle notes = page_.getObjectHandle().getKey("/Annots");
        notes.isArray() && notes.getArrayNItems() > 0) {
      cannot_check("it has annotations, which may be printed");
    }
    LimitedText content(bytes_left_);
    page_.pipeContents(&content);
    draw(content.text, {}, page_.getAttribute("/Resources", false), std::nullopt, 0);
  }

 private:
  void read_size() {
    const std::vector<double> box = numbers_of(page_.getMediaBox());
    const std::vector<double> cropped = numbers_of(page_.getCropBox());
    if (box.size() != 4 || !(box[2] > box[0] && box[3] > box[1])) {
      cannot_check("its size is missing");
    }
    if (cropped != box) {
      cannot_check("its crop box isn't the whole sheet");
    }
    QPDFObjectHandle rotate = page_.getAttribute("/Rotate", false);
    QPDFObjectHandle unit = page_.getObjectHandle().getKey("/UserUnit");
    if ((rotate.isNumber() && rotate.getNumericValue() != 0.0) ||
        (unit.isNumber() && unit.getNumericValue() != 1.0)) {
      cannot_check("it is turned or has a unit of its own");
    }
    low_ = {box[0], box[1]};
    high_ = {box[2], box[3]};
    result_.size = mm_per_point * Vec2{box[2] - box[0], box[3] - box[1]};
  }

  [[nodiscard]] Vec2 place(Vec2 p) const { return mm_per_point * (p - low_); }

  void draw(const std::string& content, const InkState& state, QPDFObjectHandle resources,
            std::optional<PrintedLayer> layer, int depth) {
    const ContentEvents events{
        .path = [&](const InkPath& path, const InkState& now) { add(path, now, layer); },
        .object = [&](std::string_view name,
                      const InkState& now) { draw_object(name, now, resources, layer, depth); },
        .hides_lines = [&](std::string_view name) -> std::optional<bool> {
          QPDFObjectHandle state_of_it = entry(entry(resources, "/ExtGState"), "/" + std::string(name));
          expect_plain(state_of_it);
          QPDFObjectHandle opacity = entry(state_of_it, "/CA");
          return opacity.isNumber() ? std::optional(opacity.getNumericValue() <= 1.0 - white) : std::nullopt;
        },
        .text = [&](const InkText& text, const InkState& now) { add_text(text, now, resources, layer); },
        .other =
            [&] {
              if (!layer || (is_checked(*layer) && *layer != PrintedLayer::mark)) {
                cannot_check("it has text or colours where only lines may be");
              }
            }};
    read_content(content, state, events);
  }

  /// A graphics state sets opacity and no more: what else it may set changes how lines look.
  static void expect_plain(QPDFObjectHandle state) {
    for (const std::string& key : state.isDictionary() ? state.getKeys() : std::set<std::string>()) {
      QPDFObjectHandle value = state.getKey(key);
      const bool usual = (key == "/BM" && value.isName() && value.getName() == "/Normal") ||
                         (key == "/SMask" && value.isName() && value.getName() == "/None");
      if (key != "/Type" && key != "/CA" && key != "/ca" && !usual) {
        cannot_check("its graphics state has {}, which may change what is printed", key.substr(0, 40));
      }
    }
  }

  /// A form is drawn within its box alone.
  static void narrow(InkState& state, const std::vector<double>& box) {
    if (box.size() != 4) {
      cannot_check("an object of it has no box");
    }
    Box2 window;
    for (const Vec2 corner :
         {Vec2{box[0], box[1]}, Vec2{box[2], box[1]}, Vec2{box[2], box[3]}, Vec2{box[0], box[3]}}) {
      window.add(state.matrix(corner));
    }
    if (state.matrix.b != 0.0 || state.matrix.c != 0.0) {
      cannot_check("an object of it is turned");
    }
    if (state.window) {
      window.low = {std::max(window.low.x, state.window->low.x), std::max(window.low.y, state.window->low.y)};
      window.high = {std::min(window.high.x, state.window->high.x),
                     std::min(window.high.y, state.window->high.y)};
    }
    state.window = window;
  }

  /// The entry of a dictionary, or null.
  static QPDFObjectHandle entry(QPDFObjectHandle dictionary, const std::string& key) {
    return dictionary.isDictionary() ? dictionary.getKey(key) : QPDFObjectHandle::newNull();
  }

  void draw_object(std::string_view name, const InkState& state, const QPDFObjectHandle& resources,
                   std::optional<PrintedLayer> layer, int depth) {
    if (depth == max_form_depth) {
      cannot_check("its objects are nested deeper than {}", max_form_depth);
    }
    QPDFObjectHandle object = entry(entry(resources, "/XObject"), "/" + std::string(name));
    QPDFObjectHandle kind = object.isStream() ? object.getDict().getKey("/Subtype") : object;
    if (!kind.isName() || kind.getName() != "/Form") {
      cannot_check("it has a picture or an object that isn't there: {}", name.substr(0, 40));
    }
    QPDFObjectHandle dictionary = object.getDict();
    const std::optional<PrintedLayer> inner = layer ? layer : layer_of(dictionary, name);
    expect_order(*inner);
    if (*inner == PrintedLayer::other) {
      return;
    }
    InkState now = state;
    if (const std::vector<double> m = numbers_of(dictionary.getKey("/Matrix")); m.size() == 6) {
      now.matrix = product({m[0], m[1], m[2], m[3], m[4], m[5]}, now.matrix);
    }
    narrow(now, numbers_of(dictionary.getKey("/BBox")));
    LimitedText content(bytes_left_);
    object.pipeStreamData(&content, 0, qpdf_dl_generalized);
    draw(content.text, now, dictionary.getKey("/Resources"), inner, depth + 1);
  }

  /// What isn't checked comes before lines that are cut or folded, as it may cover them.
  void expect_order(PrintedLayer layer) {
    const bool is_line = layer == PrintedLayer::cut || layer == PrintedLayer::mountain ||
                         layer == PrintedLayer::valley || layer == PrintedLayer::tab_fold;
    lines_begun_ = lines_begun_ || is_line;
    if (lines_begun_ && !is_checked(layer)) {
      cannot_check("one of its layers may cover lines, as it comes after them");
    }
  }

  [[nodiscard]] PrintedLayer layer_of(QPDFObjectHandle form, std::string_view name) const {
    QPDFObjectHandle title = entry(form.getKey("/OC"), "/Name");
    const std::string words = title.isString() ? title.getUTF8Value() : std::string();
    const auto layer = layer_with_title(words);
    if (!layer) {
      cannot_check("its object {} is in no layer of ours", name.substr(0, 40));
    }
    if (std::find(off_.begin(), off_.end(), words) != off_.end()) {
      cannot_check("its layer \"{}\" is switched off", words);
    }
    return *layer;
  }

  void add(const InkPath& path, const InkState& state, std::optional<PrintedLayer> layer) {
    if (!layer) {
      cannot_check("it has lines in no layer");
    }
    if (has_words(*layer)) {
      for (const std::vector<Vec2>& points : path.lines) {
        PrintedLine& leader = result_.leaders.emplace_back();
        for (const Vec2 p : points) {
          leader.points.push_back(place(p));
        }
      }
      return;
    }
    const bool plain = *layer != PrintedLayer::mark;
    if (path.filled && plain) {
      cannot_check("a line of its layers is an area");
    }
    if (!path.stroked || state.white || state.hidden || (path.curved && !plain)) {
      return;
    }
    if (path.curved) {
      cannot_check("a line isn't straight, and only straight lines can be checked");
    }
    const Pattern pattern = pattern_of(state.dashes);
    for (const std::vector<Vec2>& points : path.lines) {
      PrintedLine line{*layer, pattern, {}};
      for (const Vec2 p : points) {
        if (state.window && !inside(*state.window, p)) {
          cannot_check("a line is cut off");
        }
        line.points.push_back(place(p));
      }
      result_.lines.push_back(std::move(line));
    }
  }

  /// Codes of ASCII are its letters: all that numbers and names of pieces are made of.
  void add_text(const InkText& text, const InkState& state, const QPDFObjectHandle& resources,
                std::optional<PrintedLayer> layer) {
    if (!layer || !(has_words(*layer) || *layer == PrintedLayer::mark)) {
      return;
    }
    QPDFObjectHandle font = entry(entry(resources, "/Font"), "/" + std::string(text.font));
    const std::vector<double> widths = numbers_of(entry(font, "/Widths"));
    const std::vector<double> matrix = numbers_of(entry(font, "/FontMatrix"));
    QPDFObjectHandle first = entry(font, "/FirstChar");
    const auto begin = first.isInteger() ? first.getIntValueAsInt() : 0;
    double width = 0.0;
    for (const char code : text.codes) {
      const int at = static_cast<unsigned char>(code) - begin;
      width += at >= 0 && at < static_cast<int>(widths.size()) ? widths[static_cast<std::size_t>(at)] : 0.0;
    }
    width *= text.size * (matrix.size() == 6 ? matrix[0] : 0.001);
    const Matrix to_page = product(text.place, state.matrix);
    result_.texts.push_back({*layer, text.codes, place(to_page({})), place(to_page({width, 0.0}))});
  }

  /// Whether a point is drawn that a line has. What is cut off at the sheet's border alone is there: Cairo
  /// cuts at whole points, which no printer reaches.
  [[nodiscard]] bool inside(const Box2& window, Vec2 p) const {
    const auto within = [](double low, double x, double high, double sheet_low, double sheet_high) {
      constexpr double whole_point = 1.0;
      return (x >= low || low <= sheet_low + whole_point) && (x <= high || high >= sheet_high - whole_point);
    };
    return within(window.low.x, p.x, window.high.x, low_.x, high_.x) &&
           within(window.low.y, p.y, window.high.y, low_.y, high_.y);
  }

  QPDFPageObjectHelper& page_;
  const std::vector<std::string>& off_;
  std::size_t& bytes_left_;
  PrintedPage& result_;
  Vec2 low_, high_;  ///< corners of the sheet, in points
  bool lines_begun_ = false;
};

/// What guides say that they are about.
constexpr std::string_view guide_subject = "guide";

/// Titles of the layers that aren't printed unless they are switched on.
std::vector<std::string> layers_off(QPDF& pdf) {
  std::vector<std::string> titles;
  QPDFObjectHandle properties = pdf.getRoot().getKey("/OCProperties");
  QPDFObjectHandle defaults = properties.isDictionary() ? properties.getKey("/D") : properties;
  QPDFObjectHandle off = defaults.isDictionary() ? defaults.getKey("/OFF") : defaults;
  QPDFObjectHandle base = defaults.isDictionary() ? defaults.getKey("/BaseState") : defaults;
  QPDFObjectHandle automatic = defaults.isDictionary() ? defaults.getKey("/AS") : defaults;
  if ((base.isName() && base.getName() != "/ON") || (automatic.isArray() && automatic.getArrayNItems() > 0)) {
    cannot_check("its layers may be switched off when it is printed");
  }
  for (int i = 0; off.isArray() && i < off.getArrayNItems(); ++i) {
    QPDFObjectHandle group = off.getArrayItem(i);
    QPDFObjectHandle title = group.isDictionary() ? group.getKey("/Name") : group;
    titles.push_back(title.isString() ? title.getUTF8Value() : std::string());
  }
  return titles;
}

/// The text in which the document's XMP tells its settings; empty where it doesn't.
std::string settings_of(QPDF& pdf, std::size_t& bytes_left) {
  QPDFObjectHandle metadata = pdf.getRoot().getKey("/Metadata");
  if (!metadata.isStream()) {
    return {};
  }
  LimitedText text(bytes_left);
  metadata.pipeStreamData(&text, 0, qpdf_dl_generalized);
  pugi::xml_document document;
  document.load_buffer(text.text.data(), text.text.size());
  const pugi::xml_node settings = document.find_node(
      [](pugi::xml_node node) { return std::string_view(node.name()) == "ridgecraft:settings"; });
  return settings.child_value();
}

/// Whether a page is the back of the one before: what its label begins with says so.
bool is_back(QPDFPageLabelDocumentHelper& labels, std::size_t page) {
  QPDFObjectHandle label = labels.getLabelForPage(static_cast<long long>(page));
  QPDFObjectHandle prefix = label.isDictionary() ? label.getKey("/P") : label;
  return prefix.isString() && prefix.getUTF8Value() == "back of ";
}

void read_document(QPDF& pdf, PrintedFile& file) {
  QPDFObjectHandle info = pdf.getTrailer().getKey("/Info");
  QPDFObjectHandle keywords = info.isDictionary() ? info.getKey("/Keywords") : info;
  file.digest = keywords.isString() ? digest_in(keywords.getUTF8Value()) : std::string();
  QPDFObjectHandle subject = info.isDictionary() ? info.getKey("/Subject") : info;
  const std::string about = subject.isString() ? subject.getUTF8Value() : std::string();
  std::size_t bytes_left = max_content_bytes;
  const std::string settings = settings_of(pdf, bytes_left);
  file.guide = about == guide_subject;
  file.preset = preset_in(about);
  file.thickness_mm = file.guide ? 0.0 : thickness_in(settings);
  if (!file.shows_nets()) {
    return;
  }
  file.whole = true;
  const std::vector<std::string> off = layers_off(pdf);
  std::vector<QPDFPageObjectHelper> pages = QPDFPageDocumentHelper(pdf).getAllPages();
  QPDFPageLabelDocumentHelper labels(pdf);
  for (std::size_t i = 0; i < pages.size(); ++i) {
    if (is_back(labels, i)) {
      continue;
    }
    PrintedPage page;
    page.number = file.pages.size() + 1;
    page.name = fmt::format("page {} of {}", *page.number, file.name);
    PageReader(pages[i], off, bytes_left, page).read();
    file.pages.push_back(std::move(page));
  }
  for (PrintedPage& page : file.pages) {
    page.count = file.pages.size();
  }
  undo_calibration(settings, file);
}

}  // namespace

PrintedFile read_pdf(const std::string& name, std::string_view bytes) {
  PrintedFile file;
  file.name = name;
  try {
    QPDF pdf;
    pdf.setSuppressWarnings(true);
    pdf.processMemoryFile(name.c_str(), bytes.data(), bytes.size());
    read_document(pdf, file);
    if (pdf.anyWarnings()) {
      cannot_check("it is damaged");
    }
  } catch (const NotInForm& reason) {
    file.pages.clear();
    file.defect = reason.message;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {  // qpdf throws several kinds, with words of its own
    file.pages.clear();
    file.defect = "it isn't a PDF file that can be read";
  }
  return file;
}

}  // namespace ridgecraft::verify
