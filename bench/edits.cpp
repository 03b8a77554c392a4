// SPDX-License-Identifier: GPL-3.0-or-later
// What edits by hand cost, and whether they can be trusted:
//
//   bench_edits [--faces N] [--edits N] [--undone N] [--reopened N] [--checked N] [--seed N]
//               [--checker COMMAND] MODEL...
//
// Each model goes through a whole job at default options, simplified to N faces (0, the default: as a job
// does). Then edits of all kinds are drawn at random until N of them (1000) were done; those that are refused
// are counted, too. The FOLD file of each state passes verify/, which session/ sees to; what it throws counts
// as wrong. After every N-th edit (1: each) undo gives the bytes of FOLD file and
// pages from before, and redo those from after; after every N-th (100), and at the end, the file, opened
// again, gives its own bytes; every N-th state (50) is also given to a checker of FOLD files as `COMMAND
// FILE`, if there is one, which ends with 0 where it finds no fault. Seconds are of the processor, on one
// thread: medians and 95th percentiles, for each model and in the end for each kind of edit. Exit code 1
// where anything was wrong.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "base/random.hpp"
#include "export/export.hpp"
#include "job/job.hpp"
#include "mesh/mesh.hpp"
#include "session/session.hpp"

using namespace ridgecraft;

namespace {

enum class EditKind { cut, join, tab_from, no_tab, place, pin, unpin, retry, pack };
constexpr std::array<std::string_view, 9> edit_kinds{"cut", "join",  "tab-from", "no-tab", "place",
                                                     "pin", "unpin", "retry",    "pack"};

/// An edge that is used so, in either direction; none where none is found soon.
std::optional<session::Edge> any_edge(const session::Project& project, unfold::EdgeUse use, Random& random) {
  const mesh::Surface& surface = project.now.prepared.model.surface;
  const auto edges = static_cast<std::uint32_t>(surface.edge_count());
  for (std::uint32_t tries = 0; tries < 10 * edges; ++tries) {
    const EdgeId e(random.below(edges));
    if (project.now.nets.use[e] == use) {
      const CornerId side = surface.sides(e)[0];
      session::Edge edge{surface.vertex(side), surface.vertex(mesh::next(side))};
      if (random.below(2) == 0) {
        std::swap(edge.from, edge.to);
      }
      return edge;
    }
  }
  return std::nullopt;
}

FaceId any_face(const session::Project& project, PieceId piece, Random& random) {
  const auto& faces = project.now.nets.pieces[piece].faces;
  return faces[random.below(static_cast<std::uint32_t>(faces.size()))];
}

/// Of the pieces that are pinned, or of the others.
std::optional<FaceId> any_face(const session::Project& project, bool pinned, Random& random) {
  const session::State& state = project.state();
  std::vector<PieceId> pieces;
  for (const PieceId p : ids<PieceId>(project.now.nets.pieces.size())) {
    if (state.is_pinned(p) == pinned) {
      pieces.push_back(p);
    }
  }
  if (pieces.empty()) {
    return std::nullopt;
  }
  return any_face(project, pieces[random.below(static_cast<std::uint32_t>(pieces.size()))], random);
}

std::optional<session::Edit> any_place(const session::Project& project, Random& random) {
  const std::optional<FaceId> face = any_face(project, false, random);
  if (!face || !project.state().pages) {
    return std::nullopt;
  }
  const export_::Pages& pages = *project.state().pages;
  const export_::Placement& lies = pages.placements[project.now.nets.piece[*face]];
  const auto& corners = project.now.nets.flat[*face];
  const Vec2 from = lies(corners[0]);
  const Vec2 side = lies(corners[1]) - from;
  session::Place place;
  place.face = *face;
  const double degrees = std::atan2(side.y, side.x) * 180.0 / std::numbers::pi;
  const auto count = static_cast<std::uint32_t>(pages.count);
  if (random.below(4) != 0) {
    constexpr double reach_mm = 20.0;
    place.page = lies.page.value();
    place.at = from + Vec2{reach_mm * (2.0 * random.unit() - 1.0), reach_mm * (2.0 * random.unit() - 1.0)};
    place.degrees = random.below(2) == 0 ? degrees : degrees + 15.0 * (2.0 * random.unit() - 1.0);
  } else {
    place.page = random.below(count + 1);
    place.at = {pages.paper.size.x * random.unit(), pages.paper.size.y * random.unit()};
    place.degrees = degrees + 90.0 * random.below(4);
  }
  return place;
}

std::optional<session::Edit> any_pack(const session::Project& project, Random& random) {
  session::Pack pack;
  for (std::uint32_t pieces = random.below(4); pieces > 0; --pieces) {
    if (const std::optional<FaceId> face = any_face(project, false, random)) {
      pack.faces.push_back(*face);
    }
  }
  return pack;
}

/// One of this kind, which may well be refused; none where the project has nothing for it. A place is mostly
/// some millimetres away from where the piece lies. No more than a third of the pieces gets pinned.
std::optional<session::Edit> random_edit(const session::Project& project, EditKind kind, Random& random) {
  using unfold::EdgeUse;
  const auto at_edge = [&](EdgeUse use, auto edit) -> std::optional<session::Edit> {
    if (const auto edge = any_edge(project, use, random)) {
      edit.edge = *edge;
      return edit;
    }
    return std::nullopt;
  };
  const auto at_piece = [&](bool pinned, auto edit) -> std::optional<session::Edit> {
    if (const auto face = any_face(project, pinned, random)) {
      edit.face = *face;
      return edit;
    }
    return std::nullopt;
  };
  switch (kind) {
    case EditKind::cut:
      return at_edge(EdgeUse::fold, session::Cut{});
    case EditKind::join:
      return at_edge(EdgeUse::cut, session::Join{});
    case EditKind::tab_from:
      return at_edge(EdgeUse::cut, session::TabFrom{});
    case EditKind::no_tab:
      return at_edge(EdgeUse::cut, session::NoTab{});
    case EditKind::place:
      return any_place(project, random);
    case EditKind::pin:
      if (3 * (project.state().pinned.size() + 1) > project.now.nets.pieces.size()) {
        return std::nullopt;
      }
      return at_piece(false, session::Pin{});
    case EditKind::unpin:
      return at_piece(true, session::Unpin{});
    case EditKind::retry: {
      session::Retry retry;
      retry.seed = 1 + random.below(1000);
      return at_piece(false, retry);
    }
    case EditKind::pack:
      return any_pack(project, random);
  }
  return std::nullopt;
}

struct Settings {
  std::size_t faces = 0;
  std::size_t edits = 1000;
  std::size_t undone = 1;
  std::size_t reopened = 100;
  std::size_t checked = 50;
  std::uint64_t seed = 1;
  std::string checker;
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
  [[nodiscard]] std::size_t count() const { return seconds_.size(); }
  [[nodiscard]] std::string text() {
    if (seconds_.empty()) {
      return "-";
    }
    std::sort(seconds_.begin(), seconds_.end());
    const auto at = [&](double fraction) {
      return 1000.0 * seconds_[static_cast<std::size_t>(fraction * static_cast<double>(seconds_.size() - 1))];
    };
    return fmt::format("{:.0f} / {:.0f} ms", at(0.5), at(0.95));
  }

 private:
  std::vector<double> seconds_;
};

/// What was done of one kind of edit.
struct OfKind {
  std::size_t refused = 0;
  Times applying, undoing;
};
using OfKinds = std::array<OfKind, edit_kinds.size()>;

/// What was done to one model.
struct Tally {
  std::size_t done = 0, states = 0, refused = 0, wrong = 0, checked = 0;
  Times applying, refusing, undoing, reopening;
};

/// Everything that a maker gets but the guide.
std::string bytes_of(const job::Paper& made) {
  std::string text = made.fold;
  for (const export_::Drawing& page : made.drawings) {
    text += export_::write_svg(page, {});
  }
  return text;
}

void complain(const session::Project& project, Tally& tally, const std::string& what) {
  ++tally.wrong;
  std::string steps;
  for (std::size_t i = 0; i < project.done; ++i) {
    steps += session::text_of(project.steps[i].edits) + "\n";
  }
  fmt::print("  WRONG: {}\n{}", what, steps);
  std::fflush(stdout);
}

/// Whether a checker that somebody named finds no fault in the file.
bool passes(const std::string& fold, const std::string& checker) {
  const auto file = std::filesystem::temp_directory_path() / fmt::format("bench_edits-{}.fold", ::getpid());
  std::ofstream(file, std::ios::binary) << fold;
  const int code = std::system((checker + " '" + file.string() + "' >/dev/null").c_str());
  std::filesystem::remove(file);
  return code == 0;
}

/// Undo and redo of the step that led from one state to the next.
void go_back_and_forth(const session::Project& changed, const std::string& before, const std::string& after,
                       Tally& tally, OfKind& of_kind) {
  const double start = processor_seconds();
  const session::Project back = session::undo(changed, {});
  const double took = processor_seconds() - start;
  tally.undoing.add(took);
  of_kind.undoing.add(took);
  if (bytes_of(back.now) != before) {
    complain(changed, tally, "undo gives other bytes");
  }
  const session::Project forth = session::redo(back, {});
  if (bytes_of(forth.now) != after) {
    complain(changed, tally, "redo gives other bytes");
  }
  tally.states += 2;
}

/// The saved file, opened again.
void open_again(const session::Project& project, const std::string& bytes, Tally& tally) {
  const session::Answer again =
      tally.reopening([&] { return session::reopen(*project.start, project.now.fold, {}); });
  const auto* const opened = std::get_if<session::Project>(&again);
  if (opened == nullptr || bytes_of(opened->now) != bytes) {
    complain(project, tally,
             opened == nullptr ? "the saved file is refused: " + std::get<session::Refusal>(again).why
                               : "the saved file gives other bytes");
  }
  ++tally.states;
}

/// A project that is edited, and what came of it so far.
struct Trial {
  session::Project& project;
  std::string bytes;  ///< of the project as it is
  const Settings& settings;
  Random random;
  Tally& tally;
};

/// Draws an edit of this kind and does it. Returns whether it was done.
bool edit_once(Trial& trial, EditKind kind, OfKind& of_kind) {
  const Settings& settings = trial.settings;
  Tally& tally = trial.tally;
  const std::optional<session::Edit> edit = random_edit(trial.project, kind, trial.random);
  if (!edit) {
    return false;
  }
  const double start = processor_seconds();
  session::Answer answer = session::apply(trial.project, {&*edit, 1}, {});
  const double took = processor_seconds() - start;
  if (std::holds_alternative<session::Refusal>(answer)) {
    tally.refusing.add(took);
    ++tally.refused;
    ++of_kind.refused;
    return false;
  }
  tally.applying.add(took);
  of_kind.applying.add(took);
  auto changed = std::get<session::Project>(std::move(answer));
  std::string after = bytes_of(changed.now);
  ++tally.done;
  ++tally.states;
  if (tally.done % settings.undone == 0) {
    go_back_and_forth(changed, trial.bytes, after, tally, of_kind);
  }
  if (tally.done % settings.reopened == 0 || tally.done == settings.edits) {
    open_again(changed, after, tally);
  }
  if (!settings.checker.empty() && tally.done % settings.checked == 0) {
    ++tally.checked;
    if (!passes(changed.now.fold, settings.checker)) {
      complain(changed, tally, "the checker finds faults");
    }
  }
  trial.project = std::move(changed);
  trial.bytes = std::move(after);
  return true;
}

void edit_at_random(session::Project& project, const Settings& settings, Tally& tally, OfKinds& of_kinds) {
  Trial trial{project, bytes_of(project.now), settings, Random(settings.seed), tally};
  const std::size_t patience = 20 * settings.edits;
  for (std::size_t tries = 0; tally.done < settings.edits && tries < patience; ++tries) {
    // Some of a kind in a row, or what is mostly refused would hardly be done.
    constexpr std::size_t in_a_row = 8;
    const auto kind = trial.random.below(static_cast<std::uint32_t>(of_kinds.size()));
    try {
      for (std::size_t i = 0; i < in_a_row && !edit_once(trial, static_cast<EditKind>(kind), of_kinds[kind]);
           ++i) {
      }
    } catch (const std::exception& error) {
      complain(project, tally, fmt::format("{}: {}", edit_kinds[kind], error.what()));
    }
  }
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

std::size_t measure(const std::string& file, const Settings& settings, OfKinds& of_kinds) {
  job::Options options;
  if (settings.faces > 0) {
    options.simplify.mode = prepare::Simplification::count;
    options.simplify.faces = settings.faces;
  }
  session::Project project = session::open(job::paper(mesh::read(file, {}, {}), options, {}));
  const std::size_t pieces = project.now.nets.pieces.size();
  Tally tally;
  edit_at_random(project, settings, tally, of_kinds);
  fmt::print(
      "{}: {} faces, {} pieces, then {} on {} pages; {} edits, {} refused; {} states, {} by the checker; "
      "wrong "
      "{}; edit {}, refusal {}, undo {}, reopening {}\n",
      std::filesystem::path(file).filename().string(), project.now.prepared.model.surface.face_count(),
      pieces, project.now.nets.pieces.size(), project.now.pages.count, tally.done, tally.refused,
      tally.states, tally.checked, tally.wrong, tally.applying.text(), tally.refusing.text(),
      tally.undoing.text(), tally.reopening.text());
  // Each project's paper goes on from the first job, so this is the last edit's.
  fmt::print("  last edit, ms:{}\n", stages_text(project.now.seconds, project.start->seconds));
  std::fflush(stdout);
  return tally.wrong;
}

void print_kinds(OfKinds& of_kinds) {
  for (std::size_t k = 0; k < of_kinds.size(); ++k) {
    fmt::print("{}: {} done, {} refused; edit {}, undo {}\n", edit_kinds[k], of_kinds[k].applying.count(),
               of_kinds[k].refused, of_kinds[k].applying.text(), of_kinds[k].undoing.text());
  }
}

Settings settings_of(int count, char** words) {
  Settings settings;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    if (word == "--checker" && i + 1 < count) {
      settings.checker = words[++i];
    } else if (word.starts_with("--") && i + 1 < count) {
      const auto value = std::stoull(words[++i]);
      (word == "--faces"      ? settings.faces
       : word == "--edits"    ? settings.edits
       : word == "--undone"   ? settings.undone
       : word == "--reopened" ? settings.reopened
       : word == "--checked"  ? settings.checked
                              : settings.seed) = value;
    } else {
      settings.models.push_back(word);
    }
  }
  return settings;
}

}  // namespace

int main(int count, char** words) {
  try {
    const Settings settings = settings_of(count, words);
    OfKinds of_kinds;
    std::size_t wrong = 0;
    for (const std::string& model : settings.models) {
      wrong += measure(model, settings, of_kinds);
    }
    print_kinds(of_kinds);
    return wrong == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_edits: %s\n", error.what());
    return 1;
  }
}
