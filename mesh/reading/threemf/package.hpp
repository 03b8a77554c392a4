// SPDX-License-Identifier: GPL-3.0-or-later
// A 3MF file as a package of parts (Open Packaging Conventions), and the XML in them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <pugixml.hpp>

#include "mesh/reading/zip_archive.hpp"

namespace ridgecraft::mesh {

/// The part of an XML name after its prefix: "color" of "m:color".
[[nodiscard]] std::string_view local_name(std::string_view name);

/// The attribute of this name, with or without a prefix; empty where there is none.
[[nodiscard]] std::string_view attribute(pugi::xml_node node, std::string_view name);

/// A part's name as messages and lists have it: without the slash at its start.
[[nodiscard]] std::string part_name(std::string_view name);

class ThreemfPackage {
 public:
  explicit ThreemfPackage(const Source& source);

  /// The part that the package begins with.
  [[nodiscard]] const std::string& root() const { return root_; }
  /// The XML of a part. Refuses what is no XML, and what would take more memory than is reasonable.
  [[nodiscard]] pugi::xml_document xml(const std::string& part);
  [[nodiscard]] bool has(const std::string& part) const { return archive_.has(part); }
  /// The bytes of a part that is no XML.
  [[nodiscard]] std::string bytes(const std::string& part);
  [[nodiscard]] std::uint64_t unpacked() const { return archive_.unpacked(); }

 private:
  [[nodiscard]] std::string find_root();

  const Source& source_;
  ZipArchive archive_;
  std::string root_;
};

}  // namespace ridgecraft::mesh
