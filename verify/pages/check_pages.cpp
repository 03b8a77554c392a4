// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/pages/check_pages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "verify/file/tolerance.hpp"

namespace ridgecraft::verify {
namespace {

constexpr double tick_step_mm = 10.0;
/// Half the height of a tick, mm.
constexpr double shortest_tick_mm = 0.5;
constexpr double longest_tick_mm = 2.0;
/// A tick this near to the end of a line belongs to that end, even where it isn't exactly there, mm.
constexpr double at_end_mm = 2.0;
/// Marks that are more than this many are no marks of ours.
constexpr std::size_t most_marks = 10'000;

/// Along x: from `low` to `high`; or a place on x.
struct Bar {
  double low = 0.0, high = 0.0, y = 0.0;
  std::vector<double> ticks;  ///< ascending

  [[nodiscard]] double length() const { return high - low; }
};

struct Marks {
  std::vector<Bar> level;  ///< long enough for a bar, without their ticks
  std::vector<Vec2> tick;  ///< middles
};

Marks marks_of(const PrintedPage& page) {
  Marks marks;
  for (const PrintedLine& line : page.lines) {
    if (line.layer != PrintedLayer::mark || line.pattern != Pattern::solid || line.points.size() != 2) {
      continue;
    }
    const Vec2 a = line.points[0];
    const Vec2 b = line.points[1];
    const Vec2 half = 0.5 * Vec2{std::abs(b.x - a.x), std::abs(b.y - a.y)};
    const Vec2 middle = 0.5 * (a + b);
    if (half.y <= measure_tolerance_mm && 2.0 * half.x > 0.5 * tick_step_mm) {
      marks.level.push_back({middle.x - half.x, middle.x + half.x, middle.y, {}});
    } else if (half.x <= measure_tolerance_mm && half.y >= shortest_tick_mm && half.y <= longest_tick_mm) {
      marks.tick.push_back(middle);
    }
    if (marks.level.size() + marks.tick.size() > most_marks) {
      return {};
    }
  }
  return marks;
}

std::vector<Bar> find_bars(const PrintedPage& page) {
  Marks marks = marks_of(page);
  std::vector<Bar> bars;
  for (Bar& bar : marks.level) {
    for (const Vec2 tick : marks.tick) {
      if (std::abs(tick.y - bar.y) <= shortest_tick_mm && tick.x >= bar.low - at_end_mm &&
          tick.x <= bar.high + at_end_mm) {
        bar.ticks.push_back(tick.x);
      }
    }
    std::sort(bar.ticks.begin(), bar.ticks.end());
    if (bar.ticks.size() >= 2 && bar.ticks.front() <= bar.low + at_end_mm &&
        bar.ticks.back() >= bar.high - at_end_mm) {
      bars.push_back(std::move(bar));
    }
  }
  return bars;
}

/// Whether the length stands in words where the bar ends.
bool says_length_of_bar(const PrintedPage& page) {
  constexpr double gap_mm = 4.0;
  const std::vector<Bar> bars = find_bars(page);
  return bars.size() != 1 || std::any_of(page.texts.begin(), page.texts.end(), [&](const PrintedText& text) {
           return length(text.from - Vec2{bars[0].high, bars[0].y}) <= gap_mm &&
                  text.words == fmt::format("{:.0f} mm", bars[0].length());
         });
}

/// The bars that a page may have, longest first.
std::vector<double> possible_lengths(double room_mm) {
  std::vector<double> lengths;
  for (std::size_t i = 0; i < std::size(bar_lengths_mm); ++i) {
    lengths.push_back(bar_lengths_mm[i]);
    if (i < std::size(bar_room_mm) && room_mm >= bar_room_mm[i]) {
      break;
    }
  }
  return lengths;
}

/// What is wrong with the page's bar, or nothing. A bar is a level line with a tick across each of its ends;
/// it has to be 50 mm long, with ticks at each 10 mm, or 20 or 10 mm where the printable area is too narrow
/// for the longer ones. `room_mm` is that area's width. O(n²) in the few level lines and ticks among the
/// page's marks.
std::optional<std::string> fault_of_bar(const PrintedPage& page, double room_mm) {
  const std::vector<Bar> bars = find_bars(page);
  if (bars.empty()) {
    return "has no scale bar";
  }
  if (bars.size() > 1) {
    return fmt::format("has {} scale bars", bars.size());
  }
  const Bar& bar = bars.front();
  const std::vector<double> lengths = possible_lengths(room_mm);
  const double wanted = *std::min_element(lengths.begin(), lengths.end(), [&](double a, double b) {
    return std::abs(a - bar.length()) < std::abs(b - bar.length());
  });
  if (std::abs(bar.length() - wanted) > measure_tolerance_mm) {
    return fmt::format("has a scale bar of {:.2f} mm instead of {:g} mm", bar.length(), wanted);
  }
  const auto count = static_cast<std::size_t>(std::round(wanted / tick_step_mm)) + 1;
  for (std::size_t i = 0; i < count; ++i) {
    const double place = bar.low + tick_step_mm * static_cast<double>(i);
    if (bar.ticks.size() != count || std::abs(bar.ticks[i] - place) > measure_tolerance_mm) {
      return "has a scale bar whose ticks aren't 10 mm apart";
    }
  }
  return std::nullopt;
}

constexpr std::array<const char*, line_kinds> kind_names = {"cut",
                                                            "mountain fold",
                                                            "valley fold",
                                                            "tab base (mountain fold)",
                                                            "tab base (valley fold)",
                                                            "tab base (not folded)",
                                                            "glue spot"};

/// A page of the nets, ready to be compared with any number of printed ones.
struct NetPage {
  WantedPage lines;
  std::array<LineSet, line_kinds> allowed;

  explicit NetPage(WantedPage page) : lines(std::move(page)) {
    for (std::size_t kind = 0; kind < line_kinds; ++kind) {
      allowed[kind] = LineSet(lines.allowed[kind]);
    }
  }
};

using Kinds = std::array<bool, line_kinds>;

Kinds only(LineKind kind) {
  Kinds kinds{};
  kinds[static_cast<std::size_t>(kind)] = true;
  return kinds;
}

double length_of(const PrintedLine& line) {
  double sum = 0.0;
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    sum += length(line.points[i] - line.points[i - 1]);
  }
  return sum;
}

/// What a line can be, from its layer and its look; nothing where the two contradict each other.
std::optional<Kinds> kinds_of(const PrintedLine& line) {
  const bool short_line =
      line.pattern == Pattern::solid && length_of(line) <= shortest_dashed_mm + rounding_mm;
  switch (line.layer) {
    case PrintedLayer::cut:
      return line.pattern == Pattern::solid ? std::optional(only(LineKind::cut)) : std::nullopt;
    case PrintedLayer::mountain:
      return short_line || line.pattern == Pattern::dash_dot ? std::optional(only(LineKind::mountain))
                                                             : std::nullopt;
    case PrintedLayer::valley:
      return short_line || line.pattern == Pattern::dashed ? std::optional(only(LineKind::valley))
                                                           : std::nullopt;
    case PrintedLayer::tab_fold:
      if (short_line) {
        return Kinds{false, false, false, true, true, true, false};
      }
      switch (line.pattern) {
        case Pattern::dash_dot:
          return only(LineKind::tab_mountain);
        case Pattern::dashed:
          return only(LineKind::tab_valley);
        case Pattern::dotted:
          return only(LineKind::tab_flat);
        case Pattern::solid:
        case Pattern::strange:
          break;
      }
      return std::nullopt;
    case PrintedLayer::glue:
      return line.pattern == Pattern::dashed ? std::optional(only(LineKind::glue)) : std::nullopt;
    case PrintedLayer::mark:
    case PrintedLayer::label:
    case PrintedLayer::name:
    case PrintedLayer::other:
      break;
  }
  return std::nullopt;
}

const char* layer_words(PrintedLayer layer) {
  switch (layer) {
    case PrintedLayer::cut:
      return "cut";
    case PrintedLayer::mountain:
      return "mountain fold";
    case PrintedLayer::valley:
      return "valley fold";
    case PrintedLayer::tab_fold:
      return "tab base";
    case PrintedLayer::glue:
      return "glue spot";
    case PrintedLayer::mark:
    case PrintedLayer::label:
    case PrintedLayer::name:
    case PrintedLayer::other:
      break;
  }
  return "mark";
}

std::string place(Vec2 p) {
  return fmt::format("({:.2f}, {:.2f})", p.x, p.y);
}

/// Stretches of one sort that make one fault.
struct Sum {
  double length = 0.0;
  std::size_t lines = 0;
  Vec2 first;

  void add(const Bare& bare) {
    first = lines == 0 ? bare.middle : first;
    length += bare.length;
    ++lines;
  }
};

/// A page of the nets, and what is printed as that.
using PageOf = std::pair<Index, const PrintedPage*>;

class PageCheck {
 public:
  /// `lists_numbers`: some page has a list of numbers that stand nowhere on their pieces.
  PageCheck(const Case& given, const std::vector<NetPage>& nets, const PageOf& page, bool lists_numbers,
            Findings& findings)
      : given_(given),
        nets_(nets),
        net_(nets[page.first]),
        printed_(*page.second),
        page_(page.first),
        lists_numbers_(lists_numbers),
        findings_(findings) {}

  void run() {
    check_size();
    if (const std::optional<Index> other = page_that_fits()) {
      add(fmt::format("{} shows page {} of the nets instead of page {}", printed_.name, *other + 1,
                      page_ + 1));
      return;
    }
    check_printed();
    check_wanted();
    const Page& sheet = given_.file.pages[page_];
    if (const auto fault = fault_of_bar(printed_, sheet.printable_high.x - sheet.printable_low.x)) {
      add(fmt::format("{} {}", printed_.name, *fault));
    }
    if (given_.file.is_ours()) {
      if (!says_length_of_bar(printed_)) {
        add(fmt::format("{} says another length than its scale bar has", printed_.name));
      }
      for (const std::string& fault : faults_of_words(given_, page_, printed_, lists_numbers_)) {
        add(fmt::format("{} {}", printed_.name, fault));
      }
    }
  }

 private:
  void add(const std::string& message) {
    ++findings_.printed().faulty;
    findings_.add(Promise::printed, {{"page", page_}}, [&] { return message; });
  }

  void check_size() {
    const Page& page = given_.file.pages[page_];
    if (!page.bounded) {
      add(fmt::format("{} is printed, but page {} of the nets has no size", printed_.name, page_ + 1));
      return;
    }
    const Vec2 size = page.high - page.low;
    if (std::max(std::abs(size.x - printed_.size.x), std::abs(size.y - printed_.size.y)) >
        measure_tolerance_mm) {
      add(fmt::format("{} is {:.2f} x {:.2f} mm large instead of {:.2f} x {:.2f} mm", printed_.name,
                      printed_.size.x, printed_.size.y, size.x, size.y));
    }
  }

  /// The share of the printed outlines that lie on no outline of a page of the nets.
  [[nodiscard]] double stray_fraction(const NetPage& net) const {
    double all = 0.0;
    double stray = 0.0;
    const LineSet& outlines = net.allowed[static_cast<std::size_t>(LineKind::cut)];
    for (const PrintedLine& line : printed_.lines) {
      for (std::size_t i = 1; line.layer == PrintedLayer::cut && i < line.points.size(); ++i) {
        const Segment segment{line.points[i - 1], line.points[i]};
        const auto bare = outlines.bare(segment, line_tolerance_mm);
        all += segment.length();
        stray += bare ? bare->length : 0.0;
      }
    }
    return all > 0.0 ? stray / all : 0.0;
  }

  /// Another page of the nets, where the outlines are those of that page and not of this one.
  [[nodiscard]] std::optional<Index> page_that_fits() const {
    if (stray_fraction(net_) < wrong_page_fraction) {
      return std::nullopt;
    }
    for (Index other = 0; other < nets_.size(); ++other) {
      given_.context.check();
      if (other != page_ && stray_fraction(nets_[other]) < right_page_fraction) {
        return other;
      }
    }
    return std::nullopt;
  }

  /// Every printed line is one that the nets have, and looks like it.
  void check_printed() {
    std::map<PrintedLayer, Sum> strange;
    std::map<PrintedLayer, Sum> stray;
    for (const PrintedLine& line : printed_.lines) {
      given_.context.check();
      if (line.layer == PrintedLayer::mark) {
        continue;
      }
      const std::optional<Kinds> kinds = kinds_of(line);
      // The strokes of names within glue spots.
      const bool is_letter = line.layer == PrintedLayer::glue && line.pattern == Pattern::solid;
      if (!kinds && !is_letter) {
        strange[line.layer].add({length_of(line), 0.5 * (line.points[0] + line.points[1])});
      }
      for (std::size_t i = 1; i < line.points.size(); ++i) {
        const Segment segment{line.points[i - 1], line.points[i]};
        drawn_.push_back(segment);
        if (kinds) {
          check_segment(segment, *kinds, stray[line.layer]);
        }
      }
    }
    for (const auto& [layer, sum] : strange) {
      add(fmt::format("{} draws {:.2f} mm of {} lines in another pattern, at {}", printed_.name, sum.length,
                      layer_words(layer), place(sum.first)));
    }
    for (const auto& [layer, sum] : stray) {
      if (sum.lines > 0) {
        add(fmt::format("{} has {:.2f} mm of {} lines where the nets have none, at {}{}", printed_.name,
                        sum.length, layer_words(layer), place(sum.first), what_is_at(sum.first)));
      }
    }
  }

  void check_segment(const Segment& segment, const Kinds& kinds, Sum& stray) {
    if (const auto bare = bare_of_all(segment, kinds)) {
      stray.add(*bare);
    }
    measure(segment.b, kinds);
  }

  /// What of the segment lies on no line of these kinds. Only short lines may be of several kinds, and those
  /// lie on one line as a whole.
  [[nodiscard]] std::optional<Bare> bare_of_all(const Segment& segment, const Kinds& kinds) const {
    std::optional<Bare> least;
    for (std::size_t kind = 0; kind < line_kinds; ++kind) {
      if (!kinds[kind]) {
        continue;
      }
      const std::optional<Bare> bare = net_.allowed[kind].bare(segment, line_tolerance_mm);
      if (!bare) {
        return std::nullopt;
      }
      if (!least || bare->length < least->length) {
        least = bare;
      }
    }
    return least;
  }

  void measure(Vec2 p, const Kinds& kinds) {
    double best = INFINITY;
    for (std::size_t kind = 0; kind < line_kinds; ++kind) {
      if (kinds[kind]) {
        best = std::min(best, net_.allowed[kind].distance_to(p, line_tolerance_mm).value_or(INFINITY));
      }
    }
    if (best <= line_tolerance_mm) {
      double& worst = findings_.printed().max_error_mm;
      worst = std::max(worst, best);
    }
  }

  /// A hint to what went wrong: how far the right line is, or which other line is there.
  [[nodiscard]] std::string what_is_at(Vec2 p) const {
    std::optional<double> nearest;
    std::size_t nearest_kind = 0;
    for (std::size_t kind = 0; kind < line_kinds; ++kind) {
      const auto distance = net_.allowed[kind].distance_to(p, beside_mm);
      if (distance && (!nearest || *distance < *nearest)) {
        nearest = distance;
        nearest_kind = kind;
      }
    }
    if (!nearest) {
      return "";
    }
    if (*nearest <= line_tolerance_mm) {
      return fmt::format(", where a {} belongs", kind_names[nearest_kind]);
    }
    return fmt::format(", {:.3f} mm from a {}", *nearest, kind_names[nearest_kind]);
  }

  /// Every line that the nets want is printed. A fold that lies on another line isn't drawn again, so any
  /// line will do; what is drawn in a wrong way was found before.
  void check_wanted() {
    const LineSet drawn(drawn_);
    std::map<std::pair<Index, LineKind>, Sum> missing;
    for (const WantedLine& wanted : net_.lines.wanted) {
      given_.context.check();
      if (const auto bare = drawn.bare(wanted.line, line_tolerance_mm)) {
        missing[{wanted.piece, wanted.kind}].add(*bare);
      }
    }
    for (const auto& [what, sum] : missing) {
      const auto& [piece, kind] = what;
      ++findings_.printed().faulty;
      findings_.add(Promise::printed, {{"page", page_}, {"piece", piece}},
                    [&, piece = piece, kind = kind, &sum = sum] {
                      return fmt::format("{} lacks {:.2f} mm of the {} lines of {}, at {}", printed_.name,
                                         sum.length, kind_names[static_cast<std::size_t>(kind)],
                                         piece_name(given_.file, piece), place(sum.first));
                    });
    }
  }

  const Case& given_;
  const std::vector<NetPage>& nets_;
  const NetPage& net_;
  const PrintedPage& printed_;
  Index page_;
  bool lists_numbers_;
  Findings& findings_;
  std::vector<Segment> drawn_;
};

/// Pages after those of the nets may have words, such as lists of numbers.
bool shows_pieces(const PrintedPage& page) {
  return std::any_of(page.lines.begin(), page.lines.end(), [](const PrintedLine& line) {
    return line.layer != PrintedLayer::mark && line.layer != PrintedLayer::other;
  });
}

/// The printed pages by the page of the nets that each is.
class PageList {
 public:
  PageList(const Case& given, Findings& findings) : given_(given), findings_(findings) {}

  void add(const PrintedFile& file) {
    const std::size_t pages = given_.file.pages.size();
    if (!file.defect.empty()) {
      fault(fmt::format("{} can't be checked: {}", file.name, file.defect));
    }
    check_digest(file);
    if (file.whole && file.defect.empty() && file.pages.size() < pages) {
      fault(fmt::format("{} has {} page{}, the nets have {}", file.name, file.pages.size(),
                        file.pages.size() == 1 ? "" : "s", pages));
    }
    for (const PrintedPage& page : file.pages) {
      add(file, page);
    }
  }

  /// Files that are sound, but of which nothing could be compared, would pass unseen.
  void require_any(std::span<const PrintedFile> files) {
    if (!pages_.empty() || findings_.printed().faulty > 0) {
      return;
    }
    for (const PrintedFile& file : files) {
      fault(file.name +
            (file.guide ? " is a guide, which shows no page of the nets" : " shows no page of the nets"));
    }
  }

  [[nodiscard]] const std::vector<PageOf>& pages() const { return pages_; }

 private:
  void fault(const std::string& message) {
    ++findings_.printed().faulty;
    findings_.add(Promise::printed, {}, [&] { return message; });
  }

  void check_digest(const PrintedFile& file) {
    const std::string& digest = given_.file.digest;
    if (!file.digest.empty() && !digest.empty() && file.digest != digest) {
      fault(fmt::format("{} was made from another model than the nets", file.name));
    }
  }

  /// There may be more pages than the nets have, but all files must say as many.
  void check_count(const PrintedFile& file, const PrintedPage& page) {
    if (file.whole || !page.count) {
      return;
    }
    const std::size_t pages = given_.file.pages.size();
    count_ = count_.value_or(*page.count);
    if (*page.count < pages || *page.count != *count_) {
      fault(fmt::format("{} says it is one of {} pages, {} {}", page.name, *page.count,
                        *page.count < pages ? "the nets have" : "another file says",
                        *page.count < pages ? pages : *count_));
    }
  }

  void add(const PrintedFile& file, const PrintedPage& page) {
    const std::size_t pages = given_.file.pages.size();
    const std::size_t number = page.number.value_or(++unnumbered_);
    check_count(file, page);
    if (number < 1 || number > pages) {
      if (shows_pieces(page)) {
        fault(fmt::format("{} is page {} and shows pieces, the nets have {} page{}", page.name, number, pages,
                          pages == 1 ? "" : "s"));
      }
      return;
    }
    const auto index = static_cast<Index>(number - 1);
    if (!file.whole && !single_.insert(index).second) {
      fault(fmt::format("{} is page {}, as another file is", page.name, number));
    }
    pages_.emplace_back(index, &page);
  }

  const Case& given_;
  Findings& findings_;
  std::size_t unnumbered_ = 0;
  std::optional<std::size_t> count_;  ///< of pages, as the first file says that tells it
  std::set<Index> single_;            ///< given as a file of their own
  std::vector<PageOf> pages_;
};

}  // namespace

void check_pages(const Case& given, std::span<const PrintedFile> printed, Findings& findings) {
  if (const double mm = given.file.settings.number("thickness_mm").value_or(0.0); mm > 0.0) {
    findings.add(Promise::printed, {}, [&] {
      return fmt::format(
          "pages for board of {:g} mm have other nets than the file, whose are those of the surface: they "
          "can't be held against each other",
          mm);
    });
    return;
  }
  PageList list(given, findings);
  for (const PrintedFile& file : printed) {
    list.add(file);
  }
  list.require_any(printed);
  std::vector<NetPage> nets;
  for (WantedPage& page : wanted_lines(given)) {
    nets.emplace_back(std::move(page));
  }
  std::set<Index> seen;
  const bool lists_numbers = std::any_of(printed.begin(), printed.end(), has_list_of_numbers);
  for (const PageOf& page : list.pages()) {
    seen.insert(page.first);
    PageCheck(given, nets, page, lists_numbers, findings).run();
  }
  findings.printed().pages = list.pages().size();
  findings.printed().pages_not_given = nets.size() - seen.size();
}

}  // namespace ridgecraft::verify
