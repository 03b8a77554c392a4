// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/written_job.hpp"

#include <utility>

#include <catch2/catch.hpp>

#include "mesh/mesh.hpp"
#include "support/program.hpp"

namespace ridgecraft::test {

namespace fs = std::filesystem;

WrittenJob::WrittenJob(const fs::path& model, const std::vector<std::string>& options)
    : name(model.stem().string()) {
  std::vector<std::string> arguments{model.string(), "-o", folder.path().string(), "-q"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const Outcome outcome = run_program(arguments);
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  fold = read_bytes(folder / (name + ".fold"));
  pdf.push_back(verify::read_pdf(name + ".pdf", read_bytes(folder / (name + ".pdf"))));
  for (const std::string& file : folder.names()) {
    if (file.ends_with(".svg")) {
      verify::PrintedFile read = verify::read_svg(file, read_bytes(folder / file));
      (read.whole ? svg_of_all : svg).push_back(std::move(read));
    }
  }
}

const WrittenJob& whale() {
  static const WrittenJob job(sample("whale.obj"), {"--size", "180mm"});
  return job;
}

fs::path sample(const std::string& name) {
  return fs::path(RIDGECRAFT_SOURCE_DIR) / "samples" / name;
}

verify::ModelSurface surface_of(const fs::path& model) {
  const mesh::Model read = mesh::read(model, {}, {});
  verify::ModelSurface surface;
  surface.points.assign(read.surface.points().begin(), read.surface.points().end());
  for (const FaceId f : ids<FaceId>(read.surface.face_count())) {
    const auto [a, b, c] = read.surface.vertices(f);
    surface.faces.push_back({a.value(), b.value(), c.value()});
  }
  surface.units_per_point_unit = read.file_scale;
  surface.digest = read.digest;
  return surface;
}

verify::Report verify_pages(const std::string& fold, const std::vector<verify::PrintedFile>& pages) {
  return verify::verify(fold, {}, {}, {nullptr, pages});
}

verify::Report verify_model(const std::string& fold, const verify::ModelSurface& surface) {
  return verify::verify(fold, {}, {}, {&surface, {}});
}

std::string first_fault(const verify::Report& report) {
  return report.faults.empty() ? std::string() : report.faults.front().message;
}

}  // namespace ridgecraft::test
