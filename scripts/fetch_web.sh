#!/usr/bin/env bash
# Unpacks what the page of `sediment report` is made of into third_party/web (ignored by git): three.js (MIT), which draws
# in it, esbuild (MIT), which bundles it, and playwright-core (Apache-2.0), with which tests open it.
#
# usage: scripts/fetch_web.sh [--check]
#   --check   only say whether it is there: exit 0 or 1
#
# Does nothing if the folder is whole already. The folder appears by one rename: it is whole or absent. Without it
# everything else builds and works; `sediment report` says what it lacks.
set -euo pipefail

# package, version, sha256 of its archive
packages=(
  "three 0.187.0 ff540832ded0cfe919764d24a3d88f3e2a05f23303f876423e4f893841e90728"
  "@esbuild/linux-x64 0.28.2 9573bb2233aab0f9ea7647d5cca9726113cc1768de61d66b17267f4db84488f6"
  "playwright-core 1.65.1 6f5a60be62a4fddfbe7d10c448d8fbd54547da3358f2f8a04211440471ee863e"
)

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
target=$root/third_party/web
work=$root/third_party/.web.partial

fail() { echo "fetch_web: $*" >&2; exit 1; }
wrong_call() { echo "fetch_web: $* (--help explains)" >&2; exit 2; }
wanted() { printf '%s\n' "${packages[@]}"; }
is_whole() { [ "$(cat "$target/VERSION" 2>/dev/null)" = "$(wanted)" ]; }

# fetch NAME VERSION SHA256: unpacks the package into node_modules/NAME.
fetch() {
  local name=$1 version=$2 sha256=$3 archive found folder=$work/node_modules/$1
  archive=$work/$(basename "$name").tgz
  mkdir -p "$folder" "$work/pack"
  (cd "$work/pack" && npm pack --silent --cache "$work/npm-cache" "$name@$version" >"$work/npm.log" 2>&1) ||
    fail "npm pack $name@$version failed: $(tail -n 3 "$work/npm.log")"
  mv "$work/pack"/*.tgz "$archive"
  found=$(sha256sum "$archive" | cut -d' ' -f1)
  [ "$found" = "$sha256" ] || fail "$name $version: expected sha256 $sha256, found $found"
  tar -xzf "$archive" --no-same-owner --strip-components=1 -C "$folder"
}

case "${1-}" in
  "") ;;
  -h | --help) sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "$0"; exit 0 ;;
  --check) is_whole || fail "$target is not there or of another version"; exit 0 ;;
  *) wrong_call "unknown argument $1" ;;
esac

[ "$(uname -s)-$(uname -m)" = Linux-x86_64 ] || fail "esbuild is fetched for Linux on x86_64 only"
mkdir -p "$root/third_party"
exec 9>"$root/third_party/.web.lock"
flock 9  # two at once: the second waits and finds the work done
if is_whole; then echo "web: $target is up to date"; exit 0; fi
command -v npm >/dev/null || fail "npm is needed: apt-get install npm"

rm -rf "$work"
mkdir "$work"
trap 'rm -rf "$work"' EXIT
for package in "${packages[@]}"; do
  # shellcheck disable=SC2086  # three words
  fetch $package
done
mv "$work/node_modules/@esbuild/linux-x64/bin/esbuild" "$work/esbuild"
rm -rf "$work/npm-cache" "$work/npm.log" "$work/pack" "$work"/*.tgz "$work/node_modules/@esbuild"
wanted >"$work/VERSION"
rm -rf "$target"  # of another version
mv -T "$work" "$target"
echo "web: unpacked three.js, esbuild and playwright-core into $target"
