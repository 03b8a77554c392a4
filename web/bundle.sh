#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes one page of the modules and style sheets of this folder, by esbuild:
#   web/bundle.sh result page_template.cpp    the page of a result, as the C++ source that write_html() fills
#   web/bundle.sh studio studio.html          that of the studio, which wasm/studio.mjs fills
# Lines of page.html that end with <!--result--> or <!--studio--> are for one of the two.
set -eu
web=$(cd "$(dirname "$0")" && pwd)
kind=$1
out=$2
case $kind in
  result) start=start.js style=page.css other=studio ;;
  studio) start=start_studio.js style=studio.css other=result ;;
esac
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# A page with one result has its languages in the script, as far as it speaks them; the studio's are packed beside it.
entry="$work/entry.js"
if [ "$kind" = result ]; then
  for file in "$web"/languages/*.json; do
    code=$(basename "$file" .json)
    echo "import {addLanguage} from '$web/words.js'; import {name, page, seams} from '$file'; addLanguage('$code', {name, page, seams});" >"$work/$code.js"
    echo "import './$code.js';" >>"$entry"
  done
fi
echo "import '$web/$start';" >>"$entry"

esbuild "$entry" --bundle --minify --charset=utf8 --format=iife --target=es2022 --log-level=warning --outfile="$work/script"
esbuild "$web/$style" --bundle --minify --charset=utf8 --log-level=warning --outfile="$work/style"

# As a content security policy names what stands between two tags: a line break and the file.
hash() {
  { echo && cat "$1"; } | sha256sum | cut -c 1-64 | tr a-f A-F | basenc --base16 -d | base64
}
sed -e "/<!--$other-->\$/d" -e "s/<!--$kind-->\$//" \
  -e "s|@SCRIPT_HASH@|$(hash "$work/script")|" -e "s|@STYLE_HASH@|$(hash "$work/style")|" \
  -e "/@STUDIO@/{r $web/studio.html" -e 'd}' \
  -e "/@STYLE@/{r $work/style" -e 'd}' \
  -e "/@SCRIPT@/{r $work/script" -e 'd}' "$web/page.html" >"$work/page"

if [ "$kind" = studio ]; then
  cp "$work/page" "$out"
else
  cat >"$out" <<END
// Made by web/bundle.sh; changes here are lost.
#include <string_view>

// Compilers need not take literals of more than 65,536 characters; GCC and clang do.
#pragma GCC diagnostic ignored "-Woverlength-strings"

namespace ridgecraft::export_ {

extern const std::string_view page_template;
const std::string_view page_template = R"page($(cat "$work/page"))page";

}  // namespace ridgecraft::export_
END
fi
