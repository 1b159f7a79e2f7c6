#!/usr/bin/env bash
# What a change must pass before it goes to main: format, lint, tests, tests with sanitizers.
#
# usage: scripts/check.sh [--all] [--no-format] [--no-scripts] [--no-tidy] [--no-tests] [--no-asan]
#   --all   clang-tidy on every file, not only on those that differ from main
#
# Every step runs even if one before it failed; the summary says which did.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1

all=false skipped=()
for argument in "$@"; do
  case "$argument" in
    --all) all=true ;;
    --no-format | --no-scripts | --no-tidy | --no-tests | --no-asan) skipped+=("${argument#--no-}") ;;
    -h | --help) sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "$0"; exit 0 ;;
    *) echo "check: unknown argument $argument (--help explains)" >&2; exit 2 ;;
  esac
done

# changed_sources: C++ sources that differ from the commit where this branch left main (on main: from the commit before).
changed_sources() {
  local base
  if $all; then git ls-files '*.cpp'; return; fi
  base=$(git merge-base HEAD origin/main 2>/dev/null || git merge-base HEAD main 2>/dev/null || git rev-parse HEAD)
  [ "$base" != "$(git rev-parse HEAD)" ] || base=$(git rev-parse --verify -q HEAD~ || git hash-object -t tree /dev/null)
  { git diff --name-only --diff-filter=d "$base" -- '*.cpp'; git ls-files -o --exclude-standard -- '*.cpp'; } | sort -u
}

format() { git ls-files -co --exclude-standard '*.cpp' '*.hpp' | xargs -d '\n' clang-format --dry-run -Werror; }
scripts() { git ls-files -co --exclude-standard '*.sh' .ci/run | xargs -d '\n' shellcheck; }
# clang-tidy reads g++'s commands, but not its precompiled headers.
tidy() {
  cmake --preset dev -B build/tidy -DSEDIMENT_TOGETHER=OFF >/dev/null && changed_sources |
    xargs -rd '\n' -n 1 -P "$(nproc)" clang-tidy -p build/tidy --quiet --warnings-as-errors='*'
}
tests() { scripts/test.sh; }
# Leaks are looked for in stages that the runner starts, as it fixes their environment; cmake/leak_suppressions.c names what is not
# ours. Test programs do not look for any.
asan() { ASAN_OPTIONS=${ASAN_OPTIONS:-detect_leaks=0} scripts/test.sh --preset asan; }

summary=() state=0
for step in format scripts tidy tests asan; do
  case " ${skipped[*]-} " in *" $step "*) summary+=("$step: skipped"); continue ;; esac
  echo "== $step"
  started=$SECONDS
  if "$step"; then verdict=good; else verdict=FAILED state=1; fi
  summary+=("$step: $verdict ($((SECONDS - started)) s)")
done
echo "== summary"
printf '  %s\n' "${summary[@]}"
exit $state
