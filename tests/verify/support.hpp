// SPDX-License-Identifier: GPL-3.0-or-later
// What tests of verification check and break: a cube written by hand, loose polygons, and what the program
// writes for a model.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "base/vector.hpp"
#include "support/temporary_folder.hpp"
#include "verify/verify.hpp"

namespace ridgecraft::test {

/// A cube of 40 mm as a cross of six squares on one A4 page: 5 folds, 7 joins, each with a tab 6 mm high.
[[nodiscard]] nlohmann::json cube_file();

/// Polygons that touch nothing, each a piece and a model component of its own, all on one unbounded page. The
/// model is the same figures, lying in one plane far apart.
[[nodiscard]] nlohmann::json loose_file(const std::vector<std::vector<Vec2>>& polygons);

/// The number of the promise that what a file says of itself is so, as broken() tells it.
inline constexpr int statement_promise = 8;

[[nodiscard]] verify::Report verify_json(const nlohmann::json& json);
/// The promises of which faults are listed, each once, in order.
[[nodiscard]] std::vector<int> broken(const verify::Report& report);
[[nodiscard]] std::vector<int> broken(const nlohmann::json& json);

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

/// Checks nets against what is printed, and against the model.
[[nodiscard]] verify::Report verify_pages(const std::string& fold,
                                          const std::vector<verify::PrintedFile>& pages);
[[nodiscard]] verify::Report verify_model(const std::string& fold, const verify::ModelSurface& surface);

/// The message of the first fault, or nothing.
[[nodiscard]] std::string first_fault(const verify::Report& report);

/// The text with another in the first place of one that it must hold.
[[nodiscard]] inline std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace ridgecraft::test
