// SPDX-License-Identifier: GPL-3.0-or-later
// The content of PDF pages as lines (ISO 32000-1, sections 7.2, 7.8 and 8).
#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>
#include <utility>

#include "verify/file/tolerance.hpp"
#include "verify/pages/readers.hpp"

namespace ridgecraft::verify {
namespace {

struct ContentToken {
  enum class Kind { end, number, name, word, open_list, close_list, other };
  Kind kind = Kind::end;
  double number = 0.0;
  std::string_view text;  ///< of a name without its slash, or of a word
  std::string codes;      ///< of a hexadecimal text
};

constexpr std::string_view blanks{"\0\t\n\f\r ", 6};
constexpr std::string_view ends{"\0\t\n\f\r ()<>[]{}/%", 16};

void skip(std::string_view& bytes, std::size_t count) {
  bytes.remove_prefix(std::min(count, bytes.size()));
}

/// Blanks and comments, which go to the end of the line.
void skip_blanks(std::string_view& bytes) {
  while (true) {
    skip(bytes, std::min(bytes.find_first_not_of(blanks), bytes.size()));
    if (!bytes.starts_with('%')) {
      return;
    }
    skip(bytes, std::min(bytes.find_first_of("\r\n"), bytes.size()));
  }
}

/// "(a (b) \) c)": brackets in pairs need no backslash.
void skip_text(std::string_view& bytes) {
  int depth = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (bytes[i] == '\\') {
      ++i;
    } else if (bytes[i] == '(') {
      ++depth;
    } else if (bytes[i] == ')' && --depth == 0) {
      skip(bytes, i + 1);
      return;
    }
  }
  cannot_check("a text in its content has no end");
}

/// "<< /MCID 0 >>", with texts and dictionaries inside.
void skip_dictionary(std::string_view& bytes) {
  int depth = 0;
  do {
    skip_blanks(bytes);
    if (bytes.empty()) {
      cannot_check("a dictionary in its content has no end");
    } else if (bytes.starts_with("<<")) {
      ++depth;
      skip(bytes, 2);
    } else if (bytes.starts_with(">>")) {
      --depth;
      skip(bytes, 2);
    } else if (bytes.starts_with('(')) {
      skip_text(bytes);
    } else {
      skip(bytes, 1);
    }
  } while (depth > 0);
}

/// "<48 69>"; a digit that is missing at the end is 0.
std::string take_hexadecimal(std::string_view& bytes) {
  const std::size_t end = bytes.find('>');
  if (end == std::string_view::npos) {
    cannot_check("a text in its content has no end");
  }
  std::string codes;
  bool second = false;
  for (const char c : bytes.substr(1, end - 1)) {
    const auto digit = std::string_view("0123456789abcdef").find(c >= 'A' && c <= 'F' ? c - 'A' + 'a' : c);
    if (digit == std::string_view::npos) {
      continue;
    }
    if (second) {
      codes.back() = static_cast<char>(static_cast<unsigned char>(codes.back()) | digit);
    } else {
      codes += static_cast<char>(digit << 4U);
    }
    second = !second;
  }
  skip(bytes, end + 1);
  return codes;
}

ContentToken number_or_word(std::string_view text) {
  std::string_view digits = text;
  if (digits.starts_with('+')) {
    digits.remove_prefix(1);
  }
  ContentToken token{ContentToken::Kind::word, 0.0, text, {}};
  const bool like_number =
      !digits.empty() && digits.find_first_not_of("0123456789.-") == std::string_view::npos;
  if (like_number) {
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), token.number, std::chars_format::fixed);
    if (error != std::errc{} || end != digits.data() + digits.size() ||
        !(std::abs(token.number) <= max_coordinate_mm)) {
      cannot_check("its content has a number that is none: {}", text.substr(0, 40));
    }
    token.kind = ContentToken::Kind::number;
  }
  return token;
}

/// Takes the next token off the bytes. Texts and dictionaries are `other`: what is in them draws nothing.
/// Throws NotInForm where one isn't closed. O(size of the token).
ContentToken take_token(std::string_view& bytes) {
  using Kind = ContentToken::Kind;
  skip_blanks(bytes);
  if (bytes.empty()) {
    return {};
  }
  const char first = bytes.front();
  if (first == '(') {
    skip_text(bytes);
    return {Kind::other, 0.0, {}, {}};
  }
  if (bytes.starts_with("<<")) {
    skip_dictionary(bytes);
    return {Kind::other, 0.0, {}, {}};
  }
  if (first == '<') {
    return {Kind::other, 0.0, {}, take_hexadecimal(bytes)};
  }
  if (first == '[' || first == ']') {
    skip(bytes, 1);
    return {first == '[' ? Kind::open_list : Kind::close_list, 0.0, {}, {}};
  }
  const bool is_name = first == '/';
  skip(bytes, is_name ? 1 : 0);
  const std::string_view text = bytes.substr(0, bytes.find_first_of(ends));
  skip(bytes, text.size());
  if (is_name) {
    return {Kind::name, 0.0, text, {}};
  }
  if (text.empty()) {
    cannot_check("its content has a {} where none may be", first);
  }
  return number_or_word(text);
}

/// More numbers in front of an operator than any operator takes.
constexpr std::size_t most_operands = 64;
/// States saved inside each other (Annex C allows 28).
constexpr std::size_t most_saved = 1000;

class ContentReader {
 public:
  ContentReader(const InkState& initial, const ContentEvents& events) : state_(initial), events_(events) {}

  void read(std::string_view bytes) {
    using Kind = ContentToken::Kind;
    for (ContentToken token = take_token(bytes); token.kind != Kind::end; token = take_token(bytes)) {
      switch (token.kind) {
        case Kind::number:
          add_number(token.number);
          break;
        case Kind::name:
          tag_ = tag_.empty() ? token.text : tag_;
          name_ = token.text;
          break;
        case Kind::open_list:
          list_.clear();
          in_list_ = true;
          break;
        case Kind::close_list:
          in_list_ = false;
          break;
        case Kind::word:
          perform(token.text);
          numbers_.clear();
          list_.clear();
          tag_ = {};
          name_ = {};
          text_.codes.clear();
          break;
        case Kind::other:
          text_.codes = std::move(token.codes);
          break;
        case Kind::end:
          break;
      }
    }
  }

 private:
  using Action = void (ContentReader::*)();
  struct Operator {
    std::string_view word;
    std::size_t numbers;  ///< that it takes, those last given
    Action action;
  };

  void add_number(double number) {
    std::vector<double>& target = in_list_ ? list_ : numbers_;
    if (target.size() == most_operands) {
      cannot_check("its content has more numbers than any operator takes");
    }
    target.push_back(number);
  }

  void perform(std::string_view word) {
    static const std::vector<Operator> operators = known_operators();
    const auto found =
        std::find_if(operators.begin(), operators.end(), [&](const Operator& o) { return o.word == word; });
    if (found == operators.end()) {
      cannot_check("its content has the operator {}, which can't be checked", word.substr(0, 20));
    }
    if (numbers_.size() < found->numbers) {
      cannot_check("its content has the operator {} without its numbers", word);
    }
    operands_ = std::span(numbers_).last(found->numbers);
    (this->*found->action)();
  }

  static std::vector<Operator> known_operators() {
    using R = ContentReader;
    std::vector<Operator> all = {{"q", 0, &R::save},
                                 {"Q", 0, &R::restore},
                                 {"cm", 6, &R::transform},
                                 {"w", 1, &R::set_width},
                                 {"d", 1, &R::set_dashes},
                                 {"gs", 0, &R::set_state},
                                 {"m", 2, &R::move},
                                 {"l", 2, &R::line},
                                 {"c", 6, &R::curve},
                                 {"v", 4, &R::curve},
                                 {"y", 4, &R::curve},
                                 {"h", 0, &R::close},
                                 {"re", 4, &R::rectangle},
                                 {"S", 0, &R::stroke},
                                 {"s", 0, &R::close_stroke},
                                 {"f", 0, &R::fill},
                                 {"F", 0, &R::fill},
                                 {"f*", 0, &R::fill},
                                 {"B", 0, &R::fill_stroke},
                                 {"B*", 0, &R::fill_stroke},
                                 {"b", 0, &R::close_fill},
                                 {"b*", 0, &R::close_fill},
                                 {"n", 0, &R::end_path},
                                 {"W", 0, &R::clip},
                                 {"W*", 0, &R::clip},
                                 {"G", 1, &R::set_gray},
                                 {"RG", 3, &R::set_rgb},
                                 {"K", 4, &R::set_cmyk},
                                 {"CS", 0, &R::unknown_color},
                                 {"SC", 0, &R::unknown_color},
                                 {"SCN", 0, &R::unknown_color},
                                 {"Do", 0, &R::draw_object},
                                 {"BT", 0, &R::begin_text},
                                 {"Tr", 1, &R::set_rendering},
                                 {"Tf", 1, &R::set_font},
                                 {"Tm", 6, &R::place_text},
                                 {"Tj", 0, &R::show_text},
                                 {"TJ", 0, &R::show_text},
                                 {"'", 0, &R::show_text},
                                 {"\"", 0, &R::show_text},
                                 {"sh", 0, &R::draw_other}};
    // What changes areas, texts and the shape of lines' ends, but not where lines are.
    for (const std::string_view word :
         {"J",  "j",  "M",  "i",  "ri", "g",  "rg", "k",   "cs",  "sc", "scn", "ET", "Tc",
          "Tw", "Tz", "TL", "Ts", "Td", "TD", "T*", "BMC", "EMC", "MP", "DP",  "BX", "EX"}) {
      all.push_back({word, 0, &R::ignore});
    }
    // Content that a viewer may switch off has to be a layer of the file, which is an object here.
    all.push_back({"BDC", 0, &R::begin_marked});
    return all;
  }

  void ignore() {}

  void begin_marked() {
    if (tag_ == "OC") {
      cannot_check("its content has a layer that is no object");
    }
  }

  void save() {
    if (saved_.size() == most_saved) {
      cannot_check("its content saves its state too often");
    }
    saved_.push_back(state_);
  }
  void restore() {
    if (saved_.empty()) {
      cannot_check("its content restores a state that it hasn't saved");
    }
    state_ = std::move(saved_.back());
    saved_.pop_back();
  }
  void transform() {
    const auto& n = operands_;
    state_.matrix = product({n[0], n[1], n[2], n[3], n[4], n[5]}, state_.matrix);
  }
  void set_width() { state_.width = operands_[0]; }
  void set_dashes() {
    state_.dashes = list_;
    // Twice in a row gives the same pattern with an even number of lengths.
    if (list_.size() % 2 != 0) {
      state_.dashes.insert(state_.dashes.end(), list_.begin(), list_.end());
    }
  }
  void set_state() {
    if (events_.hides_lines) {
      state_.hidden = events_.hides_lines(name_).value_or(state_.hidden);
    }
  }

  void set_gray() { state_.white = operands_[0] >= white; }
  void set_rgb() { state_.white = *std::min_element(operands_.begin(), operands_.end()) >= white; }
  void set_cmyk() { state_.white = *std::max_element(operands_.begin(), operands_.end()) <= 1.0 - white; }
  void unknown_color() { state_.white = false; }

  [[nodiscard]] Vec2 point(std::size_t at) const { return state_.matrix({operands_[at], operands_[at + 1]}); }
  void move() {
    end_line();
    line_ = {point(0)};
  }
  void line() { line_to(point(0)); }
  void curve() {
    path_.curved = true;
    line_to(point(operands_.size() - 2));
  }
  void line_to(Vec2 p) {
    if (line_.empty()) {
      cannot_check("its content draws a line before it has a place");
    }
    line_.push_back(p);
  }
  void close() {
    if (!line_.empty()) {
      const Vec2 first = line_.front();
      line_.push_back(first);
      end_line();
      line_ = {first};
    }
  }
  void rectangle() {
    end_line();
    const double x = operands_[0], y = operands_[1], width = operands_[2], height = operands_[3];
    line_ = {state_.matrix({x, y}), state_.matrix({x + width, y}), state_.matrix({x + width, y + height}),
             state_.matrix({x, y + height})};
    close();
  }
  void end_line() {
    if (line_.size() > 1) {
      path_.lines.push_back(std::move(line_));
    }
    line_.clear();
  }

  void stroke() { paint(true, false); }
  void close_stroke() {
    close();
    paint(true, false);
  }
  void fill() { paint(false, true); }
  void fill_stroke() { paint(true, true); }
  void close_fill() {
    close();
    paint(true, true);
  }
  void paint(bool stroked, bool filled) {
    end_line();
    path_.stroked = stroked;
    path_.filled = filled;
    events_.path(path_, state_);
    end_path();
  }
  void end_path() {
    end_line();
    if (clips_) {
      narrow_window();
    }
    clips_ = false;
    path_ = {};
  }

  void clip() { clips_ = true; }
  /// To what the path encloses; that has to be a rectangle parallel to the axes.
  void narrow_window() {
    Box2 box;
    bool along_axes = path_.lines.size() == 1 && !path_.curved && path_.lines[0].size() == 5;
    for (const std::vector<Vec2>& line : path_.lines) {
      for (std::size_t i = 0; i < line.size(); ++i) {
        box.add(line[i]);
        const Vec2 step = i > 0 ? line[i] - line[i - 1] : Vec2{};
        along_axes = along_axes && (step.x == 0.0 || step.y == 0.0);
      }
    }
    if (!along_axes) {
      cannot_check("its content is cut off by something that is no rectangle");
    }
    if (state_.window) {
      box.low = {std::max(box.low.x, state_.window->low.x), std::max(box.low.y, state_.window->low.y)};
      box.high = {std::min(box.high.x, state_.window->high.x), std::min(box.high.y, state_.window->high.y)};
    }
    state_.window = box;
  }

  void begin_text() {
    text_ = {};
    text_is_seen_ = true;
  }
  void set_rendering() { text_is_seen_ = operands_[0] != 3.0; }
  void set_font() {
    text_.font = tag_;
    text_.size = operands_[0];
  }
  void place_text() {
    const auto& n = operands_;
    text_.place = {n[0], n[1], n[2], n[3], n[4], n[5]};
  }
  void show_text() {
    if (text_is_seen_) {
      events_.other();
    }
    if (events_.text) {
      events_.text(text_, state_);
    }
  }

  void draw_object() { events_.object(name_, state_); }
  void draw_other() { events_.other(); }

  InkState state_;
  std::vector<InkState> saved_;
  const ContentEvents& events_;
  std::vector<double> numbers_;  ///< before the next operator
  std::vector<double> list_;     ///< the numbers in square brackets among them
  bool in_list_ = false;
  std::string_view tag_;              ///< the first name before the next operator
  std::string_view name_;             ///< the last one
  std::span<const double> operands_;  ///< those that the operator takes
  InkPath path_;
  std::vector<Vec2> line_;  ///< the subpath that is being drawn
  bool clips_ = false;
  InkText text_;
  bool text_is_seen_ = true;
};

}  // namespace

double Matrix::scale() const {
  return std::sqrt(std::abs(a * d - b * c));
}

Matrix product(const Matrix& inner, const Matrix& outer) {
  const auto turned = [&](double x, double y) {
    return Vec2{outer.a * x + outer.c * y, outer.b * x + outer.d * y};
  };
  const Vec2 x = turned(inner.a, inner.b);
  const Vec2 y = turned(inner.c, inner.d);
  const Vec2 shift = outer({inner.e, inner.f});
  return {x.x, x.y, y.x, y.y, shift.x, shift.y};
}

void read_content(std::string_view bytes, const InkState& initial, const ContentEvents& events) {
  ContentReader(initial, events).read(bytes);
}

}  // namespace ridgecraft::verify
