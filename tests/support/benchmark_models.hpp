// SPDX-License-Identifier: GPL-3.0-or-later
// Models and people's segmentations of the Princeton Segmentation Benchmark, where the archive is at hand.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace ridgecraft::test {

/// Unpacks members of the archive ("off/81.off", "seg/81") into a folder. False, with a warning, where there
/// is none.
[[nodiscard]] bool unpack_benchmark(const std::vector<std::string>& members,
                                    const std::filesystem::path& folder);

/// The part of each face in a file of one number a line.
[[nodiscard]] std::vector<std::uint32_t> read_labels(const std::filesystem::path& file);

}  // namespace ridgecraft::test
