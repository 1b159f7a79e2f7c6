#!/usr/bin/env bash
# Installs what Sediment is built from, on Debian 12: packages by apt, ONNX Runtime and what the page of `sediment report`
# is made of into third_party/ (ignored by git).
#
# usage: scripts/setup.sh [--check] [--no-onnxruntime] [--no-web] [--benchmarks]
#   --check           only say what is missing, install nothing: exit 0 if nothing is, else 1
#   --no-onnxruntime  leave ONNX Runtime out; the stage `segment` then runs networks with OpenCV, about half as fast
#   --no-web          leave out three.js, esbuild and Chromium: no `sediment report`, and no test of it
#   --benchmarks      also what nothing but benchmarks compare with (snakemake)
#
# Run it as root or with sudo at hand, as often as you like: it touches nothing that is there already.
set -euo pipefail

# The one list of packages. README.md says what each library is for.
packages=(
  build-essential cmake ninja-build ccache git ca-certificates curl
  libopencv-dev libpcl-dev liboctomap-dev libeigen3-dev libceres-dev libyaml-cpp-dev libtbb-dev
  nlohmann-json3-dev libcli11-dev libspdlog-dev libfmt-dev libxxhash-dev libdeflate-dev
  catch2 libbenchmark-dev clang-format clang-tidy shellcheck
  slurm-wlm munge  # for the test of --backend slurm, which starts a Slurm of its own
)
benchmark_packages=(snakemake)
scripts=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

say() { echo "setup: $*"; }
fail() { echo "setup: $*" >&2; exit 1; }
wrong_call() { echo "setup: $* (--help explains)" >&2; exit 2; }

missing_packages() {
  local package
  for package in "${packages[@]}"; do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || echo "$package"
  done
}

# A system-wide ONNX Runtime, or one named by ONNXRUNTIME_ROOT, goes before ours (cmake/FindOnnxRuntime.cmake).
has_onnxruntime() {
  [ -n "${ONNXRUNTIME_ROOT-}" ] || compgen -G '/usr/include/onnxruntime*' >/dev/null ||
    compgen -G '/usr/local/include/onnxruntime*' >/dev/null || "$scripts/fetch_onnxruntime.sh" --check 2>/dev/null
}

apt_install() {
  local root_rights=()
  if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null || fail "not root and no sudo; as root: apt-get install --no-install-recommends $*"
    root_rights=(sudo)
  fi
  "${root_rights[@]}" apt-get update -q
  "${root_rights[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "$@"
}

without_onnxruntime() {
  echo "setup: WARNING: no ONNX Runtime ($1)." >&2
  echo "setup: WARNING: everything works, but networks run with OpenCV's engine, about half as fast." >&2
  echo "setup: WARNING: scripts/fetch_onnxruntime.sh tries again; it also takes an archive from elsewhere." >&2
}

fetch_onnxruntime() {
  if ! command -v npm >/dev/null && ! apt_install npm; then
    without_onnxruntime "npm, which downloads it, cannot be installed"
  elif ! "$scripts/fetch_onnxruntime.sh"; then
    without_onnxruntime "it could not be fetched, see above"
  fi
}

# The page, and the browser in which it is tested. Without them everything else works.
has_web() { "$scripts/fetch_web.sh" --check 2>/dev/null && command -v chromium >/dev/null && command -v node >/dev/null; }
without_web() { echo "setup: WARNING: $1 (the rest works)" >&2; }

fetch_web() {
  if ! command -v npm >/dev/null && ! apt_install npm; then
    without_web "npm cannot be installed, so that \`sediment report\` has no page"
  elif ! "$scripts/fetch_web.sh"; then
    without_web "three.js or esbuild could not be fetched, see above: \`sediment report\` has no page"
  fi
  command -v node >/dev/null || apt_install nodejs || without_web "no nodejs: the page is not tested"
  command -v chromium >/dev/null || apt_install chromium || without_web "no chromium: the page is not tested"
}

check=false onnxruntime=true web=true
for argument in "$@"; do
  case "$argument" in
    --check) check=true ;;
    --no-onnxruntime) onnxruntime=false ;;
    --no-web) web=false ;;
    --benchmarks) packages+=("${benchmark_packages[@]}") ;;
    -h | --help) sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "$0"; exit 0 ;;
    *) wrong_call "unknown argument $argument" ;;
  esac
done

command -v dpkg-query >/dev/null || fail "this is no Debian system; README.md lists the libraries to install by hand"
mapfile -t missing < <(missing_packages)
if $check; then
  state=0
  if [ ${#missing[@]} -gt 0 ]; then say "missing packages: ${missing[*]}"; state=1; fi
  if $onnxruntime && ! has_onnxruntime; then say "missing: ONNX Runtime (scripts/fetch_onnxruntime.sh)"; state=1; fi
  if $web && ! has_web; then say "missing: three.js, esbuild or chromium (scripts/fetch_web.sh, apt-get)"; state=1; fi
  [ $state = 1 ] || say "nothing is missing"
  exit $state
fi
if [ ${#missing[@]} -gt 0 ]; then
  say "installing ${missing[*]}"
  apt_install "${missing[@]}" || fail "apt-get could not install ${missing[*]}; its message is above"
fi
if $onnxruntime && ! has_onnxruntime; then fetch_onnxruntime; fi
if $web && ! has_web; then fetch_web; fi
say "everything that Sediment is built from is there"
