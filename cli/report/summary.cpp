// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/report/summary.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text.hpp"
#include "cli/files/formats.hpp"
#include "cli/files/input_files.hpp"
#include "prepare/selection/selection.hpp"

namespace ridgecraft::cli {
namespace {

std::string lines_of(const std::vector<FormatRow>& rows) {
  std::string text;
  for (const FormatRow& row : rows) {
    text += fmt::format("  {:<6} {}\n", row.suffix, row.what);
  }
  return text;
}

Value rows_of(const std::vector<FormatRow>& rows) {
  Value list(Value::List{});
  for (const FormatRow& row : rows) {
    list.add(Value::Object{{"suffix", row.suffix}, {"what", row.what}});
  }
  return list;
}

/// ".svg, .dxf", what --preset writes where no file is named.
std::string suffixes_of(const export_::Preset& preset) {
  std::vector<std::string> suffixes;
  for (const Format format : default_formats(preset)) {
    suffixes.emplace_back(suffix(format));
  }
  return fmt::format("{}", fmt::join(suffixes, ", "));
}

std::string preset_lines() {
  std::string text;
  for (const export_::Preset& preset : export_::presets()) {
    text += fmt::format("  {:<11} {} ({})\n", preset.name, preset.what, suffixes_of(preset));
  }
  return text;
}

std::string hex(export_::Color c) {
  return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue);
}

/// What a preset's files are like, a word for each column.
std::vector<std::string> columns_of(const export_::Preset& preset) {
  const auto colour = [&](export_::Operation operation) {
    return preset.svg && !preset.simulates ? hex(preset.colors[static_cast<std::size_t>(operation)]) : "-";
  };
  const export_::PathRules& paths = preset.paths;
  const bool cuts = !preset.simulates;
  return {std::string(preset.name),
          suffixes_of(preset),
          preset.sheet.x > 0.0 ? fmt::format("{:g}x{:g}", preset.sheet.x, preset.sheet.y) : "--paper",
          colour(export_::Operation::cut_outer),
          colour(export_::Operation::cut_inner),
          colour(export_::Operation::mountain),
          colour(export_::Operation::valley),
          cuts && paths.engraves ? colour(export_::Operation::engrave) : "none",
          cuts ? std::string(word(paths.scores)) : "-",
          preset.svg || preset.pdf ? fmt::format("{:g}", preset.width) : "-",
          cuts ? fmt::format("{:g}", paths.kerf_mm) : "-"};
}

std::string preset_table() {
  std::vector<std::vector<std::string>> rows{
      {"preset", "files", "sheet", "cut", "inner", "mountain", "valley", "numbers", "folds", "line", "kerf"}};
  for (const export_::Preset& preset : export_::presets()) {
    rows.push_back(columns_of(preset));
  }
  std::vector<std::size_t> widths(rows[0].size());
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], row[i].size());
    }
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      line += fmt::format("{:<{}}  ", row[i], widths[i]);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text + "Lengths in mm. Colours are those of SVG and EPS; DXF has a layer for each operation.\n";
}

Value presets_value() {
  Value list(Value::List{});
  for (const export_::Preset& preset : export_::presets()) {
    list.add(Value::Object{{"name", std::string(preset.name)},
                           {"what", std::string(preset.what)},
                           {"files", suffixes_of(preset)}});
  }
  return list;
}

/// "metres, y points up: 1000 x 500 x 300 mm"
std::string told_frame(const mesh::FileFrame& frame, Vec3 size) {
  if (!frame.mm_per_unit) {
    return {};
  }
  const Vec3 mm = *frame.mm_per_unit * size;
  return fmt::format("{}{}: {:g} x {:g} x {:g} mm", mesh::unit_names(*frame.mm_per_unit),
                     frame.up ? fmt::format(", {} points up", mesh::axis_name(*frame.up)) : "", mm.x, mm.y,
                     mm.z);
}

/// "body, wheel.L and 12 more: --only and --without take them"
std::string names_text(const std::vector<std::string>& names) {
  constexpr std::size_t most = 12;
  if (names.empty()) {
    return {};
  }
  std::vector<std::string> told(names.begin(),
                                names.begin() + static_cast<std::ptrdiff_t>(std::min(most, names.size())));
  if (names.size() > most) {
    told.push_back(std::to_string(names.size() - most) + " more");
  }
  return listed(told, "and") + ": --only and --without take them";
}

Value value_of(const segment::Disagreement& d) {
  return Value::Object{{"rand_error", d.rand_error},
                       {"hamming", d.hamming},
                       {"gce", d.global_consistency},
                       {"lce", d.local_consistency},
                       {"cut_discrepancy", d.cut_discrepancy}};
}

segment::Disagreement mean_disagreement(const Comparison& comparison) {
  segment::Disagreement mean{.cut_discrepancy = 0.0};
  const auto n = static_cast<double>(comparison.with.size());
  for (const Comparison::With& with : comparison.with) {
    const segment::Disagreement& d = with.disagreement;
    mean.rand_error += d.rand_error / n;
    mean.hamming += d.hamming / n;
    mean.global_consistency += d.global_consistency / n;
    mean.local_consistency += d.local_consistency / n;
    if (mean.cut_discrepancy) {
      mean.cut_discrepancy =
          d.cut_discrepancy ? std::optional(*mean.cut_discrepancy + *d.cut_discrepancy / n) : std::nullopt;
    }
  }
  return mean;
}

std::string sentence_of(const segment::Disagreement& d) {
  return fmt::format("1-Rand {:.4f}, Hamming {:.4f}, GCE {:.4f}, LCE {:.4f}, cuts {}", d.rand_error,
                     d.hamming, d.global_consistency, d.local_consistency,
                     d.cut_discrepancy ? fmt::format("{:.4f}", *d.cut_discrepancy) : "-");
}

void add_comparison(Summary& summary, const Comparison& comparison) {
  summary.add("volume_ratio", comparison.volume_ratio, Line::nets, "hulls",
              fmt::format("{:.3f} times the model's volume, together", comparison.volume_ratio));
  Value list(Value::List{});
  for (const Comparison::With& with : comparison.with) {
    Value entry = value_of(with.disagreement);
    entry.set("file", with.file);
    list.add(std::move(entry));
    summary.say(Line::nets, "against", sentence_of(with.disagreement));
    summary.say(Line::nets, "", with.file);
  }
  summary.add("compare", std::move(list));
  const segment::Disagreement mean = mean_disagreement(comparison);
  summary.add("compare_mean", value_of(mean), Line::nets, "mean",
              comparison.with.size() > 1 ? sentence_of(mean) : "");
}

}  // namespace

std::vector<Message> repair_lines(const mesh::RepairReport& report, bool united) {
  std::vector<Message> lines;
  for (const mesh::Repair& repair : report.entries()) {
    const bool mended = united && repair.kind == mesh::RepairKind::self_intersections;
    lines.push_back(mended ? Message("repair_mended_intersections", {{"n", repair.count}})
                           : mesh::message(repair));
  }
  return lines;
}

std::string error_json(ExitCode code, const Message& message) {
  return json_text(Value::Object{{"error", Value::Object{{"code", static_cast<int>(code)},
                                                         {"message", english(message)},
                                                         {"reason", value_of(message)}}}}) +
         "\n";
}

std::string formats_text(bool presets) {
  if (presets) {
    return preset_table();
  }
  return "read:\n" + lines_of(read_formats()) + "written:\n" + lines_of(written_formats()) +
         "written for machines, with --preset:\n" + preset_lines();
}

std::string formats_json() {
  return json_text(Value::Object{{"read", rows_of(read_formats())},
                                 {"written", rows_of(written_formats())},
                                 {"presets", presets_value()}}) +
         "\n";
}

Summary summary(const InfoJob& job, const mesh::Model& model, const prepare::Panels& panels) {
  const mesh::Surface& surface = model.surface;
  std::size_t border = 0;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    border += surface.is_border(e) ? 1U : 0U;
  }
  const Vec3 size = model.file_scale * surface.bounds().size();
  Summary summary(shown_name(job.model) + ": " + counted(model.polygon_count, "polygon"));
  summary.add("model", model.name);
  summary.add("polygons", model.polygon_count);
  summary.add("faces", surface.face_count(), Line::nets, "surface",
              fmt::format("{}, {} vertices, {}, {}", counted(surface.face_count(), "triangle"),
                          surface.vertex_count(), counted(panels.count(), "panel"),
                          counted(surface.component_count(), "component")));
  summary.add("vertices", surface.vertex_count());
  summary.add("panels", panels.count());
  summary.add("components", surface.component_count());
  summary.add("border_edges", border, Line::nets, "border",
              border == 0 ? "none: the surface is closed" : counted(border, "edge"));
  summary.add("size", Value::List{size.x, size.y, size.z}, Line::nets, "size",
              fmt::format("{:g} x {:g} x {:g} in the file's unit", size.x, size.y, size.z));
  const mesh::FileFrame& frame = model.frame;
  summary.add("file_unit_mm", Value(frame.mm_per_unit), Line::nets, "unit", told_frame(frame, size), "mm");
  summary.add("file_up", frame.up ? Value(mesh::axis_name(*frame.up)) : Value());
  const std::vector<std::string> names = prepare::names_of(model);
  summary.add("names", list_of(names), Line::nets, "names", names_text(names));
  summary.add("materials", model.materials.size());
  summary.add("textured", !model.texture.empty());
  summary.add_repairs(model.repairs);
  for (const Message& line : repair_lines(model.repairs)) {
    summary.say(Line::notes, "repair", english(line));
  }
  return summary;
}

Summary summary(const SegmentJob& job, const SegmentResult& result) {
  const segment::Options& options = job.parts.options;
  const double concavity = result.segmentation.max_concavity();
  Summary summary(shown_name(job.model) + ": " + counted(result.model.polygon_count, "polygon") + ", " +
                  counted(result.model.surface.component_count(), "component"));
  summary.add("model", result.model.name);
  summary.add("faces", result.model.polygon_count);
  summary.add("parts", result.segmentation.parts.size(), Line::nets, "parts",
              fmt::format("{}, concavity at most {:.4f}{}", result.segmentation.parts.size(), concavity,
                          job.parts.count > 0 ? "" : fmt::format(" (asked: {:g})", options.concavity)));
  summary.add("max_concavity", concavity);
  if (job.parts.count > 0) {
    summary.add("parts_asked", job.parts.count);
  } else {
    summary.add("concavity", options.concavity);
    summary.add("effort", options.effort);
    summary.add("volume_weight", segment::volume_weight(options));
    summary.add("planes", options.planes);
    summary.add("pockets", options.pockets);
  }
  Value parts(Value::List{});
  for (const segment::Part& part : result.segmentation.parts) {
    parts.add(Value::Object{{"faces", part.faces.size()},
                            {"concavity", part.concavity},
                            {"hull_volume", part.hull_volume},
                            {"reason", segment::name(part.reason)}});
  }
  summary.add("part", std::move(parts));
  if (result.comparison) {
    add_comparison(summary, *result.comparison);
  }
  summary.add_seconds(result.seconds);
  summary.add_repairs(result.model.repairs);
  summary.add_files(result.files, result.comparison.has_value());
  return summary;
}

namespace {

void add_fit(Summary& summary, const solid::Fit& fit) {
  const bool known = fit.solid_volume > 0.0;
  summary.add("volume_ratio", known ? Value(fit.union_volume / fit.solid_volume) : Value(), Line::nets,
              "volume",
              known ? fmt::format("{:.3f} times the model's; {:.2f} % of the model is in no hull",
                                  fit.union_volume / fit.solid_volume, 100.0 * fit.uncovered)
                    : "unknown: no component of the model is closed");
  summary.add("uncovered", known ? Value(fit.uncovered) : Value());
}

}  // namespace

Summary summary(const BatchJob& job, const BatchResult& result) {
  Summary summary(job.input + ": " + counted(result.models, "model"));
  summary.add("models", result.models);
  summary.add("done_before", result.done_before, Line::nets, "before",
              result.done_before > 0 ? counted(result.done_before, "model") + " by an earlier run" : "");
  Value codes(Value::List{});
  for (const auto& [code, count] : result.codes) {
    codes.add(Value::Object{{"exit_code", code}, {"models", count}});
    summary.say(Line::nets, code == 0 ? "done" : fmt::format("code {}", code), counted(count, "model"));
  }
  summary.add("codes", std::move(codes));
  summary.add("report", result.report, Line::nets, "report", result.report);
  return summary;
}

Summary summary(const std::string& model, const SolidResult& result) {
  std::size_t points = 0;
  std::size_t triangles = 0;
  Value bodies(Value::List{});
  for (const solid::Body& body : result.bodies) {
    points += body.points.size();
    triangles += body.triangles.size();
    bodies.add(Value::Object{{"vertices", body.points.size()},
                             {"faces", body.triangles.size()},
                             {"volume", solid::mass_properties(body).volume}});
  }
  Summary summary(model + ": " + counted(result.model.polygon_count, "polygon"));
  summary.add("model", result.model.name);
  summary.add("faces", result.model.polygon_count);
  summary.add("parts", result.parts, Line::nets, "parts",
              result.parts > 0 ? std::to_string(result.parts) : "");
  summary.add("bodies", std::move(bodies), Line::nets, "result",
              fmt::format("{} {}, {} vertices, {} faces", result.bodies.size(),
                          result.bodies.size() == 1 ? "body" : "bodies", points, triangles));
  if (result.fit) {
    add_fit(summary, *result.fit);
  }
  summary.add_notes(result.notes);
  summary.add_seconds(result.clock.seconds());
  summary.add_repairs(result.model.repairs);
  summary.add_files(result.files);
  return summary;
}

namespace {

// What ridgecraft verify tells; the keys are those of docs/reference/json.md, in its order.

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
          p.faulty == 0 ? fmt::format("lines at most {:.3g} mm off their places", p.max_error_mm)
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
