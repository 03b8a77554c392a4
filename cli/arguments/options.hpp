// SPDX-License-Identifier: GPL-3.0-or-later
// The command line as values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "cli/files/input_files.hpp"
#include "export/export.hpp"
#include "job/options.hpp"
#include "segment/segment.hpp"
#include "solid/solid.hpp"

namespace ridgecraft::cli {

/// What every verb takes.
struct CommonOptions {
  bool json = false;
  bool quiet = false;
  bool verbose = false;
  std::uint64_t seed = 1;
  unsigned threads = 1;
  std::optional<double> time_limit_s;
};

/// How a user asked for the size.
struct SizeRequest {
  std::string words;          ///< "--size 150mm"
  bool unit_assumed = false;  ///< --size was a number alone
  /// The factor of --scale without --unit: it is the file's unit that counts, where the file tells it.
  std::optional<double> scale = {};
};

/// ridgecraft MODEL
struct MakeJob {
  CommonOptions common;
  std::string model;
  std::vector<std::string> outputs;  ///< empty: all default formats in the current folder
  bool overwrite = false;
  bool page = true;  ///< a page for browsers is among the default formats
  SizeRequest size_asked;
  std::string paper_name = "A4";
  std::uint64_t most_pages = 300;  ///< a model that is expected to take more is refused
  /// What comes out on the user's machine where 100 mm are drawn, across and up the sheet.
  std::optional<Vec2> calibration;
  export_::Preset preset = {};  ///< of a machine, or none: a printer; with what options changed of it
  bool kerf_test = false;
  bool print_and_cut = false;  ///< a PDF to be printed first, with marks by which the machine finds its way
  export_::SpotNames spots;
  job::Options options;  ///< but for the edges that these name:
  EdgeArguments edges;
  std::string tab_file;  ///< tabs edge by edge; empty: none
  /// The options about paper as they were typed, "--size=20cm"; files that they name without their folders.
  std::vector<std::string> words;
  std::string edits;    ///< what was done by hand, a step a line (session/edit.hpp)
  std::string project;  ///< the file that model, options and edits come from; empty: none

  /// What the user named.
  [[nodiscard]] const std::string& input() const { return project.empty() ? model : project; }
};

struct InfoJob {
  CommonOptions common;
  std::string model;
};

/// How a model is divided into nearly convex parts.
struct PartArguments {
  segment::Options options;
  std::optional<double> concavity_mm;  ///< in place of the options'
  std::size_t count = 0;               ///< of parts; 0: as many as the concavity asks for
};

struct SegmentJob {
  CommonOptions common;
  std::string model;
  PartArguments parts;
  std::string hierarchy;             ///< FILE.json; empty: none
  std::string labels;                ///< FILE.seg; empty: none
  std::vector<std::string> outputs;  ///< coloured PLY or OFF
  std::vector<std::string> compare;  ///< label files of others
  bool overwrite = false;
};

struct UnfoldJob {
  CommonOptions common;
  std::string model;
  SizeRequest size_asked;
  job::Options options;  ///< without paper, and but for the edges that these name:
  EdgeArguments edges;
  std::string output;  ///< FILE.fold; empty: none
  bool overwrite = false;
};

struct HullsJob {
  CommonOptions common;
  std::string model;
  std::string output;  ///< its suffix says the format: hull_suffixes()
  bool overwrite = false;
  PartArguments parts;
  solid::HullOptions limits;
  std::optional<double> mm_per_unit;  ///< --unit, for formats in metres
  double density = 1000.0;            ///< kg/m^3
};

struct CageJob {
  CommonOptions common;
  std::string model;
  std::string output;
  bool overwrite = false;
  PartArguments parts;
  std::size_t faces = 500;
};

struct ShellJob {
  CommonOptions common;
  std::string model;
  std::string output;
  bool overwrite = false;
  double opening = 0.05;  ///< shares of the model's diagonal
  double offset = 0.002;
};

struct DeformJob {
  CommonOptions common;
  std::string model;
  std::string cage;
  std::string to;
  std::string output;
  bool overwrite = false;
};

struct VerifyJob {
  CommonOptions common;
  std::string file;
  std::string model;               ///< what the nets were made from; empty: not compared
  std::vector<std::string> pages;  ///< PDF and SVG files
};

struct StudioJob {
  std::string model;               ///< empty: a page that waits for one
  std::vector<std::string> words;  ///< options of the main job, as they were typed
  bool no_browser = false;
};

struct FormatsJob {
  CommonOptions common;
  bool presets = false;  ///< the table of presets alone
};

/// One verb for many models.
struct BatchJob {
  CommonOptions common;
  std::string verb;                ///< "hulls", "segment", "unfold", "paper" or "info"
  std::string input;               ///< a folder, a list, a model, or - for a list on standard input
  std::vector<std::string> words;  ///< options of the verb, as they were typed
  std::string output;              ///< folder
  std::string suffix;              ///< of the results: their format; empty for info
  std::string report;              ///< empty: in the output folder
  unsigned jobs = 1;
  std::size_t shard = 1;  ///< 1 ... shards: of the models every `shards`th from here
  std::size_t shards = 1;
  std::optional<double> seconds;   ///< a model
  std::uint64_t memory_bytes = 0;  ///< a model; 0: no limit
  bool resume = false;
  bool overwrite = false;
};

/// Text to print, and then the program ends: --help, --version, the man page.
struct PrintJob {
  std::string text;
};

using Job = std::variant<MakeJob, InfoJob, SegmentJob, UnfoldJob, HullsJob, CageJob, ShellJob, DeformJob,
                         VerifyJob, StudioJob, FormatsJob, BatchJob, PrintJob>;

}  // namespace ridgecraft::cli
