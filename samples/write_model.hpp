// SPDX-License-Identifier: GPL-3.0-or-later
// Finished shapes as files: OBJ with its materials, binary STL, ASCII PLY and OFF with colours.
#pragma once

#include <filesystem>

#include "samples/shape.hpp"

namespace ridgecraft::samples {

/// Writes the shape in the format of the file's suffix (.obj, .stl, .ply, .off); an OBJ's materials go to a
/// file beside it. The same bytes on every machine. Throws std::runtime_error where a file can't be written.
void write_model(const Shape& shape, const std::filesystem::path& file);

}  // namespace ridgecraft::samples
