// SPDX-License-Identifier: GPL-3.0-or-later
// What layout promises, asked of its result without any shortcut, and a plain packer to compare with.
#pragma once

#include <cstddef>

#include "export/export.hpp"

namespace ridgecraft::test {

/// Every piece lies on a page that there is, inside the printable area; no page is empty; with `all_pairs`
/// every two pieces of a page keep the paper's gap (quadratic in their faces). Fails the running test
/// otherwise.
void check_promises(const unfold::Nets& nets, const export_::Pages& pages, bool all_pairs = true);

/// Pages that shelves of bounding boxes take, turned to lie flat, highest first, first fit: what most
/// programs do.
[[nodiscard]] std::size_t shelf_pages(const unfold::Nets& nets, const export_::Paper& paper);

}  // namespace ridgecraft::test
