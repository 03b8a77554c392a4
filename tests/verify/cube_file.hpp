// SPDX-License-Identifier: GPL-3.0-or-later
// A cube and its net, written down by hand as the contract wants it: the clean file that tests break.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/vector.hpp"
#include "verify/verify.hpp"

namespace ridgecraft::test {

/// A cube of 40 mm as a cross of six squares on one A4 page: 5 folds, 7 joins, each with a tab 6 mm high.
[[nodiscard]] nlohmann::json cube_file();

/// Polygons that touch nothing, each a piece and a model component of its own, all on one unbounded page. The
/// model is the same figures, lying in one plane far apart.
[[nodiscard]] nlohmann::json loose_file(const std::vector<std::vector<Vec2>>& polygons);

/// The number of the promise that what a file says of itself is so, as broken() tells it.
inline constexpr int statement_promise = 8;

[[nodiscard]] verify::Report verify_json(const nlohmann::json& json);
/// The promises of which faults are listed, each once, in order.
[[nodiscard]] std::vector<int> broken(const verify::Report& report);
[[nodiscard]] std::vector<int> broken(const nlohmann::json& json);

}  // namespace ridgecraft::test
