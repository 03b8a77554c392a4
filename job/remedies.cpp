// SPDX-License-Identifier: GPL-3.0-or-later
#include "job/remedies.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "prepare/prepare.hpp"
#include "prepare/prepared/effort.hpp"
#include "prepare/selection/selection.hpp"

namespace ridgecraft::job {
namespace {

/// Numbers of faces, and names, that are tried at most: each takes as long as all of preparation.
constexpr std::size_t most_tries = 3;
/// Of what is tried first and has too much work, this share of the faces is tried next.
constexpr double fewer_faces = 0.6;
/// With fewer nothing of a model is left, ...
constexpr std::size_t least_faces = 24;
/// ... and without a name of a larger share of its area it is another one.
constexpr double most_of_area = 0.4;

double hours_of(const prepare::Prepared& prepared) {
  return prepare::minutes_of(prepared.work) / 60.0;
}

/// Two digits, rounded down.
std::size_t round_number(double faces) {
  double step = 1.0;
  while (faces >= 100.0 * step) {
    step *= 10.0;
  }
  return static_cast<std::size_t>(step * std::floor(faces / step));
}

bool is_too_much(const prepare::Prepared& prepared, const UsedOptions& used) {
  return !prepare::can_be_folded(prepared) || prepare::excess(prepared.work, used.simplify.budget) > 0.0;
}

class RemedySearch {
 public:
  RemedySearch(const mesh::Model& model, const prepare::Prepared& prepared, const UsedOptions& used,
               const Preparation& prepare)
      : model_(model), prepared_(prepared), used_(used), prepare_(prepare) {
    used_.size.adapts = false;
    used_.size.largest_extent_mm = prepared.model.surface.bounds().largest_extent();
  }

  std::vector<Remedy> find() {
    try {
      if (is_too_much(prepared_, used_)) {
        try_size();
        try_faces();
      }
      try_names();
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::out_of_time && error.kind() != ErrorKind::no_nets) {
        throw;
      }
    }
    return std::move(remedies_);
  }

 private:
  /// Whether this change helps; then it is one of the remedies.
  bool helps(const mesh::Model& model, const UsedOptions& used, RemedyKind kind, std::string value) {
    const prepare::Prepared tried = prepare_(model, used);
    if (kind == RemedyKind::size ? !prepare::can_be_folded(tried) : needs_remedies(tried, used)) {
      return false;
    }
    remedies_.push_back({kind, std::move(value), hours_of(tried)});
    return true;
  }

  void try_size() {
    if (prepared_.smallest_size_mm) {
      UsedOptions larger = used_;
      larger.size.mm_per_unit.reset();
      larger.size.largest_extent_mm = *prepared_.smallest_size_mm;
      static_cast<void>(
          helps(model_, larger, RemedyKind::size, fmt::format("{:.0f}", larger.size.largest_extent_mm)));
    }
  }

  void try_faces() {
    // Minutes grow slower than faces, so the share of the hours is a number that may do.
    constexpr double surely_fewer = 0.8;
    double faces = static_cast<double>(prepared_.model.surface.face_count()) *
                   std::min(surely_fewer, used_.simplify.budget.hours / hours_of(prepared_));
    UsedOptions fewer = used_;
    fewer.simplify.mode = prepare::Simplification::count;
    for (std::size_t i = 0; i < most_tries; ++i, faces *= fewer_faces) {
      fewer.simplify.faces = round_number(faces);
      if (fewer.simplify.faces < least_faces ||
          helps(model_, fewer, RemedyKind::faces, std::to_string(fewer.simplify.faces))) {
        return;
      }
    }
  }

  void try_names() {
    const double area = mesh::total_area(model_.surface);
    std::size_t tries = 0;
    for (const prepare::NamedPart& part : prepare::named_parts(model_)) {
      if (part.area > most_of_area * area) {
        continue;
      }
      if (tries++ == most_tries ||
          helps(prepare::select(model_, {{}, {part.name}}), used_, RemedyKind::without, part.name)) {
        return;
      }
    }
  }

  const mesh::Model& model_;
  const prepare::Prepared& prepared_;
  UsedOptions used_;
  const Preparation& prepare_;
  std::vector<Remedy> remedies_;
};

}  // namespace

bool needs_remedies(const prepare::Prepared& prepared, const UsedOptions& used) {
  return is_too_much(prepared, used) || prepared.model.surface.component_count() > prepare::most_loose_bodies;
}

std::vector<Remedy> find_remedies(const mesh::Model& model, const prepare::Prepared& prepared,
                                  const UsedOptions& used, const Preparation& prepare) {
  return RemedySearch(model, prepared, used, prepare).find();
}

}  // namespace ridgecraft::job
