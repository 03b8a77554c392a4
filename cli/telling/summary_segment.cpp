// SPDX-License-Identifier: GPL-3.0-or-later
// What ridgecraft segment tells of its work.
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/sentence.hpp"
#include "cli/files/model_input.hpp"
#include "cli/telling/summary.hpp"

namespace ridgecraft::cli {
namespace {

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

}  // namespace ridgecraft::cli
