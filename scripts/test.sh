#!/usr/bin/env bash
# Set-up, build and all tests. What CI runs, and what to run before a commit.
#
# usage: scripts/test.sh [--preset NAME] [CTEST_ARGUMENT...]
#   --preset NAME    release (default), dev, asan or tsan
#   CTEST_ARGUMENT   handed to ctest: -R sor runs the tests whose names contain "sor"
#
# Tests that need real frames or a network look for them in the folder named by SEDIMENT_SHARED, else in shared/
# beside the checkout; where they are missing the tests are skipped, and said to be at the end.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

preset=release
case "${1-}" in
  -h | --help) sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "$0"; exit 0 ;;
  --preset) preset=${2:?"test: --preset needs a name"}; shift 2 ;;
esac

scripts/setup.sh
scripts/build.sh --preset "$preset"

log=$(mktemp)
trap 'rm -f "$log"' EXIT
state=0
ctest --preset "$preset" --output-on-failure --no-tests=error -j2 "$@" 2>&1 | tee "$log" || state=$?

# ctest shows the output of failed tests only: the reasons of the skipped ones are in its log.
skipped=$(grep -c '\*\*\*Skipped' "$log" || true)
echo
echo "$skipped tests skipped"
if [ "$skipped" -gt 0 ]; then
  grep -ho 'skipped: needs .*' "build/$preset/Testing/Temporary/LastTest.log" | sort | uniq -c | sed 's/^/  /'
fi
grep -E 'tests passed|Total Test time' "$log" || true  # ctest's verdict once more, as the last lines
exit $state
