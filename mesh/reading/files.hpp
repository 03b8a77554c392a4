// SPDX-License-Identifier: GPL-3.0-or-later
// The bytes of a file, and the files that a model names: its parts, its texture pictures.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesh/reading/source.hpp"

namespace ridgecraft::mesh {

// The bytes of a file, whatever is in it.

/// Larger files are refused before they are read (4 GiB): no paper model is near it.
inline constexpr std::uint64_t largest_file_size = std::uint64_t{1} << 32U;

/// All bytes of a regular file. Folders, pipes and devices are refused, so it never waits for input. Throws
/// Error(unreadable_input).
[[nodiscard]] std::string read_file(const std::filesystem::path& file);

// Files that a model names: found although names were written on another system.

/// The regular file that `name` in a file of `folder` means: tried as it is, with backslashes as slashes, by
/// its last part alone (paths of the computer it was made on), and all that in letters of either case.
/// Nothing where none is there.
[[nodiscard]] std::optional<std::filesystem::path> find_beside(const std::filesystem::path& folder,
                                                               std::string_view name);

// Files that a model needs for its shape: only those that lie in its own folder or below are opened.

/// What a name in a model leads to: a file, or why there is none ("was not found").
struct FoundInside {
  std::filesystem::path file;  ///< empty where there is none
  std::string why;             ///< a half sentence about the name
};

/// Whether a file that is there lies in the folder or below, links followed.
[[nodiscard]] bool lies_inside(const std::filesystem::path& folder, const std::filesystem::path& file);

/// The regular file in `folder` or below that a relative address means: as it is written, with its percent
/// signs resolved, with backslashes as slashes. Addresses of the network, absolute ones, and those that lead
/// out of the folder (links included) are none.
[[nodiscard]] FoundInside find_inside(const std::filesystem::path& folder, std::string_view address);

// Whether a texture can be used: looked at from outside, without decoding it.

/// Empty for a picture in a format that is read (mesh/look/picture.hpp) that is there to its end as far as
/// that is quickly seen; otherwise what is wrong with it, as "is empty".
[[nodiscard]] std::string picture_fault(std::string_view bytes);

// The texture pictures that the materials of a model name.

/// Looks for each picture once and remarks once on each that can't be used.
class PictureFinder {
 public:
  struct Found {
    std::string file;                          ///< as Material::texture_file
    std::shared_ptr<const std::string> bytes;  ///< as Material::picture
  };

  PictureFinder(const Source& source, RepairReport& remarks) : source_(source), remarks_(remarks) {}

  /// The picture that a file in `folder` calls `name`, at that place or, by the last part of its name, beside
  /// the model, in a folder there that is called textures, texture, tex, images or maps, or in such a one
  /// beside a folder called source, as Sketchfab packs them. Where that is none, or in a format that isn't
  /// read, one of the same name but for the suffix. Nothing where it is missing or can't be used.
  [[nodiscard]] Found find(const std::filesystem::path& folder, std::string_view name);

 private:
  [[nodiscard]] std::vector<std::filesystem::path> places_of(const std::filesystem::path& folder,
                                                             std::string_view name);
  [[nodiscard]] std::vector<std::filesystem::path> copies_of(std::string_view name);
  [[nodiscard]] const std::vector<std::filesystem::path>& texture_folders();
  [[nodiscard]] bool is_allowed(const std::filesystem::path& file);
  [[nodiscard]] std::string load(const std::filesystem::path& file, Found& into) const;

  const Source& source_;
  RepairReport& remarks_;
  std::map<std::string, Found> found_;                                 ///< by the names
  std::optional<std::vector<std::filesystem::path>> texture_folders_;  ///< that there are
};

// Colours and pictures that a file gives face by face (PLY, OFF) become materials, one for each that is
// different.

class FacePaint {
 public:
  /// Paint of the soup's last polygon. The colour is brought in_range(). `picture` is an
  /// index into what the file calls its pictures, or Soup::none.
  void add(Soup& soup, std::optional<Colour> colour, std::uint32_t picture);
  /// `pictures` are the files, empty for those that can't
  /// be used.
  void finish(Soup& soup, const std::vector<PictureFinder::Found>& pictures) const;

 private:
  using Key = std::pair<std::optional<Colour>, std::uint32_t>;

  std::map<Key, std::uint32_t> number_;
};

}  // namespace ridgecraft::mesh
