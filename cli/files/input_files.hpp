// SPDX-License-Identifier: GPL-3.0-or-later
// The MODEL of a command line: a file, or "-" for what comes through standard input.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/files/targets.hpp"
#include "job/options.hpp"
#include "mesh/mesh.hpp"
#include "mesh/model/model.hpp"
#include "unfold/net/options.hpp"

namespace ridgecraft::cli {

/// ridgecraft-import beside the running program, or in ../libexec/ridgecraft from there; empty where it isn't
/// installed.
[[nodiscard]] std::filesystem::path importer_program();

/// What sentences call it: "whale.obj", "standard input".
[[nodiscard]] std::string shown_name(const std::string& model);

/// What results without a name of their own are named after: "whale"; "model" for standard input.
[[nodiscard]] std::string results_name(const std::string& model);

/// mesh::read() of either. Nothing lies beside standard input: materials of a model from there are names
/// only. A folder, a terminal, a device, or nothing at all behind standard input throws
/// Error(unreadable_input).
[[nodiscard]] mesh::Model read_model(const std::string& model, const mesh::ReadOptions& options,
                                     const Context& context);

// Files by which a user asks for edges and tabs: pairs of points, nets made before, and tabs.

/// Files that name edges to be cut or kept; empty: none.
struct EdgeArguments {
  std::string cuts;  ///< pairs of points
  std::string keep;
  std::string from;  ///< nets made before

  [[nodiscard]] bool any() const { return !cuts.empty() || !keep.empty() || !from.empty(); }
};

/// A file that was asked for, read whole: it may be a pipe, and its digest is a setting.
struct EdgeFile {
  std::string name;
  std::string bytes;
};
struct EdgeFiles {
  std::optional<EdgeFile> cuts, keep, from;
};
/// Reads what was asked for, before the long work. Throws Error(unreadable_input).
[[nodiscard]] EdgeFiles read_edge_files(const EdgeArguments& edges);

/// Their names, so that no result replaces them.
[[nodiscard]] std::vector<InputFile> input_files(const EdgeArguments& edges);

/// What they ask of this model, which was read with its points kept. Files of pairs have two numbers a line,
/// counted as the format of the model's file does; empty lines and what follows a # say nothing. Throws
/// Error(unreadable_input) for a line that names no two points.
[[nodiscard]] job::EdgeRequests requests_of(const EdgeFiles& files, const mesh::Model& model);

/// One edge a line: its number, then in any order "none", "both", "height=7mm", "angle=60" and the name of
/// the piece that the tab has to grow from. Empty lines and what follows a # say nothing. `name` is the
/// file's, for messages. Throws Error(unreadable_input), which tells the line.
[[nodiscard]] std::vector<unfold::EdgeTab> read_tab_file(const std::string& name, std::string_view bytes);

}  // namespace ridgecraft::cli
