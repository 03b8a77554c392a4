// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/imported/read_stream.hpp"
#include "mesh/reading/imported/run_importer.hpp"
#include "mesh/reading/readers.hpp"

namespace ridgecraft::mesh {

Soup read_imported(FileFormat format, const Source& source) {
  return read_stream(run_importer(format, source), format, source);
}

}  // namespace ridgecraft::mesh
