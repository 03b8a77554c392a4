// SPDX-License-Identifier: GPL-3.0-or-later
// What the program writes for a model, to be checked and to be broken.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "support/temporary_folder.hpp"
#include "verify/verify.hpp"

namespace ridgecraft::test {

/// Nets and pages of one model.
struct WrittenJob {
  explicit WrittenJob(const std::filesystem::path& model, const std::vector<std::string>& options = {});

  /// The pages of either format.
  [[nodiscard]] const std::vector<verify::PrintedFile>& pages(bool of_pdf) const {
    return of_pdf ? pdf : svg;
  }

  TemporaryFolder folder;  ///< where the files lie, under the model's name
  std::string name;
  std::string fold;
  std::vector<verify::PrintedFile> svg;         ///< one for each page
  std::vector<verify::PrintedFile> svg_of_all;  ///< one, where there are several pages
  std::vector<verify::PrintedFile> pdf;         ///< one
};

/// A whale of 180 mm on two pages, with folds of both kinds; made once for all tests.
[[nodiscard]] const WrittenJob& whale();

/// A sample of the repository.
[[nodiscard]] std::filesystem::path sample(const std::string& name);

/// The points and faces of a model's file, as the program reads it.
[[nodiscard]] verify::ModelSurface surface_of(const std::filesystem::path& model);

/// Checks nets beside what is printed and beside the model.
[[nodiscard]] verify::Report verify_pages(const std::string& fold,
                                          const std::vector<verify::PrintedFile>& pages);
[[nodiscard]] verify::Report verify_model(const std::string& fold, const verify::ModelSurface& surface);

/// The message of the first fault, or nothing.
[[nodiscard]] std::string first_fault(const verify::Report& report);

}  // namespace ridgecraft::test
