// SPDX-License-Identifier: GPL-3.0-or-later
// What stands in a page for browsers, read by other means than its own (docs/design/viewer.md).
#pragma once

#include <string>

namespace ridgecraft::test {

/// The document with this id, "fold" or "sheets", unpacked. Checks that the page has it, whole.
[[nodiscard]] std::string page_document(const std::string& html, const std::string& id);

}  // namespace ridgecraft::test
