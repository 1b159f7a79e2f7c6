#!/usr/bin/env bash
# Configures and builds; the programs are then in build/PRESET/bin.
#
# usage: scripts/build.sh [--preset NAME] [programs | TARGET...]
#   --preset NAME   release (default), dev, asan or tsan: see CMakePresets.json
#   programs        only what users run: `sediment`, the stages and the tools, no tests and no benchmarks
#
# With the compiler that the project is checked with (g++ 12) every warning is an error; with another one it is not,
# so that a new compiler's new warnings keep nobody from building.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

shopt -s nullglob
preset=release targets=()
while [ $# -gt 0 ]; do
  case "$1" in
    --preset) preset=${2:?"build: --preset needs a name"}; shift ;;
    -h | --help) sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "$0"; exit 0 ;;
    -*) echo "build: unknown flag $1 (--help explains)" >&2; exit 2 ;;
    programs)  # a stage's or tool's folder has the name of its executable
      targets+=(sediment)
      for main in stages/*/main.cpp tools/*/main.cpp; do targets+=("$(basename "$(dirname "$main")")"); done ;;
    *) targets+=("$1") ;;
  esac
  shift
done

warnings_as_errors=OFF
case "$(c++ --version | head -n 1)" in *Debian*" 12."*) warnings_as_errors=ON ;; esac
options=(-DSEDIMENT_WARNINGS_AS_ERRORS="$warnings_as_errors")
if command -v ccache >/dev/null; then
  options+=(-DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1  # one cache for all checkouts
  export CCACHE_SLOPPINESS=pch_defines,time_macros  # as precompiled headers ask for
  export CCACHE_DEPEND=1  # a file that is not in the cache is not preprocessed twice
fi
# On a new machine nothing is known from before: fewer, larger files to compile. The build folder keeps that choice.
cached=$(ccache --print-stats 2>/dev/null | awk '$1 == "files_in_cache" { print $2 }') || true
if [ ! -e "build/$preset/CMakeCache.txt" ] && [ "${cached:-0}" -lt 100 ]; then options+=(-DSEDIMENT_TOGETHER=ON); fi

log=$(mktemp)
trap 'rm -f "$log"' EXIT
cmake --preset "$preset" "${options[@]}" >"$log" 2>&1 || { cat "$log" >&2; exit 1; }
cmake --build --preset "$preset" ${targets:+--target} "${targets[@]}"
