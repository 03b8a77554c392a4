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

/// Components that are closed and one part, although they have a tunnel, or less than half of the volume of
/// its hull: what a user may take for open becomes solid.
std::size_t count_closed_openings(const mesh::Surface& surface, const segment::Segmentation& parts,
                                  const std::vector<solid::Body>& hulls) {
  struct Component {
    std::set<PartId> parts;
    std::set<VertexId> vertices;
    std::size_t faces = 0;
    double volume = 0.0;
    bool open = false;
  };
  std::vector<Component> components(surface.component_count());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    Component& component = components[surface.component(f).value()];
    const auto [a, b, c] = surface.vertices(f);
    component.parts.insert(parts.part[f]);
    component.vertices.insert({a, b, c});
    ++component.faces;
    component.volume += dot(surface.point(a), cross(surface.point(b), surface.point(c))) / 6.0;
    for (std::uint32_t k = 0; k < 3; ++k) {
      component.open = component.open || !surface.neighbor(CornerId(3 * f.value() + k)).valid();
    }
  }
  const auto is_closed = [&](const Component& component) {
    if (component.open || component.parts.size() != 1 || component.faces < 4) {
      return false;
    }
    // By Euler's formula; a closed surface has three edges for two faces.
    const bool has_tunnel = component.vertices.size() <= component.faces / 2;
    const std::size_t part = component.parts.begin()->value();
    return has_tunnel || (part < hulls.size() &&
                          solid::mass_properties(hulls[part]).volume > 2.0 * std::abs(component.volume));
  };
  return static_cast<std::size_t>(std::count_if(components.begin(), components.end(), is_closed));
}

segment::Segmentation find_parts_of(const std::string& file, const PartArguments& arguments,
                                    const Context& context, SolidResult& result) {
  segment::Segmentation parts = result.clock("segment", context, [&] {
    std::optional<segment::Hierarchy> hierarchy;
    return find_parts(result.model, file, arguments, hierarchy, context);
  });
  result.parts = parts.parts.size();
  return parts;
}

/// What of a model its hulls don't hold, in words.
std::vector<Message> notes_of(const solid::Fit& fit) {
  if (fit.solid_volume == 0.0) {
    return {Message("hulls_of_open", {})};
  }
  if (fit.uncovered > solid::most_uncovered) {
    return {Message("hulls_uncovered", {{"percent", fmt::format("{:.2f}", 100.0 * fit.uncovered)}})};
  }
  return {};
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

// Some descriptions name meshes that lie beside them.

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

/// Whether a format names meshes that lie beside it.
bool has_companions(const std::string& suffix) {
  return suffix == ".urdf" || suffix == ".xml" || suffix == ".sdf";
}

/// What a description says of a model: mass and inertia of what it encloses, or where nothing is closed of
/// the hulls together.
solid::RigidBody rigid_body(const HullsJob& job, const mesh::Surface& model, const SolidResult& result,
                            const Context& context) {
  const std::optional<solid::MassProperties> of_solid = solid::mass_properties(model, context);
  const solid::MassProperties whole = of_solid ? *of_solid : solid::union_properties(result.bodies, context);
  if (std::any_of(whole.inertia.begin(), whole.inertia.end(), [](double i) { return !std::isfinite(i); })) {
    throw Error(ErrorKind::unusable_mesh,
                "its numbers are too large or too small for the inertia of a " + suffix_of(job.output));
  }
  solid::RigidBody body{
      .name = fs::path(job.output).stem().string(),
      .comment = comment_of(result.model),
      .visual_file = visual_file(job.output),
      .mesh_files = {},
      .metres_per_unit = job.mm_per_unit.value_or(result.model.frame.mm_per_unit.value_or(1.0)) / 1000.0,
      .density = job.density,
      .mass = whole};
  for (std::size_t i = 0; i < result.bodies.size(); ++i) {
    body.mesh_files.push_back(hull_file(job.output, i + 1));
  }
  return body;
}

/// Hulls in the format of the output's suffix, with the meshes that it names beside it.
void add_hulls(const HullsJob& job, const Context& context, SolidResult& result, PendingFiles& pending) {
  const std::string suffix = suffix_of(job.output);
  const fs::path output(job.output);
  const auto add = [&](const std::string& name, const std::string& bytes) {
    add_file(output.parent_path() / name, bytes, result.model.digest, job.overwrite, pending, result.files);
  };
  const std::string file = output.filename().string();
  if (suffix == ".obj") {
    add(file, solid::write_obj(result.bodies, comment_of(result.model)));
    return;
  }
  const mesh::Surface model = mesh::surface_in_file_numbers(result.model);
  const solid::RigidBody body = rigid_body(job, model, result, context);
  if (!has_companions(suffix)) {
    const auto write = suffix == ".glb" ? solid::write_glb : solid::write_usd;
    add(file, write(body, solid::body_of(model), result.bodies));
    return;
  }
  const auto write = suffix == ".urdf"  ? solid::write_urdf
                     : suffix == ".sdf" ? solid::write_sdf
                                        : solid::write_mjcf;
  add(file, write(body));
  add(body.visual_file, mesh_bytes(model, ".obj", body.comment));
  for (std::size_t i = 0; i < result.bodies.size(); ++i) {
    add(body.mesh_files[i], solid::write_obj({result.bodies[i]}, body.comment));
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
  SolidResult result = begin(job, hull_suffixes(),
                             "hulls are written as .obj, .urdf, .xml (MJCF), .sdf, .usda or .glb", context);
  const bool companions = has_companions(suffix_of(job.output));
  if (companions) {
    require_companions_replaceable(job, result.model.digest);
  }
  const segment::Segmentation parts = find_parts_of(shown_name(job.model), job.parts, context, result);
  solid::HullSet set = result.clock(
      "hulls", context, [&] { return solid::model_hulls(result.model.surface, parts, job.limits, context); });
  result.bodies = std::move(set.bodies);
  result.fit = set.fit;
  result.notes = notes_of(set.fit);
  if (!set.of_cuts && result.bodies.size() == parts.parts.size() && !job.parts.options.pockets) {
    if (const std::size_t closed = count_closed_openings(result.model.surface, parts, result.bodies);
        closed > 0) {
      result.notes.push_back(Message("hulls_close_openings", {{"n", closed}}));
    }
  }
  result.clock("write", context, [&] {
    to_file_numbers(result.bodies, result.model.file_scale);
    add_hulls(job, context, result, pending);
    context.check();
    commit(job.overwrite, pending, result,
           [&] { return companions ? find_leftovers(job, result) : std::vector<fs::path>(); });
    return true;
  });
  return result;
}

SolidResult make_cage(const CageJob& job, const Context& context, PendingFiles& pending) {
  SolidResult result = begin(job, mesh_suffixes, mesh_formats, context);
  const segment::Segmentation parts = find_parts_of(shown_name(job.model), job.parts, context, result);
  const std::vector<solid::Body> hulls = result.clock(
      "hulls", context, [&] { return solid::part_hulls(result.model.surface, parts, {}, context); });
  result.bodies = {
      result.clock("cage", context, [&] { return solid::cage(hulls, {.faces = job.faces}, context); })};
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
