#!/usr/bin/env bash
# Prints what a run left: every stage's files with their size and what is in them.
#
# usage: scripts/list_results.sh DIR      (the --out DIR of the run)
set -euo pipefail

case "${1-}" in
  -h | --help | "") sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "$0"; [ -n "${1-}" ] && exit 0 || exit 2 ;;
esac
[ -d "$1" ] || { echo "list_results: $1 is no folder" >&2; exit 2; }
cd "$1"

# content_of FILE: how much is in it, by its kind.
content_of() {
  case "$1" in
    *.pcd) echo "$(head -c 2048 "$1" | grep -am 1 ^POINTS | cut -d' ' -f2) points" ;;
    *.ot | *.bt) echo "$(head -c 1024 "$1" | grep -am 1 '^size' | cut -d' ' -f2) nodes" ;;
    *.pgm) head -c 256 "$1" | grep -a -v '^#' | tr '\n' ' ' | awk '{ print $2 " x " $3 " cells" }' ;;
    */trajectory.txt | */keyframes.txt) echo "$(grep -c -v '^#' "$1") poses" ;;
    *.csv) echo "$(($(wc -l <"$1") - 1)) rows" ;;
  esac
}

human() { numfmt --to=si --suffix=B --format=%.1f "$1"; }

printf '%-46s %10s  %s\n' file size content
for manifest in */manifest.json; do
  stage=$(dirname "$manifest")
  for path in "$stage"/*; do
    if [ -d "$path" ]; then
      count=$(find -L "$path" -type f | wc -l)
      bytes=$(find -L "$path" -type f -printf '%s\n' | awk '{ sum += $1 } END { print sum + 0 }')
      printf '%-46s %10s  %s files\n' "$path/" "$(human "$bytes")" "$count"
    elif [[ $path != "$manifest" && $path != */metrics.json ]]; then
      printf '%-46s %10s  %s\n' "$path" "$(human "$(stat -Lc %s "$path")")" "$(content_of "$path")"
    fi
  done
done
echo "all in $PWD"
