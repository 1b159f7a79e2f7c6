#!/usr/bin/env bash
# Unpacks ONNX Runtime into third_party/onnxruntime (ignored by git): Debian 12 has no package of it.
#
# usage: scripts/fetch_onnxruntime.sh [--check | --archive FILE]
#   --check         only say whether it is there: exit 0 or 1
#   --archive FILE  take this archive (made by `npm pack` elsewhere) instead of downloading it
#
# Does nothing if the folder is whole already. The folder appears by one rename: it is whole or absent, also after
# a kill. Without it, and without a system-wide ONNX Runtime, Sediment builds with OpenCV's engine alone.
set -euo pipefail

package=com.github.asus4.onnxruntime
version=0.4.9  # ONNX Runtime 1.29
sha256=e59788788818fdde1b2e522e766a21ba0f7d8391de55737abf81e32cc801785d

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
target=$root/third_party/onnxruntime
work=$root/third_party/.onnxruntime.partial

fail() { echo "fetch_onnxruntime: $*" >&2; exit 1; }
wrong_call() { echo "fetch_onnxruntime: $* (--help explains)" >&2; exit 2; }
is_whole() { [ "$(cat "$target/VERSION" 2>/dev/null)" = "$package $version $sha256" ]; }

# download FOLDER: prints the path of the archive.
download() {
  command -v npm >/dev/null || fail "npm is needed to download $package: apt-get install npm"
  (cd "$1" && npm pack --silent --cache "$1/npm-cache" "$package@$version" >"$1/npm.log" 2>&1) ||
    fail "npm pack $package@$version failed: $(tail -n 3 "$1/npm.log")"
  echo "$1/$package-$version.tgz"
}

# unpack ARCHIVE FOLDER: lib/libonnxruntime.so.1 (its soname), include/, licences.
unpack() {
  local archive=$1 folder=$2
  local headers='package/Plugins/iOS~/onnxruntime.xcframework/ios-arm64/onnxruntime.framework/Headers'
  mkdir -p "$folder/package" "$folder/lib" "$folder/include"
  tar -xzf "$archive" --no-same-owner -C "$folder" package/LICENSE package/ThirdPartyNotices.txt \
    package/Plugins/Linux/x64/libonnxruntime.so "$headers" || fail "$archive cannot be unpacked into $folder"
  mv "$folder/package/Plugins/Linux/x64/libonnxruntime.so" "$folder/lib/libonnxruntime.so.1"
  ln -s libonnxruntime.so.1 "$folder/lib/libonnxruntime.so"
  mv "$folder/$headers"/*.h "$folder/include/"
  mv "$folder/package/LICENSE" "$folder/package/ThirdPartyNotices.txt" "$folder/"
  rm -r "$folder/package"
  chmod 644 "$folder"/LICENSE "$folder"/ThirdPartyNotices.txt "$folder"/include/*.h
  chmod 755 "$folder/lib/libonnxruntime.so.1"
  echo "$package $version $sha256" >"$folder/VERSION"
}

archive=
case "${1-}" in
  "") ;;
  -h | --help) sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "$0"; exit 0 ;;
  --check) is_whole || fail "$target is not there or of another version"; exit 0 ;;
  --archive) [ $# -eq 2 ] || wrong_call "--archive needs a file"; archive=$(realpath -m "$2") ;;
  *) wrong_call "unknown argument $1" ;;
esac

[ "$(uname -s)-$(uname -m)" = Linux-x86_64 ] ||
  fail "$package has Linux libraries for x86_64 only: install ONNX Runtime yourself and set ONNXRUNTIME_ROOT"
mkdir -p "$root/third_party"
exec 9>"$root/third_party/.onnxruntime.lock"
flock 9  # two at once: the second waits and finds the work done
if is_whole; then echo "onnxruntime: $target is up to date"; exit 0; fi

rm -rf "$work"
mkdir "$work"
trap 'rm -rf "$work"' EXIT
if [ -z "$archive" ]; then archive=$(download "$work"); fi
[ -f "$archive" ] || fail "$archive does not exist"
found=$(sha256sum "$archive" | cut -d' ' -f1)
[ "$found" = "$sha256" ] || fail "$archive is not $package $version: expected sha256 $sha256, found $found"
unpack "$archive" "$work/new"
rm -rf "$target"  # of another version
mv -T "$work/new" "$target"
echo "onnxruntime: unpacked $package $version into $target"
