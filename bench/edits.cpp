// SPDX-License-Identifier: GPL-3.0-or-later
// What edits by hand cost, and whether they can be trusted:
//
//   bench_edits [--faces N] [--edits N] [--undone N] [--seed N] MODEL...
//
// Each model goes through a whole job at default options, simplified to N faces (0, the default: as a job
// does). Then edits are drawn at random, folds to be cut and cuts to be joined, as many of one as of the
// other, until N of them (1000) were done; those that are refused are counted, too. After each one the FOLD
// file passes verify/, which a job sees to, once more here; after every N-th (1: each) undo gives the bytes
// of FOLD file and pages from before, and redo those from after. At the end the file, opened again, gives its
// own bytes. Seconds are of the processor, on one thread: medians and 95th percentiles. Exit code 1 where
// bytes differ or a file is unsound.
#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "base/random.hpp"
#include "export/export.hpp"
#include "job/job.hpp"
#include "mesh/mesh.hpp"
#include "session/session.hpp"
#include "verify/verify.hpp"

using namespace ridgecraft;

namespace {

struct Settings {
  std::size_t faces = 0;
  std::size_t edits = 1000;
  std::size_t undone = 1;
  std::uint64_t seed = 1;
  std::vector<std::string> models;
};

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Seconds that something took, over and over.
class Times {
 public:
  template <class Work>
  auto operator()(const Work& work) {
    const double start = processor_seconds();
    auto result = work();
    add(processor_seconds() - start);
    return result;
  }
  void add(double seconds) { seconds_.push_back(seconds); }
  [[nodiscard]] std::string text() {
    if (seconds_.empty()) {
      return "-";
    }
    std::sort(seconds_.begin(), seconds_.end());
    const auto at = [&](double share) {
      return 1000.0 * seconds_[static_cast<std::size_t>(share * static_cast<double>(seconds_.size() - 1))];
    };
    return fmt::format("{:.0f} / {:.0f} ms", at(0.5), at(0.95));
  }

 private:
  std::vector<double> seconds_;
};

/// Everything that a maker gets but the guide.
std::string bytes_of(const job::Paper& made) {
  std::string text = made.fold;
  for (const paper::Drawing& page : made.drawings) {
    text += paper::write_svg(page, {});
  }
  return text;
}

/// An edge that is used so; none where none is found soon.
std::optional<session::Edge> any_edge(const session::Project& project, unfold::EdgeUse use, Random& random) {
  const mesh::Surface& surface = project.now.prepared.model.surface;
  const auto edges = static_cast<std::uint32_t>(surface.edge_count());
  for (std::uint32_t tries = 0; tries < 10 * edges; ++tries) {
    const EdgeId e(random.below(edges));
    if (project.now.nets.use[e] == use) {
      const CornerId side = surface.sides(e)[0];
      return session::Edge{surface.vertex(side), surface.vertex(mesh::next(side))};
    }
  }
  return std::nullopt;
}

struct Tally {
  std::size_t cuts = 0, joins = 0, refused = 0, wrong = 0;
  Times applying, refusing, undoing;
};

/// Undo and redo of the step that led from one state to the next.
std::size_t wrong_ways_back(const session::Project& project, const session::Project& changed, Tally& tally) {
  const session::Project back = tally.undoing([&] { return session::undo(changed, {}); });
  const session::Project forth = session::redo(back, {});
  return (bytes_of(back.now) == bytes_of(project.now) ? 0U : 1U) +
         (bytes_of(forth.now) == bytes_of(changed.now) ? 0U : 1U);
}

void edit_at_random(session::Project& project, const Settings& settings, Tally& tally) {
  Random random(settings.seed);
  const std::size_t patience = 20 * settings.edits;
  for (std::size_t tries = 0; tally.cuts + tally.joins < settings.edits && tries < patience; ++tries) {
    const bool cuts = random.below(2) == 0;
    const auto edge = any_edge(project, cuts ? unfold::EdgeUse::fold : unfold::EdgeUse::cut, random);
    if (!edge) {
      continue;
    }
    const std::array<session::Edit, 1> edit{cuts ? session::Edit(session::Cut{*edge})
                                                 : session::Edit(session::Join{*edge})};
    const double start = processor_seconds();
    session::Answer answer = session::apply(project, edit, {});
    const double took = processor_seconds() - start;
    if (std::holds_alternative<session::Refusal>(answer)) {
      tally.refusing.add(took);
      ++tally.refused;
      continue;
    }
    tally.applying.add(took);
    auto changed = std::get<session::Project>(std::move(answer));
    (cuts ? tally.cuts : tally.joins) += 1;
    tally.wrong += verify::verify(changed.now.fold, {}, {}).sound() ? 0U : 1U;
    if ((tally.cuts + tally.joins) % settings.undone == 0) {
      tally.wrong += wrong_ways_back(project, changed, tally);
    }
    project = std::move(changed);
  }
}

/// Whether the saved file, opened again, gives its own bytes.
bool comes_back(const session::Project& project) {
  const session::Answer again = session::reopen(*project.start, project.now.fold, {});
  const auto* const opened = std::get_if<session::Project>(&again);
  return opened != nullptr && bytes_of(opened->now) == bytes_of(project.now);
}

/// Wall milliseconds of the stages that the job went through again.
std::string stages_text(const job::StageSeconds& all, const job::StageSeconds& first) {
  std::string text;
  for (const auto& [name, seconds] : all) {
    const auto same =
        std::find_if(first.begin(), first.end(), [&](const auto& f) { return f.first == name; });
    const double since = seconds - (same == first.end() ? 0.0 : same->second);
    if (since > 0.0) {
      text += fmt::format(" {} {:.0f}", name, 1000.0 * since);
    }
  }
  return text;
}

std::size_t measure(const std::string& file, const Settings& settings) {
  job::Options options;
  if (settings.faces > 0) {
    options.simplify.mode = prepare::Simplification::count;
    options.simplify.faces = settings.faces;
  }
  session::Project project = session::open(job::paper(mesh::read(file, {}, {}), options, {}));
  const std::size_t pieces = project.now.nets.pieces.size();
  Tally tally;
  edit_at_random(project, settings, tally);
  tally.wrong += comes_back(project) ? 0U : 1U;
  fmt::print(
      "{}: {} faces, {} pieces, then {}; {} cuts, {} joins; refused {}; wrong {}; edit {}, refusal {}, undo "
      "{}\n",
      std::filesystem::path(file).filename().string(), project.now.prepared.model.surface.face_count(),
      pieces, project.now.nets.pieces.size(), tally.cuts, tally.joins, tally.refused, tally.wrong,
      tally.applying.text(), tally.refusing.text(), tally.undoing.text());
  // Each project's paper goes on from the first job, so this is the last edit's.
  fmt::print("  last edit, ms:{}\n", stages_text(project.now.seconds, project.start->seconds));
  std::fflush(stdout);
  return tally.wrong;
}

}  // namespace

int main(int count, char** words) {
  Settings settings;
  try {
    for (int i = 1; i < count; ++i) {
      const std::string word = words[i];
      if (word.starts_with("--") && i + 1 < count) {
        const auto value = std::stoull(words[++i]);
        (word == "--faces"    ? settings.faces
         : word == "--edits"  ? settings.edits
         : word == "--undone" ? settings.undone
                              : settings.seed) = value;
      } else {
        settings.models.push_back(word);
      }
    }
    std::size_t wrong = 0;
    for (const std::string& model : settings.models) {
      wrong += measure(model, settings);
    }
    return wrong == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_edits: %s\n", error.what());
    return 1;
  }
}
