// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/jobs/segment_job.hpp"

#include <array>
#include <map>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/version.hpp"
#include "cli/files/input_files.hpp"
#include "cli/files/part_files.hpp"
#include "cli/files/targets.hpp"
#include "cli/jobs/stages.hpp"
#include "export/export.hpp"
#include "mesh/mesh.hpp"
#include "mesh/model/model.hpp"
#include "segment/evaluate.hpp"
#include "segment/hierarchy.hpp"
#include "segment/surface/segmentation.hpp"

namespace ridgecraft::cli {
namespace {

namespace fs = std::filesystem;

/// Rays a side of the grid that measures the hulls' union: 512 differ from 128 by less than 0.001.
constexpr unsigned volume_rays = 128;

void check_outputs(const SegmentJob& job) {
  require_no_dash("--labels", job.labels);
  require_no_dash("--hierarchy", job.hierarchy);
  for (const std::string& output : job.outputs) {
    require_no_dash("-o", output);
    const std::string suffix = suffix_of(output);
    if (suffix != ".ply" && suffix != ".off") {
      throw Error(ErrorKind::usage, "-o " + output + ": parts are written as .ply or .off");
    }
  }
  std::vector<std::pair<const char*, fs::path>> files;
  for (const std::string& output : job.outputs) {
    files.emplace_back("-o ", output);
  }
  if (!job.labels.empty()) {
    files.emplace_back("--labels ", job.labels);
  }
  if (!job.hierarchy.empty()) {
    files.emplace_back("--hierarchy ", job.hierarchy);
  }
  std::map<fs::path, std::string> different;
  for (const auto& [option, file] : files) {
    const auto [first, added] = different.emplace(place_of(file), option + file.string());
    if (!added) {
      throw Error(ErrorKind::usage, option + file.string() + " names the same file as " + first->second);
    }
  }
  for (const auto& [option, file] : files) {
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
  const Labels ours = segment::polygon_labels(model, segmentation);
  for (const std::string& file : files) {
    context.check();
    const Labels theirs = read_labels(file, model.polygon_count);
    comparison.with.push_back({file, segment::compare(model.surface, model.polygon.items(), ours, theirs)});
  }
  return comparison;
}

/// Labels have no place for a mark: the same ones may stand there already, others are somebody's work.
void require_same_labels(const SegmentJob& job, const std::string& bytes) {
  std::error_code error;
  if (!job.overwrite && fs::exists(fs::symlink_status(job.labels, error)) && !holds(job.labels, bytes)) {
    throw Error(ErrorKind::cant_write, job.labels + " holds other labels; --overwrite replaces it",
                job.labels);
  }
}

/// The same before the work, when the bytes aren't known: what can't be the same ones is refused.
void require_own_labels(const SegmentJob& job, std::size_t polygons) {
  const auto are_labels = [&] {
    try {
      return read_labels(job.labels, polygons).size() == polygons;
    } catch (const Error&) {
      return false;
    }
  };
  require_replaceable(job.labels, {}, job.overwrite || are_labels());
}

void add_files(const SegmentJob& job, const std::string& labels, SegmentResult& result,
               PendingFiles& pending) {
  std::optional<mesh::Surface> in_file_numbers;
  if (result.model.file_scale != 1.0) {
    in_file_numbers = mesh::surface_in_file_numbers(result.model);
  }
  const mesh::Surface& surface = in_file_numbers ? *in_file_numbers : result.model.surface;
  const mesh::FaceColours colours = part_colours(result.segmentation);
  for (const std::string& output : job.outputs) {
    const std::string comment =
        export_::mark_word({program_and_version(), result.model.name, result.model.digest});
    std::string bytes = suffix_of(output) == ".ply" ? mesh::write_ply(surface, colours, mesh::PlyKind::binary)
                                                    : mesh::write_off(surface, colours);
    pending.add(output, with_comment(std::move(bytes), comment));
    result.files.push_back(output);
  }
  if (!job.labels.empty()) {
    require_same_labels(job, labels);
    pending.add(job.labels, labels);
    result.files.push_back(job.labels);
  }
}

/// The files that say from which model they were made.
void require_marked_replaceable(const SegmentJob& job, const std::string& digest) {
  for (const std::string& output : job.outputs) {
    require_replaceable(output, digest, job.overwrite);
  }
  if (!job.hierarchy.empty()) {
    require_replaceable(job.hierarchy, digest, job.overwrite);
  }
}

/// Puts all files in place, unless another run has put some there since.
std::vector<std::string> commit(const SegmentJob& job, const SegmentResult& result, const std::string& labels,
                                PendingFiles& pending) {
  return pending.commit([&]() -> std::vector<fs::path> {
    require_marked_replaceable(job, result.model.digest);
    if (!job.labels.empty()) {
      require_same_labels(job, labels);
    }
    return {};
  });
}

/// A surface of so many faces is more than its points and faces by hundreds of megabytes. It goes while its
/// parts are looked for, and is made again afterwards.
constexpr std::size_t large_surface = 1000000;

segment::Segmentation find_parts_of_large(mesh::Model& model, const segment::Options& options,
                                          const Context& context) {
  std::vector<Vec3> points(model.surface.points().begin(), model.surface.points().end());
  std::vector<std::array<VertexId, 3>> faces;
  faces.reserve(model.surface.face_count());
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    faces.push_back(model.surface.vertices(f));
  }
  segment::Segmentation found =
      segment::segment(std::move(model.surface), model.polygon.items(), options, context);
  model.surface = mesh::Surface(std::move(points), std::move(faces));
  return found;
}

}  // namespace

SegmentResult make_parts(const SegmentJob& job, const Context& context, PendingFiles& pending) {
  check_outputs(job);
  SegmentResult result;
  job::StageClock clock;
  result.model = clock("read", context, [&] {
    return in_time(context, shown_name(job.model) + " was read", [&](const Context& strict) {
      return read_model(job.model, {.collapse_flat_faces = false}, strict);
    });
  });
  require_marked_replaceable(job, result.model.digest);
  if (!job.labels.empty()) {
    require_own_labels(job, result.model.polygon_count);
  }
  std::optional<segment::Hierarchy> hierarchy;
  result.segmentation = clock("segment", context, [&] {
    return in_time(context, shown_name(job.model) + " was segmented", [&](const Context& strict) {
      if (!job.hierarchy.empty()) {
        hierarchy = segment::find_hierarchy(result.model.surface, result.model.polygon.items(),
                                            job.parts.count, strict);
      }
      if (job.parts.count == 0 && !hierarchy && result.model.surface.face_count() >= large_surface) {
        return find_parts_of_large(result.model, options_for(result.model, job.parts), strict);
      }
      return find_parts(result.model, shown_name(job.model), job.parts, hierarchy, strict);
    });
  });
  const double scale = result.model.file_scale;
  for (segment::Part& part : result.segmentation.parts) {
    part.hull_volume *= scale * scale * scale;
  }
  if (!job.compare.empty()) {
    result.comparison = clock("compare", context, [&] {
      return in_time(context, "the parts were compared with others", [&](const Context& strict) {
        return compare_with(job.compare, result.model, result.segmentation, strict);
      });
    });
  }
  clock("write", context, [&] {
    const std::string labels =
        job.labels.empty() ? "" : label_text(segment::polygon_labels(result.model, result.segmentation));
    add_files(job, labels, result, pending);
    if (!job.hierarchy.empty()) {
      pending.add(job.hierarchy, hierarchy_text(result.model, *hierarchy));
      result.files.push_back(job.hierarchy);
    }
    context.check();
    result.file_notes = commit(job, result, labels, pending);
    return true;
  });
  result.seconds = clock.seconds();
  return result;
}

}  // namespace ridgecraft::cli
