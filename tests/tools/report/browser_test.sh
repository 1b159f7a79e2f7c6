#!/usr/bin/env bash
# The page of a run and that of a sweep, opened in headless Chromium: browser_test.mjs says what must hold.
# shellcheck source=tests/pipeline_end_to_end/small_scene.sh
source "$(dirname "$0")/../../pipeline_end_to_end/small_scene.sh"
for program in chromium node; do
  command -v $program >/dev/null || { echo "skipped: needs $program"; exit 0; }
done
"$root/scripts/fetch_web.sh" --check 2>/dev/null || { echo "skipped: needs third_party/web (scripts/fetch_web.sh)"; exit 0; }
here=$root/tests/tools/report

make_scene "$tmp/scene"
export SEQUENCE=$tmp/scene MASKS=$tmp/scene/truth/instances
unset MODEL POSES
map "$tmp/run" >"$tmp/run.log" 2>&1 || { cat "$tmp/run.log"; exit 1; }
# Eight instances that differ in two parameters behind the cloud: the run's results are the shared part of them.
cat >"$tmp/sweep.yaml" <<YAML
pipeline: $root/configs/paper
set: {segment.engine: given}
over:
  - voxel.leaf: [0.02, 0.03, 0.04, 0.05]
  - sor.neighbors: [20, 30]
YAML
"$bin/sediment" sweep "$tmp/sweep.yaml" --out "$tmp/sweep" --store "$tmp/run/.sediment" >"$tmp/sweep.log" 2>&1 ||
  { cat "$tmp/sweep.log"; exit 1; }

run "$bin/sediment" report "$tmp/run" --frames 8
check "a run has a page" same "$code" 0
check "everything of it is shown" test -z "$(grep 'not shown' <<<"$output")"
run "$bin/sediment" report "$tmp/sweep" --store "$tmp/run/.sediment" --page "$tmp/sweep.html" --frames 8
check "a sweep has a page" same "$code" 0
check "it holds all instances" says "8 instances"
check "equal content gives an equal page" "$bin/sediment" report "$tmp/sweep" --store "$tmp/run/.sediment" \
  --page "$tmp/again.html" --frames 8
check "to the byte" cmp "$tmp/sweep.html" "$tmp/again.html"
refuses "a folder without results" 2 "no folder of results" "$bin/sediment" report "$tmp/scene"

for page in "$tmp/run/report.html" "$tmp/sweep.html"; do
  check "a page is under 15 MB" test "$(stat -c %s "$page")" -lt 15000000
  check "a page needs nothing from a network" test -z "$(grep -oE '(src|href)="(https?:)?//' "$page")"
done
NODE_PATH=$root/third_party/web/node_modules node "$here/browser_test.mjs" "$tmp/run/report.html" "$tmp/sweep.html" \
  "${REPORT_PICTURES:-}" || failures=$((failures + 1))
finish
