// SPDX-License-Identifier: GPL-3.0-or-later
// What ridgecraft segment tells of its work.
#include <fmt/format.h>

#include "cli/files/model_input.hpp"
#include "cli/telling/summary.hpp"
#include "cli/telling/summary_blocks.hpp"

namespace ridgecraft::cli {
namespace {

Json disagreement_json(const segment::Disagreement& d) {
  Json json;
  json["rand_error"] = d.rand_error;
  json["hamming"] = d.hamming;
  json["gce"] = d.global_consistency;
  json["lce"] = d.local_consistency;
  json["cut_discrepancy"] = d.cut_discrepancy ? Json(*d.cut_discrepancy) : Json();
  return json;
}

Json comparison_json(const Comparison& comparison) {
  Json json = Json::array();
  for (const Comparison::With& with : comparison.with) {
    Json entry = disagreement_json(with.disagreement);
    entry["file"] = with.file;
    json.push_back(entry);
  }
  return json;
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

std::string disagreement_line(const std::string& name, const segment::Disagreement& d) {
  return fmt::format("  {:<11} 1-Rand {:.4f}, Hamming {:.4f}, GCE {:.4f}, LCE {:.4f}, cuts {}\n", name,
                     d.rand_error, d.hamming, d.global_consistency, d.local_consistency,
                     d.cut_discrepancy ? fmt::format("{:.4f}", *d.cut_discrepancy) : "-");
}

std::string comparison_text(const Comparison& comparison) {
  std::string text =
      fmt::format("  hulls       {:.3f} times the model's volume, together\n", comparison.volume_ratio);
  for (const Comparison::With& with : comparison.with) {
    text += disagreement_line("against", with.disagreement);
    text += fmt::format("              {}\n", with.file);
  }
  if (comparison.with.size() > 1) {
    text += disagreement_line("mean", mean_disagreement(comparison));
  }
  return text;
}

}  // namespace

std::string summary(const SegmentJob& job, const SegmentResult& result) {
  std::string text =
      fmt::format("{}: {}, {}\n", shown_name(job.model), counted(result.model.polygon_count, "polygon"),
                  counted(result.model.surface.component_count(), "component"));
  text += fmt::format("  parts       {}, concavity at most {:.4f}{}\n", result.segmentation.parts.size(),
                      result.segmentation.max_concavity(),
                      job.parts.count > 0 ? "" : fmt::format(" (asked: {:g})", job.parts.options.concavity));
  if (result.comparison) {
    text += comparison_text(*result.comparison);
  }
  text += fmt::format("  time        {}\n", seconds_text(result.clock));
  return result.comparison && result.files.empty() ? text : text + written_text(result.files);
}

std::string summary_json(const SegmentJob& job, const SegmentResult& result) {
  Json json;
  json["model"] = result.model.name;
  json["faces"] = result.model.polygon_count;
  json["parts"] = result.segmentation.parts.size();
  json["max_concavity"] = result.segmentation.max_concavity();
  if (job.parts.count > 0) {
    json["parts_asked"] = job.parts.count;
  } else {
    json["concavity"] = job.parts.options.concavity;
    json["effort"] = job.parts.options.effort;
    json["volume_weight"] = segment::volume_weight(job.parts.options);
    json["planes"] = job.parts.options.planes;
    json["pockets"] = job.parts.options.pockets;
  }
  json["part"] = Json::array();
  for (const segment::Part& part : result.segmentation.parts) {
    json["part"].push_back({{"faces", part.faces.size()},
                            {"concavity", part.concavity},
                            {"hull_volume", part.hull_volume},
                            {"reason", segment::name(part.reason)}});
  }
  if (result.comparison) {
    json["volume_ratio"] = result.comparison->volume_ratio;
    json["compare"] = comparison_json(*result.comparison);
    json["compare_mean"] = disagreement_json(mean_disagreement(*result.comparison));
  }
  json["seconds"] = result.clock.total();
  json["stages"] = seconds_json(result.clock);
  json["repairs"] = repairs_json(result.model.repairs);
  json["files"] = result.files;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace ridgecraft::cli
