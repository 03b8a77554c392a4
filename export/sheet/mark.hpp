// SPDX-License-Identifier: GPL-3.0-or-later
// The mark in every file that this program writes: by which program, and from which model. It decides whether
// a later run may replace the file without being asked.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace ridgecraft::export_ {

/// Options that shaped a result; values are JSON texts (numbers, strings in quotes).
using Settings = std::map<std::string, std::string>;
/// The same as one JSON object in one line.
[[nodiscard]] std::string settings_json(const Settings& settings);

/// What every file says about itself.
struct Mark {
  std::string producer;     ///< program and version
  std::string title;        ///< the model's name
  std::string digest;       ///< mesh::Model::digest
  Settings settings = {};   ///< FOLD, PDF, HTML and the SVG of a printed page tell them
  std::string preset = {};  ///< of the machine that the file is for; PDF tells it as its subject
};

/// JSON (FOLD and others) has the digest as the value of this top-level key.
inline constexpr std::string_view mark_key = "ridgecraft:model_digest";

/// The one word that carries the digest elsewhere: "ridgecraft-model:" and the digest. It stands in PDF
/// (Keywords of the Info dictionary, not compressed), SVG (text of the element `metadata`), PNG (text of a
/// tEXt chunk before the pixels), PLY and OFF (a comment near the top), OBJ (a comment, the first line),
/// URDF, MJCF, SDFormat and LightBurn projects (a comment before their first element), USD (its doc), GLB
/// (its generator), DXF (a comment at the top), EPS (a comment named Keywords), HPGL (a comment at the end)
/// and HTML (an element `meta` at the top of its head).
[[nodiscard]] std::string mark_word(const Mark& mark);

/// The mark of a file that this program made (any of its formats), or nothing if another program did. Reads
/// any bytes. O(size).
[[nodiscard]] std::string read_mark_digest(std::string_view bytes);

}  // namespace ridgecraft::export_
