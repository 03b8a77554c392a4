#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the static site: a start page, the studio as a page that can be installed and works offline, and the documents.
#   web/site/build.sh [STUDIO.html [FOLDER]]     build/wasm/studio.html (wasm/build.sh) and build/site, unless named
# Any host of static files can have the folder; all addresses in it are relative.
set -eu
site=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$site/../.." && pwd)
studio=${1:-$root/build/wasm/studio.html}
out=${2:-$root/build/site}
[ -f "$studio" ] || {
  echo "there is no $studio; wasm/build.sh makes it" >&2
  exit 1
}
sh "$root/cmake/install-packages.sh" "$site/packages.txt"

mkdir -p "$out"
cp "$site/index.html" "$site/site.css" "$site/icon.svg" "$site/manifest.webmanifest" "$site/register.js" "$out"

# The page itself may now ask this site for its manifest and its service worker.
sed -e "/Content-Security-Policy/s/worker-src blob:/manifest-src 'self'; worker-src blob: 'self'/" \
  -e "/Content-Security-Policy/s/script-src /script-src 'self' /; /Content-Security-Policy/s/img-src /img-src 'self' /" \
  -e 's|<link rel="icon" href="data:,">|<link rel="icon" href="icon.svg"><link rel="manifest" href="manifest.webmanifest"><script src="register.js" defer></script>|' \
  "$studio" >"$out/studio.html"
version=$(cat "$out/studio.html" "$out/index.html" "$out/site.css" | sha256sum | cut -c 1-16)
sed "s/@VERSION@/$version/" "$site/service_worker.js" >"$out/service_worker.js"

# Documents keep their folders, so links between them hold.
(cd "$root" && git ls-files 'docs/*.md' 'docs/images/*') | while read -r file; do
  mkdir -p "$out/$(dirname "$file")"
  case $file in
    *.md)
      title=$(sed -n 's/^# //p' "$root/$file" | head -n 1)
      up=$(dirname "$file" | sed 's|[^/]*|..|g')
      {
        sed -e "s|@TITLE@|$title|" -e "s|@UP@|$up|g" "$site/document.html"
        cmark-gfm --extension table "$root/$file" | sed -e 's|\(href="[^":]*\)\.md\([#"]\)|\1.html\2|g'
        echo "</main>"
      } >"$out/${file%.md}.html"
      ;;
    *) cp "$root/$file" "$out/$file" ;;
  esac
done
echo "$out/index.html" >&2
