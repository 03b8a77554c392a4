// SPDX-License-Identifier: GPL-3.0-or-later
// Colours and pictures that a file gives face by face (PLY, OFF) become materials, one for each that is
// different.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesh/reading/find_picture.hpp"
#include "mesh/reading/source.hpp"

namespace ridgecraft::mesh {

class FacePaint {
 public:
  /// Paint of the soup's last polygon. Channels outside [0, 1] are brought into it; NaN is 1. `picture` is an
  /// index into what the file calls its pictures, or Soup::none.
  void add(Soup& soup, std::optional<Colour> colour, std::uint32_t picture);
  /// Polygons after the last painted one have none. `pictures` are the files, empty for those that can't
  /// be used.
  void finish(Soup& soup, const std::vector<PictureFinder::Found>& pictures) const;

 private:
  using Key = std::pair<std::optional<Colour>, std::uint32_t>;

  std::map<Key, std::uint32_t> number_;
};

}  // namespace ridgecraft::mesh
