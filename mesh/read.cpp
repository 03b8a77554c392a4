// SPDX-License-Identifier: GPL-3.0-or-later
// From a file to a repaired model.
#include <string>
#include <utility>

#include "base/digest.hpp"
#include "base/error.hpp"
#include "base/printable.hpp"
#include "mesh/mesh.hpp"
#include "mesh/reading/read_file.hpp"
#include "mesh/reading/read_soup.hpp"
#include "mesh/repair/repair.hpp"

namespace ridgecraft::mesh {

Model read(const std::filesystem::path& file, const ReadOptions& options, const Context& context) {
  context.report("reading", 0.0);
  return read(ModelFile{.bytes = read_file(file),
                        .name = file.string(),
                        .title = file.stem().string(),
                        .folder = file.has_parent_path() ? file.parent_path() : "."},
              options, context);
}

Model read(const ModelFile& file, const ReadOptions& options, const Context& context) {
  context.report("reading", 0.0);
  Soup soup = parse_soup(file.bytes, file.name, file.folder, context, options.importer);
  context.report("repairing", 0.0);
  const std::string beside = std::move(soup.beside_digest);
  try {
    Model model = repair(std::move(soup), options, context);
    model.name = printable(file.title);
    model.digest = digest(file.bytes);
    if (!beside.empty()) {
      model.digest = digest(model.digest + beside);
    }
    return model;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::unusable_mesh) {
      throw;
    }
    const std::string name = printable(file.name);
    throw Error(ErrorKind::unusable_mesh, name + " can't be used: " + error.what(), name);
  }
}

}  // namespace ridgecraft::mesh
