// SPDX-License-Identifier: GPL-3.0-or-later
// How pieces fold:
//
//   bench_folding [--faces N] [--linear] [--json FILE] MODEL...
//
// Each model goes through a whole job at default options, simplified to N faces (500; 0: as a job does by
// default), --linear with --fold-linear. Of its pieces: how many fold up with all creases together, how many
// crease by crease in some order, how many need care because no order was found; and what that cost: length
// of the seams, of those without a tab, and seconds of unfolding. Each way to fold that the job tells is
// looked at again, all faces compared in every sample. One thread.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "job/job.hpp"
#include "mesh/mesh.hpp"
#include "unfold/folding/fold_motion.hpp"
#include "unfold/folding/fold_order.hpp"

using namespace ridgecraft;

namespace {

struct Settings {
  std::size_t faces = 500;
  bool linear = false;
  std::string json;
  std::vector<std::string> models;
};

struct Row {
  std::string name;
  std::size_t pieces = 0, together = 0, in_order = 0, with_care = 0;
  std::size_t wrong = 0;  ///< pieces that run through themselves in the way that the job tells
  double seam_m = 0.0, bare_m = 0.0;
  std::size_t tabs = 0, joins = 0;
  double seconds = 0.0;  ///< of unfolding
};

std::vector<std::pair<std::uint32_t, std::uint32_t>> meetings(const unfold::FoldMotion& motion,
                                                              const std::vector<double>& share) {
  unfold::FoldMotion::Pose pose;
  motion.pose(share, pose);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
  std::vector<unfold::Corners> rest(pose.corners.size());
  std::vector<bool> left;
  for (std::size_t f = 0; f < rest.size(); ++f) {
    left.push_back(unfold::without_seam(pose.corners[f], rest[f]));
  }
  for (std::uint32_t f = 0; f < rest.size(); ++f) {
    for (std::uint32_t g = f + 1; left[f] && g < rest.size(); ++g) {
      const std::uint32_t p = motion.plate(f);
      const std::uint32_t q = motion.plate(g);
      if (left[g] && p != q && !motion.hinged(p, q) && unfold::meet(rest[f], rest[g])) {
        found.emplace_back(f, g);
      }
    }
  }
  return found;
}

/// Whether the piece runs through itself in its steps.
bool runs_through_itself(const mesh::Surface& surface, const unfold::Nets& nets, PieceId piece) {
  const unfold::FoldMotion motion(unfold::flat_piece(surface, nets, piece));
  const auto& creases = motion.creases();
  const auto& faces = nets.pieces[piece].faces;
  std::vector<double> share(creases.size(), 1.0);
  const auto always = meetings(motion, share);
  std::fill(share.begin(), share.end(), 0.0);
  for (const auto& step : nets.pieces[piece].folding.steps) {
    std::vector<std::size_t> moved;
    for (std::size_t c = 0; c < creases.size(); ++c) {
      const std::uint32_t side = creases[c].sides.front();
      if (std::find(step.begin(), step.end(), mesh::corner(faces[side / 3], side % 3)) != step.end()) {
        moved.push_back(c);
      }
    }
    for (int sample = 1; sample <= unfold::samples_of_motion; ++sample) {
      for (const std::size_t c : moved) {
        share[c] = static_cast<double>(sample) / unfold::samples_of_motion;
      }
      for (const auto& pair : meetings(motion, share)) {
        if (!std::binary_search(always.begin(), always.end(), pair)) {
          return true;
        }
      }
    }
  }
  return false;
}

Row run(const std::string& file, const Settings& settings) {
  job::Options options;
  options.pieces = unfold::rules_of(unfold::PieceMode::parts);
  options.pieces.fold_linear = settings.linear;
  if (settings.faces > 0) {
    options.simplify.mode = prepare::Simplification::count;
    options.simplify.faces = settings.faces;
  }
  const job::Paper made = job::paper(mesh::read(file, {}, {}), options, {});
  Row row;
  row.name = std::filesystem::path(file).stem().string();
  for (const auto& [stage, seconds] : made.seconds) {
    row.seconds += stage == "unfold" ? seconds : 0.0;
  }
  const mesh::Surface& surface = made.prepared.model.surface;
  for (const PieceId p : ids<PieceId>(made.nets.pieces.size())) {
    const unfold::FoldWay way = made.nets.pieces[p].folding.way;
    ++row.pieces;
    row.together += way == unfold::FoldWay::together ? 1U : 0U;
    row.with_care += way == unfold::FoldWay::with_care ? 1U : 0U;
    row.wrong += way != unfold::FoldWay::with_care && runs_through_itself(surface, made.nets, p) ? 1U : 0U;
  }
  row.in_order = row.pieces - row.together - row.with_care;
  row.tabs = made.nets.tabs.size();
  row.joins = made.nets.joins.size();
  for (const unfold::Join& join : made.nets.joins) {
    const double metres = surface.length(join.edge) / 1000.0;
    row.seam_m += metres;
    row.bare_m += join.tab.valid() ? 0.0 : metres;
  }
  return row;
}

Row sum_of(const std::vector<Row>& rows) {
  Row sum;
  sum.name = "all";
  for (const Row& r : rows) {
    sum.pieces += r.pieces;
    sum.together += r.together;
    sum.in_order += r.in_order;
    sum.with_care += r.with_care;
    sum.wrong += r.wrong;
    sum.seam_m += r.seam_m;
    sum.bare_m += r.bare_m;
    sum.tabs += r.tabs;
    sum.joins += r.joins;
    sum.seconds += r.seconds;
  }
  return sum;
}

double share_together(const Row& row) {
  return static_cast<double>(row.together) / static_cast<double>(std::max<std::size_t>(row.pieces, 1));
}

void print(const Row& r) {
  fmt::print("{:<16} {:>6} {:>8} {:>6.1f} % {:>8} {:>9} {:>6} {:>8.3f} {:>8.3f} {:>5} {:>6} {:>8.3f}\n",
             r.name, r.pieces, r.together, 100.0 * share_together(r), r.in_order, r.with_care, r.wrong,
             r.seam_m, r.bare_m, r.tabs, r.joins, r.seconds);
  std::fflush(stdout);
}

std::string json_of(const Row& r) {
  return fmt::format(
      "{{\"model\":\"{}\",\"pieces\":{},\"together\":{},\"share_together\":{:.4f},\"in_order\":{},"
      "\"with_care\":{},\"wrong\":{},\"seam_m\":{:.6f},\"bare_m\":{:.6f},\"tabs\":{},\"joins\":{},"
      "\"unfold_s\":{:.4f}}}\n",
      r.name, r.pieces, r.together, share_together(r), r.in_order, r.with_care, r.wrong, r.seam_m, r.bare_m,
      r.tabs, r.joins, r.seconds);
}

Settings settings_of(int count, char** words) {
  Settings settings;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    if (word == "--linear") {
      settings.linear = true;
    } else if (word == "--faces" && i + 1 < count) {
      settings.faces = std::stoul(words[++i]);
    } else if (word == "--json" && i + 1 < count) {
      settings.json = words[++i];
    } else {
      settings.models.push_back(word);
    }
  }
  return settings;
}

}  // namespace

int main(int count, char** words) try {
  const Settings settings = settings_of(count, words);
  fmt::print("{:<16} {:>6} {:>8} {:>8} {:>8} {:>9} {:>6} {:>8} {:>8} {:>5} {:>6} {:>8}\n", "model", "pieces",
             "together", "share", "in order", "with care", "wrong", "seam m", "bare m", "tabs", "joins",
             "unfold s");
  std::vector<Row> rows;
  for (const std::string& model : settings.models) {
    rows.push_back(run(model, settings));
    print(rows.back());
  }
  rows.push_back(sum_of(rows));
  print(rows.back());
  if (!settings.json.empty()) {
    std::ofstream out(settings.json);
    for (const Row& row : rows) {
      out << json_of(row);
    }
  }
  return rows.back().wrong == 0 ? 0 : 1;
} catch (const std::exception& error) {
  fmt::print(stderr, "bench_folding: {}\n", error.what());
  return 1;
}
