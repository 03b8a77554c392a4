// SPDX-License-Identifier: GPL-3.0-or-later
// What ridgecraft verify tells; the keys are those of docs/reference/json.md, in its order.
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "cli/report/figures.hpp"
#include "cli/report/summary.hpp"

namespace ridgecraft::cli {
namespace {

std::string plural(const std::string& name) {
  return name == "vertex" ? "vertices" : name + "s";
}

/// An index stands under its name; several of one kind are a list under the plural.
Value value_of(const verify::Fault& fault) {
  Value value(Value::Object{{"promise", static_cast<int>(fault.promise)}, {"message", fault.message}});
  std::map<std::string, Value::List> by_name;
  for (const auto& [name, index] : fault.indices) {
    by_name[name].emplace_back(index);
  }
  for (auto& [name, list] : by_name) {
    if (list.size() == 1) {
      value.set(name, std::move(list.front()));
    } else {
      value.set(plural(name), std::move(list));
    }
  }
  return value;
}

/// Figures of the nets: for a file that isn't in their form, the keys alone.
class NetsTold {
 public:
  NetsTold(const std::optional<verify::Figures>& figures, Summary& summary)
      : figures_(figures), summary_(summary) {}

  void operator()(std::string_view key, auto verify::Figures::*figure, std::string_view unit = {}) {
    summary_.add(key, value(figure), unit);
  }
  /// `sentence` is asked for where there are figures.
  template <class Sentence>
  void operator()(std::string_view key, auto verify::Figures::*figure, Line line, std::string_view label,
                  const Sentence& sentence, std::string_view unit = {}) {
    summary_.add(key, value(figure), line, label, figures_ ? sentence(*figures_) : std::string(), unit);
  }

 private:
  [[nodiscard]] Value value(auto verify::Figures::*figure) const {
    return figures_ ? Value((*figures_).*figure) : Value();
  }

  const std::optional<verify::Figures>& figures_;
  Summary& summary_;
};

void add_figures(const std::optional<verify::Figures>& figures, Summary& summary) {
  using F = verify::Figures;
  NetsTold add(figures, summary);
  add("faces", &F::faces);
  add("pieces", &F::pieces);
  add("pages", &F::pages);
  add("overlaps", &F::overlaps, Line::nets, "overlaps", [](const F& f) {
    return fmt::format("{} of faces, {} of tabs, deepest {:.3g} mm", f.overlaps, f.tab_overlaps,
                       f.max_penetration_mm);
  });
  add("tab_overlaps", &F::tab_overlaps);
  add(
      "max_length_error_mm", &F::max_length_error_mm, Line::lengths, "lengths",
      [](const F& f) { return fmt::format("largest error {:.3g} mm", f.max_length_error_mm); }, "mm");
  add("max_penetration_mm", &F::max_penetration_mm, "mm");
  add("missing_faces", &F::missing_faces, Line::nets, "coverage",
      [](const F& f) { return fmt::format("{} missing, {} double", f.missing_faces, f.double_faces); });
  add("double_faces", &F::double_faces);
  add("outside_page", &F::outside_page, Line::nets, "pages",
      [](const F& f) { return fmt::format("{} outside", f.outside_page); });
  add("bad_joins", &F::bad_joins, Line::nets, "joins", [](const F& f) {
    return fmt::format("{}, {} bad, {} without tab, {}", f.joins, f.bad_joins, f.joins_without_tab,
                       counted(f.tabs, "tab"));
  });
  add("joins", &F::joins);
  add("joins_without_tab", &F::joins_without_tab);
  add(
      "max_fold_error_deg", &F::max_fold_error_deg, Line::nets, "refolding",
      [](const F& f) {
        return fmt::format("largest error {:.3g} mm, folds {:.3g} degrees", f.max_refold_error_mm,
                           f.max_fold_error_deg);
      },
      "deg");
  add("max_refold_error_mm", &F::max_refold_error_mm, "mm");
  add(
      "cut_mm", &F::cut_mm, Line::nets, "lines",
      [](const F& f) {
        // As the summary of the job counts; JSON has the sum that other checkers have.
        return fmt::format("{} to cut, {} to fold", metres(f.cut_mm), metres(f.fold_mm - f.unlined_fold_mm)) +
               (f.unlined_fold_mm < 0.5
                    ? ""
                    : fmt::format(" (and {} too flat for a line)", metres(f.unlined_fold_mm)));
      },
      "mm");
  add("fold_mm", &F::fold_mm, "mm");
  add("unlined_fold_mm", &F::unlined_fold_mm, "mm");
  add("tabs", &F::tabs);
  add("narrow_pieces", &F::narrow_pieces, Line::nets, "narrow", [](const F& f) {
    return f.narrow_pieces == 0 ? std::string()
                                : fmt::format("{} narrower than 1 mm, which no knife cuts out",
                                              counted(f.narrow_pieces, "piece"));
  });
  add("thin_necks", &F::thin_necks, Line::nets, "necks", [](const F& f) {
    return f.thin_necks == 0
               ? std::string()
               : fmt::format("{} held together by less than 1 mm of paper", counted(f.thin_necks, "piece"));
  });
}

void add_folding_figures(const verify::FoldingFigures& folding, Summary& summary) {
  summary.add("pieces_to_fold_with_care", list_of(folding.with_care), Line::nets, "with care",
              folding.with_care.empty()
                  ? ""
                  : fmt::format("{} to be folded with care: {}", counted(folding.with_care.size(), "piece"),
                                listed(folding.with_care, "and")));
  summary.add("pieces_not_folded", folding.not_tried);
}

void add_model(const verify::ModelFigures& m, Summary& summary) {
  Value value(Value::Object{{"deviation_mm", m.deviation_mm},
                            {"allowed_mm", m.allowed_mm},
                            {"mm_per_unit", m.mm_per_unit},
                            {"same_file", m.same_file}});
  summary.add(
      "against_model", std::move(value), Line::nets, "model",
      fmt::format("at most {:.3g} mm apart{}, at {:.6g} mm per unit{}", m.deviation_mm,
                  m.allowed_mm ? fmt::format(" ({:.3g} mm allowed)", *m.allowed_mm) : "", m.mm_per_unit,
                  m.same_file.value_or(true) ? "" : "; the file isn't the one that the nets name"));
}

void add_printed(const verify::PrintedFigures& p, Summary& summary) {
  Value value(Value::Object{{"pages", p.pages},
                            {"pages_not_given", p.pages_not_given},
                            {"faulty", p.faulty},
                            {"max_error_mm", p.max_error_mm}});
  summary.add(
      "printed", std::move(value), Line::nets, "printed",
      // The distance is of lines that were found at their places: beside faults it would tell the contrary.
      fmt::format(
          "{}, {}{}", counted(p.pages, "page"),
          p.faulty == 0 ? fmt::format("lines at most {:.3g} mm beside their places", p.max_error_mm)
                        : counted(p.faulty, "fault"),
          p.pages_not_given == 0 ? "" : fmt::format("; {} not given", counted(p.pages_not_given, "page"))));
}

/// The first faults of each promise, and how many more there are: one cause often has hundreds.
void tell_faults(const verify::Report& report, Summary& summary) {
  constexpr std::size_t most_of_promise = 5;
  if (!report.faults.empty()) {
    summary.end_with("docs/reference/formats.md describes the promises");
  }
  for (std::size_t promise = 0; promise < verify::promise_count; ++promise) {
    std::size_t found = report.faults_not_listed[promise];
    std::size_t told = 0;
    for (const verify::Fault& fault : report.faults) {
      if (static_cast<std::size_t>(fault.promise) != promise) {
        continue;
      }
      ++found;
      if (told < most_of_promise) {
        ++told;
        summary.end_with(fmt::format("fault of promise {}: {}", promise, fault.message));
      }
    }
    if (found > told) {
      summary.end_with(fmt::format("and {} of promise {}; --json lists them",
                                   counted(found - told, "more fault"), promise));
    }
  }
}

void add_faults(const verify::Report& report, Summary& summary) {
  Value faults(Value::List{});
  for (const verify::Fault& fault : report.faults) {
    faults.add(value_of(fault));
  }
  summary.add("faults", std::move(faults));
  tell_faults(report, summary);
  Value not_listed;
  for (std::size_t promise = 0; promise < verify::promise_count; ++promise) {
    if (report.faults_not_listed[promise] > 0) {
      not_listed.set(std::to_string(promise), report.faults_not_listed[promise]);
    }
  }
  if (!std::holds_alternative<std::monostate>(not_listed.held())) {
    summary.add("faults_not_listed", std::move(not_listed));
  }
  if (report.sound()) {
    summary.end_with("no faults");
  }
}

std::string title_of(const std::string& file, const std::optional<verify::Figures>& figures) {
  if (!figures) {
    return fmt::format("{}: not in the form of nets, so nothing else was checked", file);
  }
  return fmt::format("{}: {}, {}, {}", file, counted(figures->faces, "face"),
                     counted(figures->pieces, "piece"), counted(figures->pages, "page"));
}

}  // namespace

Summary summary(const std::string& file, const verify::Report& report) {
  Summary summary(title_of(file, report.figures));
  add_figures(report.figures, summary);
  if (report.folding) {
    add_folding_figures(*report.folding, summary);
  }
  if (report.model) {
    add_model(*report.model, summary);
  }
  if (report.printed) {
    add_printed(*report.printed, summary);
  }
  add_faults(report, summary);
  return summary;
}

}  // namespace ridgecraft::cli
