// SPDX-License-Identifier: GPL-3.0-or-later
// The formats that are read and written, in one table: what `ridgecraft formats` prints, and what a file's
// suffix after -o means.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "export/export.hpp"

namespace ridgecraft::cli {

/// What the main job writes.
enum class Format { pdf, svg, fold, html, project, png, dxf, lbrn, eps, plt };

/// The main job's format with this suffix (lower case, with its dot); none where it writes no such files.
[[nodiscard]] std::optional<Format> paper_format(std::string_view suffix);

/// ".pdf"
[[nodiscard]] const char* suffix(Format format);

/// PDF, FOLD and HTML hold all pages, the others one each.
[[nodiscard]] bool one_file_per_page(Format format);

/// What a folder after -o gets, and what is written without -o: for a printer, or for a machine.
[[nodiscard]] std::vector<Format> default_formats(const export_::Preset& preset = {});

/// Whether files of this format hold what machines do, whatever the preset: DXF and others.
[[nodiscard]] bool for_machines_alone(Format format);

/// ".pdf, .svg, .fold, .html, .png, ... and .plt", for a sentence.
[[nodiscard]] std::string paper_suffixes();

/// The suffix in lower case, with its dot.
[[nodiscard]] std::string suffix_of(const std::filesystem::path& file);

/// What ridgecraft hulls writes.
[[nodiscard]] std::vector<std::string> hull_suffixes();

/// A format of any verb: ".obj", and what it is.
struct FormatRow {
  const char* suffix;
  const char* what;
};
[[nodiscard]] std::vector<FormatRow> read_formats();
[[nodiscard]] std::vector<FormatRow> written_formats();

}  // namespace ridgecraft::cli
