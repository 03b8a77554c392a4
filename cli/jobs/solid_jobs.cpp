// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/jobs/solid_jobs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <system_error>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/text.hpp"
#include "base/version.hpp"
#include "cli/files/formats.hpp"
#include "cli/files/input_files.hpp"
#include "cli/files/part_files.hpp"
#include "cli/files/targets.hpp"
#include "cli/jobs/stages.hpp"
#include "export/export.hpp"
#include "mesh/mesh.hpp"
#include "mesh/model/model.hpp"
#include "mesh/reading/read_soup.hpp"
#include "solid/solid.hpp"

namespace ridgecraft::cli {
namespace {

namespace fs = std::filesystem;

/// Refuses what can't be written before the work begins.
void check_output(const std::string& output, const std::vector<std::string>& suffixes,
                  const std::string& what) {
  require_no_dash("-o", output);
  if (std::find(suffixes.begin(), suffixes.end(), suffix_of(output)) == suffixes.end()) {
    throw Error(ErrorKind::usage, "-o " + output + ": " + what);
  }
  const fs::path folder = fs::path(output).parent_path();
  require_writable_folder(folder.empty() ? fs::path(".") : folder);
}

const std::vector<std::string> mesh_suffixes{".obj", ".ply", ".off"};
constexpr const char* mesh_formats = "a mesh is written as .obj, .ply or .off";

std::string comment_of(const mesh::Model& model) {
  return export_::mark_word({program_and_version(), model.name, model.digest});
}

std::string mesh_bytes(const mesh::Surface& surface, const std::string& suffix, const std::string& comment) {
  if (suffix == ".ply") {
    return with_comment(mesh::write_ply(surface, {}, mesh::PlyKind::binary), comment);
  }
  if (suffix == ".off") {
    return with_comment(mesh::write_off(surface, {}), comment);
  }
  return "# " + comment + "\n" + mesh::write_obj(surface);
}

mesh::Surface surface_of(const solid::Body& body) {
  std::vector<std::array<VertexId, 3>> faces;
  for (const auto& [a, b, c] : body.triangles) {
    faces.push_back({VertexId(a), VertexId(b), VertexId(c)});
  }
  return {body.points, faces};
}

/// What every job begins with: refuses an output that can't be written before the long work, and reads.
template <class SolidJob>
SolidResult begin(const SolidJob& job, const std::vector<std::string>& suffixes, const char* formats,
                  const Context& context) {
  check_output(job.output, suffixes, formats);
  SolidResult result;
  result.model = result.clock("read", context,
                              [&] { return read_model(job.model, {.collapse_flat_faces = false}, context); });
  require_replaceable(job.output, result.model.digest, job.overwrite);
  return result;
}

/// Lengths leave as the file had them.
void to_file_numbers(std::vector<solid::Body>& bodies, double file_scale) {
  for (solid::Body& body : bodies) {
    mesh::to_file_numbers(body.points, file_scale);
  }
}

void find_hulls(SolidResult& result, const std::string& file, const PartArguments& arguments,
                std::size_t max_vertices, const Context& context) {
  const segment::Segmentation parts = result.clock("segment", context, [&] {
    std::optional<segment::Hierarchy> hierarchy;
    return find_parts(result.model, file, arguments, hierarchy, context);
  });
  result.parts = parts.parts.size();
  result.bodies = result.clock("hulls", context, [&] {
    return solid::part_hulls(result.model.surface, parts, {.max_vertices = max_vertices}, context);
  });
}

/// Writes one file, if it may be replaced.
void add_file(const fs::path& file, const std::string& bytes, const std::string& digest, bool overwrite,
              PendingFiles& pending, std::vector<std::string>& files) {
  require_replaceable(file, digest, overwrite);
  pending.add(file, bytes);
  files.push_back(file.string());
}

/// Puts all files in place, unless another run has put some there since. `leftovers` gives what is to go.
void commit(
    bool overwrite, PendingFiles& pending, SolidResult& result,
    const PendingFiles::LastLook& leftovers = [] { return std::vector<fs::path>(); }) {
  result.file_notes = pending.commit([&] {
    for (const std::string& file : result.files) {
      require_replaceable(file, result.model.digest, overwrite);
    }
    return leftovers();
  });
}

/// A robot description names meshes that lie beside it.
std::string visual_file(const fs::path& urdf) {
  return urdf.stem().string() + "-visual.obj";
}
std::string hull_stem(const fs::path& urdf) {
  return urdf.stem().string() + "-hull";
}
std::string hull_file(const fs::path& urdf, std::size_t number) {
  return fmt::format("{}-{}.obj", hull_stem(urdf), number);
}

/// Before the long work, when nobody knows how many hulls there will be: at least one.
void require_companions_replaceable(const HullsJob& job, const std::string& digest) {
  const fs::path urdf(job.output);
  for (const std::string& name : {visual_file(urdf), hull_file(urdf, 1)}) {
    require_replaceable(urdf.parent_path() / name, digest, job.overwrite);
  }
}

/// The URDF with the meshes that it names, all beside it.
void add_urdf(const HullsJob& job, SolidResult& result, PendingFiles& pending) {
  const solid::MassProperties whole = solid::mass_properties(result.bodies);
  if (std::any_of(whole.inertia.begin(), whole.inertia.end(), [](double i) { return !std::isfinite(i); })) {
    throw Error(ErrorKind::unusable_mesh,
                "its numbers are too large or too small for the inertia of a .urdf");
  }
  const fs::path folder = fs::path(job.output).parent_path();
  const std::string stem = fs::path(job.output).stem().string();
  const std::string comment = comment_of(result.model);
  const auto add = [&](const std::string& name, const std::string& bytes) {
    add_file(folder / name, bytes, result.model.digest, job.overwrite, pending, result.files);
  };
  solid::UrdfOptions options{
      .name = stem,
      .comment = comment,
      .visual_file = visual_file(job.output),
      .mesh_files = {},
      .metres_per_unit = job.mm_per_unit.value_or(result.model.frame.mm_per_unit.value_or(1.0)) / 1000.0,
      .density = job.density};
  for (std::size_t i = 0; i < result.bodies.size(); ++i) {
    options.mesh_files.push_back(hull_file(job.output, i + 1));
  }
  add(fs::path(job.output).filename().string(), solid::write_urdf(result.bodies, options));
  add(options.visual_file, mesh_bytes(mesh::surface_in_file_numbers(result.model), ".obj", comment));
  for (std::size_t i = 0; i < result.bodies.size(); ++i) {
    add(options.mesh_files[i], solid::write_obj({result.bodies[i]}, comment));
  }
}

/// Hulls of an earlier description of this name that the new one doesn't name: of this model, and of the one
/// that the file was made from which is replaced now. Never the model itself.
std::vector<fs::path> find_leftovers(const HullsJob& job, const SolidResult& result) {
  const fs::path urdf(job.output);
  std::set<std::string> digests = digests_of({urdf});
  digests.insert(result.model.digest);
  const std::set<fs::path> written(result.files.begin(), result.files.end());
  std::vector<fs::path> found = leftovers_of({urdf.parent_path(), hull_stem(urdf), ".obj"}, written, digests);
  const std::string unnumbered = hull_stem(urdf) + ".obj";
  std::erase_if(found, [&](const fs::path& file) {
    std::error_code ignored;
    return file.filename() == unnumbered || fs::equivalent(file, job.model, ignored);
  });
  return found;
}

/// Writes the only body as a mesh.
void write_body(const std::string& output, bool overwrite, const Context& context, PendingFiles& pending,
                SolidResult& result) {
  result.clock("write", context, [&] {
    to_file_numbers(result.bodies, result.model.file_scale);
    const std::string bytes =
        mesh_bytes(surface_of(result.bodies.front()), suffix_of(output), comment_of(result.model));
    add_file(output, bytes, result.model.digest, overwrite, pending, result.files);
    context.check();
    commit(overwrite, pending, result);
    return true;
  });
}

/// A cage as its file has it: repair might renumber it.
solid::Body read_cage(const std::string& file, const Context& context) {
  const mesh::Soup soup = mesh::read_soup(file, context, importer_program());
  solid::Body body;
  body.points = soup.points;
  for (std::size_t i = 0; i < soup.polygon_count(); ++i) {
    const auto corners = soup.polygon(i);
    if (corners.size() != 3) {
      throw Error(
          ErrorKind::unusable_mesh,
          fmt::format("{}: face {} has {} corners; a cage has triangles only", file, i + 1, corners.size()),
          file);
    }
    body.triangles.push_back({corners[0], corners[1], corners[2]});
  }
  return body;
}

}  // namespace

SolidResult make_hulls(const HullsJob& job, const Context& context, PendingFiles& pending) {
  SolidResult result = begin(job, {".obj", ".urdf"}, "hulls are written as .obj or .urdf", context);
  if (suffix_of(job.output) == ".urdf") {
    require_companions_replaceable(job, result.model.digest);
  }
  find_hulls(result, shown_name(job.model), job.parts, job.max_vertices, context);
  result.clock("write", context, [&] {
    to_file_numbers(result.bodies, result.model.file_scale);
    if (suffix_of(job.output) == ".urdf") {
      add_urdf(job, result, pending);
      context.check();
      commit(job.overwrite, pending, result, [&] { return find_leftovers(job, result); });
    } else {
      add_file(job.output, solid::write_obj(result.bodies, comment_of(result.model)), result.model.digest,
               job.overwrite, pending, result.files);
      context.check();
      commit(job.overwrite, pending, result);
    }
    return true;
  });
  return result;
}

SolidResult make_cage(const CageJob& job, const Context& context, PendingFiles& pending) {
  SolidResult result = begin(job, mesh_suffixes, mesh_formats, context);
  find_hulls(result, shown_name(job.model), job.parts, 0, context);
  const solid::Body cage = result.clock(
      "cage", context, [&] { return solid::cage(result.bodies, {.faces = job.faces}, context); });
  result.bodies = {cage};
  write_body(job.output, job.overwrite, context, pending, result);
  return result;
}

SolidResult make_shell(const ShellJob& job, const Context& context, PendingFiles& pending) {
  SolidResult result = begin(job, mesh_suffixes, mesh_formats, context);
  result.bodies = {result.clock("shell", context, [&] {
    return solid::shell(result.model.surface, {.opening = job.opening, .offset = job.offset}, context);
  })};
  write_body(job.output, job.overwrite, context, pending, result);
  return result;
}

SolidResult make_deformed(const DeformJob& job, const Context& context, PendingFiles& pending) {
  require_no_input(job.output, {{"--cage", job.cage}, {"--to", job.to}}, job.overwrite);
  SolidResult result = begin(job, mesh_suffixes, mesh_formats, context);
  const solid::Body before = read_cage(job.cage, context);
  solid::require_closed(job.cage, before);
  const solid::Body after = read_cage(job.to, context);
  if (before.points.size() != after.points.size() || before.triangles != after.triangles) {
    throw Error(ErrorKind::unusable_mesh,
                job.to + " doesn't have the same triangles over as many points as " + job.cage, job.to);
  }
  solid::Body moved = result.clock("deform", context, [&] {
    std::vector<Vec3> points(result.model.surface.points().begin(), result.model.surface.points().end());
    mesh::to_file_numbers(points, result.model.file_scale);  // as those of the cages are
    if (const std::size_t outside = solid::count_outside(points, before, context); outside > 0) {
      result.notes.push_back(
          Message("points_outside", {{"n", outside}, {"all", points.size()}, {"file", job.cage}}));
    }
    solid::Body body;
    body.points = solid::deform(points, before, after, context);
    return body;
  });
  for (const FaceId f : ids<FaceId>(result.model.surface.face_count())) {
    const auto [a, b, c] = result.model.surface.vertices(f);
    moved.triangles.push_back({a.value(), b.value(), c.value()});
  }
  result.model.file_scale = 1.0;
  result.bodies = {std::move(moved)};
  write_body(job.output, job.overwrite, context, pending, result);
  return result;
}

}  // namespace ridgecraft::cli
