// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/report/summary.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text.hpp"
#include "cli/files/formats.hpp"
#include "cli/files/model_input.hpp"
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

std::vector<std::string> repair_lines(const mesh::RepairReport& report, bool united) {
  std::vector<std::string> lines;
  for (const mesh::Repair& repair : report.entries()) {
    std::string line = mesh::sentence(repair.kind, repair.count);
    if (united && repair.kind == mesh::RepairKind::self_intersections) {
      line = counted(repair.count, "face") + " ran through others: uniting the bodies has mended that";
    }
    if (!repair.detail.empty()) {
      line += " (" + repair.detail + ")";
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

std::string error_json(ExitCode code, const std::string& sentence) {
  return json_text(Value::Object{
             {"error", Value::Object{{"code", static_cast<int>(code)}, {"message", sentence}}}}) +
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
  for (const std::string& line : repair_lines(model.repairs)) {
    summary.say(Line::notes, "repair", line);
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
  summary.add_notes(result.notes);
  summary.add_seconds(result.clock.seconds());
  summary.add_repairs(result.model.repairs);
  summary.add_files(result.files);
  return summary;
}

}  // namespace ridgecraft::cli
