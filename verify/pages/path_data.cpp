// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/pages/path_data.hpp"

#include <charconv>
#include <cmath>

#include "verify/file/tolerance.hpp"
#include "verify/pages/print_form.hpp"

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

}  // namespace

std::vector<std::vector<Vec2>> path_lines(std::string_view data) {
  return PathReader(data).read();
}

}  // namespace ridgecraft::verify
