// SPDX-License-Identifier: GPL-3.0-or-later
// From a file to a repaired model.
#include <string>
#include <utility>

#include "base/digest.hpp"
#include "base/error.hpp"
#include "base/printable.hpp"
#include "mesh/mesh.hpp"
#include "mesh/reading/read_soup.hpp"
#include "mesh/repair/repair.hpp"

namespace ridgecraft::mesh {

Model read(const std::filesystem::path& file, const ReadOptions& options, const Context& context) {
  context.report("reading", 0.0);
  const std::string bytes = read_file(file);
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  Soup soup = parse_soup(bytes, file.string(), folder, context);
  context.report("repairing", 0.0);
  try {
    Model model = repair(std::move(soup), options, context);
    model.name = printable(file.stem().string());
    model.digest = digest(bytes);
    return model;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::unusable_mesh) {
      throw;
    }
    throw Error(ErrorKind::unusable_mesh, printable(file.string()) + " can't be used: " + error.what());
  }
}

}  // namespace ridgecraft::mesh
