// SPDX-License-Identifier: GPL-3.0-or-later
// The page of web/ as one text, made by web/bundle.sh when the program is built. Private to
// export/formats/.
#pragma once

#include <string_view>

namespace ridgecraft::export_ {

/// HTML with `@MARK@`, `@SETTINGS@`, `@PRODUCER@`, `@TITLE@`, `@FOLD@` and `@SHEETS@` once each, in this
/// order, where write_html() puts what belongs there.
extern const std::string_view page_template;

}  // namespace ridgecraft::export_
