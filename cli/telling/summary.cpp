// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/telling/summary.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/files/model_input.hpp"
#include "cli/telling/summary_blocks.hpp"
#include "cli/telling/summary_pieces.hpp"
#include "cli/telling/summary_tabs.hpp"
#include "unfold/tabs/place/place_tabs.hpp"

namespace ridgecraft::cli {
namespace {

std::string metres(double mm) {
  return mm < 1000.0 ? fmt::format("{:.0f} mm", mm) : fmt::format("{:.2f} m", mm / 1000.0);
}

Json size_json(const mesh::Surface& surface) {
  const Vec3 size = surface.bounds().size();
  return Json::array({rounded(size.x), rounded(size.y), rounded(size.z)});
}

std::string size_text(const mesh::Surface& surface) {
  const Vec3 size = surface.bounds().size();
  return fmt::format("{:.1f} x {:.1f} x {:.1f} mm", size.x, size.y, size.z);
}

/// A surface that moved by more than this share of the largest extent has lost some of its shape.
constexpr double far_moved = 0.04;

std::string simplified_text(const prepare::SimplifyReport& report, const SizeArguments& size,
                            const mesh::Surface& surface) {
  std::string text;
  if (report.faces_after < report.faces_before && report.deviation_mm > 0.0) {
    text += fmt::format("  simplified  from {} to {} faces, the surface moved by at most {:.2f} mm\n",
                        report.faces_before, report.faces_after, report.deviation_mm);
    const double largest = surface.bounds().largest_extent();
    if (report.deviation_mm > far_moved * largest) {
      text += fmt::format(
          "  coarse      that is {:.0f} % of the size: parts that stand out may be gone; more --faces keep "
          "them\n",
          100.0 * report.deviation_mm / largest);
    }
  }
  if (report.specks_dropped > 0) {
    text +=
        fmt::format("  left out    {} too small to be held\n", counted(report.specks_dropped, "component"));
  }
  if (report.still_too_fine) {
    text += fmt::format(
        "  too fine    {:.0f} % of the folds are shorter than {:g} mm; a larger --size or --faces N helps\n",
        100.0 * report.short_edges_after, size.simplify.short_edge_mm);
  }
  return text;
}

/// In whole millimetres.
std::optional<double> size_saving_a_page(const PaperResult& result) {
  if (!result.share_saving_a_page) {
    return std::nullopt;
  }
  return std::floor(*result.share_saving_a_page * result.prepared.model.surface.bounds().largest_extent());
}

std::string notes_text(const unfold::Nets& nets) {
  std::string text;
  for (const std::string& note : nets.notes) {
    text += "  note        " + note + "\n";
  }
  return text;
}

}  // namespace

std::vector<std::string> repair_lines(const mesh::RepairReport& report) {
  std::vector<std::string> lines;
  for (const mesh::Repair& repair : report.entries()) {
    std::string line = mesh::sentence(repair.kind, repair.count);
    if (!repair.detail.empty()) {
      line += " (" + repair.detail + ")";
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

std::string error_json(ExitCode code, const std::string& sentence) {
  const Json json{{"error", {{"code", static_cast<int>(code)}, {"message", sentence}}}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string summary(const PaperJob& job, const PaperResult& result) {
  const mesh::Model& model = result.prepared.model;
  const unfold::Nets& nets = result.nets;
  std::string text = fmt::format(
      "{}: {}, {} on paper, {}\n", shown_name(job.model), counted(result.polygons, "polygon"),
      counted(model.surface.face_count(), "face"), counted(model.surface.component_count(), "component"));
  text += fmt::format("  size        {} ({})\n", size_text(model.surface), job.size.asked);
  text += simplified_text(result.prepared.simplified, job.size, result.prepared.model.surface);
  text += fmt::format("  nets        {}, {}{} on {}, {}\n", counted(result.parts, "part"),
                      counted(nets.pieces.size(), "piece"), reasons_text(nets),
                      counted(result.pages.count, "page"), job.paper_name);
  if (const auto size = size_saving_a_page(result)) {
    text += fmt::format(
        "  hint        at {:.0f} % of this size these pieces would take a page less: --size {:.0f}mm\n",
        100.0 * *result.share_saving_a_page, *size);
  }
  text += extra_pieces_text(nets);
  text += tabs_text(model.surface, nets, job.tabs);
  text += fmt::format("  lines       {} to cut, {} to fold\n", metres(result.figures.cut_mm),
                      metres(result.figures.fold_mm));
  text += numbers_text(result.drawn);
  if (result.slivers > 0) {
    text += fmt::format(
        "  slivers     {} thinner than {:g} mm, too thin to cut or fold; a larger --size or --faces N "
        "helps\n",
        counted(result.slivers, "face"), sliver_mm);
  }
  text += folding_text(nets);
  text += colours_text(model);
  text += bodies_text(result.nets, result.drawn.bodies);
  text += notes_text(nets);
  text += fmt::format("  time        {}\n", seconds_text(result.clock));
  return text + written_text(result.files);
}

std::string summary_json(const PaperJob& job, const PaperResult& result) {
  const mesh::Model& model = result.prepared.model;
  const prepare::SimplifyReport& simplified = result.prepared.simplified;
  Json json;
  json["model"] = model.name;
  json["faces"] = model.surface.face_count();
  json["parts"] = result.parts;
  json["pieces"] = result.nets.pieces.size();
  json["pages"] = result.pages.count;
  const auto saving = size_saving_a_page(result);
  json["size_saving_a_page_mm"] = saving ? Json(*saving) : Json();
  json["extra_pieces"] = extra_pieces_json(result.nets);
  json["size_mm"] = size_json(model.surface);
  json["tabs"] = result.figures.tabs;
  json["tabs_usable"] = unfold::tabs_usable(model.surface, result.nets, job.tabs);
  json["joins_too_narrow"] = joins_too_narrow(result.nets);
  json["joins"] = result.figures.joins;
  json["joins_without_tab"] = result.figures.joins_without_tab;
  json["cut_mm"] = rounded(result.figures.cut_mm);
  json["fold_mm"] = rounded(result.figures.fold_mm);
  json["index"] = index_json(model.surface, result.nets, result.pages);
  json["labels_left_out"] = result.drawn.labels_left_out.size();
  json["numbers_without_place"] = numbers_json(result.drawn);
  json["labels_outside"] = result.drawn.labels_outside;
  json["names_left_out"] = result.drawn.names_left_out;
  json["slivers"] = result.slivers;
  json["pieces_to_fold_with_care"] = folding_json(result.nets);
  json["bodies"] = bodies_json(result.nets, result.drawn.bodies);
  json["paper"] = job.paper_name;
  json["simplified"] = {{"faces_before", simplified.faces_before},
                        {"faces_after", simplified.faces_after},
                        {"deviation_mm", rounded(simplified.deviation_mm)},
                        {"specks_dropped", simplified.specks_dropped},
                        {"short_edges_before", rounded(simplified.short_edges_before)},
                        {"short_edges_after", rounded(simplified.short_edges_after)},
                        {"still_too_fine", simplified.still_too_fine}};
  json["seconds"] = seconds_json(result.clock);
  json["repairs"] = repairs_json(model.repairs);
  json["notes"] = result.nets.notes;
  json["files"] = result.files;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string summary(const UnfoldJob& job, const UnfoldResult& result) {
  std::string text = fmt::format("{}: {}, {}\n", shown_name(job.model),
                                 counted(result.prepared.model.surface.face_count(), "face"),
                                 counted(result.prepared.model.surface.component_count(), "component"));
  text += simplified_text(result.prepared.simplified, job.size, result.prepared.model.surface);
  text += fmt::format("  nets        {}, {}{}, {} overlaps\n", counted(result.parts, "part"),
                      counted(result.nets.pieces.size(), "piece"), reasons_text(result.nets),
                      result.figures.overlaps);
  if (job.tabs.wanted) {
    text += tabs_text(result.prepared.model.surface, result.nets, job.tabs);
  }
  text += folding_text(result.nets);
  text += notes_text(result.nets);
  text += fmt::format("  time        {}\n", seconds_text(result.clock));
  return text + written_text(result.files);
}

std::string summary_json(const UnfoldJob& job, const UnfoldResult& result) {
  const mesh::Model& model = result.prepared.model;
  Json json;
  json["model"] = model.name;
  json["faces"] = model.surface.face_count();
  json["parts"] = result.parts;
  json["pieces"] = result.nets.pieces.size();
  json["overlaps"] = result.figures.overlaps;
  json["joins"] = result.nets.joins.size();
  if (job.tabs.wanted) {
    json["tabs"] = result.nets.tabs.size();
    json["tabs_usable"] = unfold::tabs_usable(model.surface, result.nets, {});
    json["joins_without_tab"] = joins_without_tab(result.nets);
    json["joins_too_narrow"] = joins_too_narrow(result.nets);
  }
  json["size_mm"] = size_json(model.surface);
  json["cut_mm"] = rounded(result.figures.cut_mm);
  json["fold_mm"] = rounded(result.figures.fold_mm);
  json["reasons"] = Json::array();
  for (const unfold::Piece& piece : result.nets.pieces) {
    json["reasons"].push_back(unfold::name(piece.reason));
  }
  json["pieces_to_fold_with_care"] = folding_json(result.nets);
  json["seconds"] = result.clock.total();
  json["stages"] = seconds_json(result.clock);
  json["repairs"] = repairs_json(model.repairs);
  json["notes"] = result.nets.notes;
  json["files"] = result.files;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string summary(const InfoJob& job, const mesh::Model& model, const prepare::Panels& panels) {
  const mesh::Surface& surface = model.surface;
  std::size_t border = 0;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    border += surface.is_border(e) ? 1U : 0U;
  }
  const Vec3 size = model.file_scale * surface.bounds().size();
  std::string text = fmt::format("{}: {}\n", shown_name(job.model), counted(model.polygon_count, "polygon"));
  text += fmt::format("  surface     {}, {}, {}, {}\n", counted(surface.face_count(), "triangle"),
                      fmt::format("{} vertices", surface.vertex_count()), counted(panels.count(), "panel"),
                      counted(surface.component_count(), "component"));
  text += border == 0 ? std::string("  border      none: the surface is closed\n")
                      : fmt::format("  border      {}\n", counted(border, "edge"));
  text += fmt::format("  size        {:g} x {:g} x {:g} in the file's unit\n", size.x, size.y, size.z);
  for (const std::string& line : repair_lines(model.repairs)) {
    text += "  repair      " + line + "\n";
  }
  return text;
}

std::string summary_json(const InfoJob&, const mesh::Model& model, const prepare::Panels& panels) {
  const mesh::Surface& surface = model.surface;
  std::size_t border = 0;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    border += surface.is_border(e) ? 1U : 0U;
  }
  const Vec3 size = model.file_scale * surface.bounds().size();
  Json json;
  json["model"] = model.name;
  json["polygons"] = model.polygon_count;
  json["faces"] = surface.face_count();
  json["vertices"] = surface.vertex_count();
  json["panels"] = panels.count();
  json["components"] = surface.component_count();
  json["border_edges"] = border;
  json["size"] = Json::array({size.x, size.y, size.z});
  json["materials"] = model.materials.size();
  json["textured"] = !model.texture.empty();
  json["repairs"] = repairs_json(model.repairs);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string summary(const VerifyJob& job, const verify::Report& report) {
  std::string text;
  if (report.figures) {
    const verify::Figures& f = *report.figures;
    text += fmt::format("{}: {}, {}, {}\n", job.file, counted(f.faces, "face"), counted(f.pieces, "piece"),
                        counted(f.pages, "page"));
    text += fmt::format("  lengths     largest error {:.3g} mm\n", f.max_length_error_mm);
    text += fmt::format("  overlaps    {} of faces, {} of tabs, deepest {:.3g} mm\n", f.overlaps,
                        f.tab_overlaps, f.max_penetration_mm);
    text += fmt::format("  coverage    {} missing, {} double\n", f.missing_faces, f.double_faces);
    text += fmt::format("  pages       {} outside\n", f.outside_page);
    text += fmt::format("  joins       {}, {} bad, {} without tab, {}\n", f.joins, f.bad_joins,
                        f.joins_without_tab, counted(f.tabs, "tab"));
    text += fmt::format("  refolding   largest error {:.3g} mm, folds {:.3g} degrees\n",
                        f.max_refold_error_mm, f.max_fold_error_deg);
    text += fmt::format("  lines       {} to cut, {} to fold\n", metres(f.cut_mm), metres(f.fold_mm));
  }
  if (!report.figures) {
    text += fmt::format("{}: not in the form of nets, so nothing else was checked\n", job.file);
  }
  for (const verify::Fault& fault : report.faults) {
    text += fmt::format("fault of promise {}: {}\n", static_cast<int>(fault.promise), fault.message);
  }
  if (report.sound()) {
    text += "no faults\n";
  }
  return text;
}

}  // namespace ridgecraft::cli
