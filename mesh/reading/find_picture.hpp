// SPDX-License-Identifier: GPL-3.0-or-later
// The texture pictures that the materials of a model name.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "mesh/reading/source.hpp"

namespace ridgecraft::mesh {

/// Looks for each picture once and remarks once on each that can't be used.
class PictureFinder {
 public:
  PictureFinder(const Source& source, RepairReport& remarks) : source_(source), remarks_(remarks) {}

  /// The picture that a file in `folder` calls `name`: its path relative to the source's folder (absolute
  /// where there is no such path); empty where it is missing or can't be used.
  [[nodiscard]] std::string find(const std::filesystem::path& folder, std::string_view name);

 private:
  [[nodiscard]] std::string fault(const std::filesystem::path& file) const;

  const Source& source_;
  RepairReport& remarks_;
  std::map<std::string, std::string> found_;
};

}  // namespace ridgecraft::mesh
