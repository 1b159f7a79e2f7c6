#!/usr/bin/env bash
# Makes one HTML file of web/: the program with three.js, the style, and the place where content goes.
# usage: bundle.sh LIBRARIES PAGE      (LIBRARIES: what scripts/fetch_web.sh made)
set -euo pipefail
libraries=$1 page=$2
web=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/web
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

export NODE_PATH=$libraries/node_modules
for entry in main.js style.css; do
  "$libraries/esbuild" "$web/$entry" --bundle --minify --target=es2020 --format=iife --legal-comments=inline \
    --log-level=warning --outfile="$work/$entry"
done
sed -e "/^<!-- style -->\$/{r $work/style.css
d}" -e "/^<!-- program -->\$/{r $work/main.js
d}" "$web/page.html" >"$page.partial"
mv "$page.partial" "$page"
