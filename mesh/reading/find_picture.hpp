// SPDX-License-Identifier: GPL-3.0-or-later
// The texture pictures that the materials of a model name.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "mesh/reading/source.hpp"

namespace ridgecraft::mesh {

/// Looks for each picture once and remarks once on each that can't be used.
class PictureFinder {
 public:
  struct Found {
    std::string file;                          ///< as Material::texture_file
    std::shared_ptr<const std::string> bytes;  ///< as Material::picture
  };

  PictureFinder(const Source& source, RepairReport& remarks) : source_(source), remarks_(remarks) {}

  /// The picture that a file in `folder` calls `name`. It has to lie in the source's folder or below. Nothing
  /// where it is missing or can't be used.
  [[nodiscard]] Found find(const std::filesystem::path& folder, std::string_view name);

 private:
  [[nodiscard]] std::optional<std::filesystem::path> file_of(const std::filesystem::path& folder,
                                                             std::string_view name) const;
  [[nodiscard]] std::string load(const std::filesystem::path& file, Found& into) const;

  const Source& source_;
  RepairReport& remarks_;
  std::map<std::string, Found> found_;
};

}  // namespace ridgecraft::mesh
