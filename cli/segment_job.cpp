// SPDX-License-Identifier: GPL-3.0-or-later
// ridgecraft segment: reads, segments, compares, writes.
#include <set>

#include "cli/label_files.hpp"
#include "cli/part_files.hpp"
#include "cli/pipeline.hpp"
#include "cli/targets.hpp"
#include "mesh/error.hpp"
#include "mesh/write.hpp"
#include "segment/evaluate.hpp"

namespace ridgecraft::cli {
namespace {

namespace fs = std::filesystem;

/// Rays a side of the grid that measures the hulls' union: 512 differ from 128 by less than 0.001.
constexpr unsigned volume_rays = 128;

void check_outputs(const SegmentJob& job) {
  for (const std::string& output : job.outputs) {
    const std::string suffix = suffix_of(output);
    if (suffix != ".ply" && suffix != ".off") {
      throw Error(ErrorKind::usage, "-o " + output + ": parts are written as .ply or .off");
    }
  }
  std::vector<fs::path> files(job.outputs.begin(), job.outputs.end());
  std::set<fs::path> different;
  for (const fs::path& file : files) {
    if (!different.insert(file.lexically_normal()).second) {
      throw Error(ErrorKind::usage, "-o " + file.string() + " is given twice");
    }
  }
  if (!job.labels.empty()) {
    files.emplace_back(job.labels);
  }
  for (const fs::path& file : files) {
    require_writable_folder(file.has_parent_path() ? file.parent_path() : fs::path("."));
  }
}

Comparison compare_with(const std::vector<std::string>& files, const mesh::Model& model,
                        const segment::Segmentation& segmentation, const Context& context) {
  Comparison comparison;
  std::vector<std::uint32_t> of_face;
  for (const PartId part : segmentation.part) {
    of_face.push_back(part.value());
  }
  comparison.volume_ratio = segment::hull_volume_ratio(model.surface, of_face, volume_rays, context);
  const Labels ours = polygon_labels(model, segmentation);
  for (const std::string& file : files) {
    context.check();
    const Labels theirs = read_labels(file, model.polygon_count);
    comparison.with.push_back({file, segment::compare(model.surface, model.polygon.items(), ours, theirs)});
  }
  return comparison;
}

void add_files(const SegmentJob& job, SegmentResult& result, PendingFiles& pending) {
  const mesh::FaceColours colours = part_colours(result.segmentation);
  for (const std::string& output : job.outputs) {
    const std::string comment =
        paper::mark_word({program_and_version(), result.model.name, result.model.digest});
    std::string bytes = suffix_of(output) == ".ply"
                            ? mesh::write_ply(result.model.surface, colours, mesh::PlyKind::binary)
                            : mesh::write_off(result.model.surface, colours);
    pending.add(output, with_comment(std::move(bytes), comment));
    result.files.push_back(output);
  }
  if (!job.labels.empty()) {
    // Labels have no place for a mark: the same ones may stand there already, others are somebody's work.
    const std::string labels = label_text(polygon_labels(result.model, result.segmentation));
    require_replaceable(job.labels, {}, job.overwrite || holds(job.labels, labels));
    pending.add(job.labels, labels);
    result.files.push_back(job.labels);
  }
}

}  // namespace

SegmentResult make_parts(const SegmentJob& job, const RunContext& run, PendingFiles& pending) {
  check_outputs(job);
  const Context& context = run.patient;
  SegmentResult result;
  StageClock& clock = result.clock;
  result.model = clock("read", context, [&] {
    return in_time(run, job.model + " was read", [&](const Context& strict) {
      return mesh::read(job.model, {.collapse_flat_faces = false}, strict);
    });
  });
  for (const std::string& output : job.outputs) {
    require_replaceable(output, result.model.digest, job.overwrite);
  }
  result.segmentation = clock("segment", context, [&] {
    return in_time(run, job.model + " was segmented", [&](const Context& strict) {
      return segment::segment(result.model.surface, result.model.polygon.items(), job.options, strict);
    });
  });
  if (!job.compare.empty()) {
    result.comparison = clock("compare", context, [&] {
      return compare_with(job.compare, result.model, result.segmentation, context);
    });
  }
  clock("write", context, [&] {
    add_files(job, result, pending);
    context.check();
    pending.commit();
    return true;
  });
  return result;
}

}  // namespace ridgecraft::cli
