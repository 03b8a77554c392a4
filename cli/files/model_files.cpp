// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/files/model_files.hpp"

#include "base/context.hpp"
#include "base/error.hpp"
#include "cli/files/input_files.hpp"
#include "mesh/reading/read_soup.hpp"

namespace ridgecraft::cli {

std::vector<std::filesystem::path> files_of_model(const std::filesystem::path& model) {
  try {
    const mesh::Soup soup = mesh::read_soup(model, Context(), importer_program());
    return {soup.files_beside.begin(), soup.files_beside.end()};
  } catch (const Error&) {
    return {};  // whoever opens it is told why
  }
}

}  // namespace ridgecraft::cli
