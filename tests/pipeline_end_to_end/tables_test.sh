#!/usr/bin/env bash
# scripts/sweep.sh on a small synthetic recording: tables with a figure in every column, the same again, each with receipts.
# shellcheck source=tests/pipeline_end_to_end/small_scene.sh
source "$(dirname "$0")/small_scene.sh"
make_scene "$tmp/walking"
out=$tmp/out

sweep() { "$root/scripts/sweep.sh" "$@" --rendered "$tmp/walking" --out "$out"; }
# column FILE HEADING: its values, one a line.
column() {
  awk -F, -v heading="$2" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == heading) n = i; next } { print $n }' "$1"
}

run sweep ablation
check "a sweep over four pipelines ends well" same "$code" 0
table=$out/tables/ablation.csv
check "each pipeline has its row" same "$(column "$table" sweep | tr '\n' ' ')" "1_no_masks 2_prior_only 3_paper 4_full "
for heading in "ATE RMSE [m]" "RPE 1 s [m]" "coverage [%]" "PR 5 cm [%]" "RR 5 cm [%]" "dense [MB]" "map.ot [MB]" "time [s]"; do
  check "each row has $heading" test "$(column "$table" "$heading" | grep -c '[0-9]')" = 4
done
missing=0
while read -r receipt; do
  prefix=${receipt#x3:}
  compgen -G "$out/store/receipts/${prefix:0:2}/${prefix:2}*" >/dev/null || missing=$((missing + 1))
done < <(grep -oE 'x3:[0-9a-f]{8}' "$table")
check "rows name receipts" grep -qE 'x3:[0-9a-f]{8}' "$table"
check "every receipt that a row names is in the store" same $missing 0
check "people stay in the map without masks, and go with them" awk -F'|' -v f="$(column "$table" "RR 5 cm [%]" | tr '\n' '|')" \
  'BEGIN { split(f, rr, "|"); exit !(rr[1] < rr[2] && rr[2] <= rr[3] + 1) }'
for format in md tex; do check "the table is there as $format" test -s "$out/tables/ablation.$format"; done

# Times are those of the run that made a result: what is kept keeps them, so that the tables are equal to the byte.
cp "$table" "$tmp/before.csv"
run sweep ablation
check "a second run gives the same table" cmp "$table" "$tmp/before.csv"

run sweep paper --facts-only
check "the paper's sweeps end well" same "$code" 0
"$bin/tabulate" paper "$out"/facts/sizes.*.json --band "$out"/facts/band_frames_voxels.*.json \
  --band "$out"/facts/band_voxels_octree.*.json --out "$tmp/paper" >"$tmp/paper.md"
check "all eight sequences of the paper are named as missing" same \
  "$(grep -c 'fr2/rpy.*fr2/desk/p.*fr3/s/half.*fr3/s/static.*fr3/w/half.*fr3/w/rpy.*fr3/w/static.*fr3/w/xyz' "$tmp/paper.md")" 1
check "the bands have every voxel size" grep -qF '| 0.005 m | 0.01 m | 0.02 m | 0.03 m | 0.05 m |' "$tmp/paper.md"
check "the chart is a picture" grep -q '</svg>' "$tmp/paper_sizes.svg"
refuses "a sweep that does not exist" 2 "there is no sweep" "$root/scripts/sweep.sh" ablations --rendered "$tmp/walking"
refuses "recordings without a network" 2 "needs --model" "$root/scripts/sweep.sh" tum --data "$tmp/walking" --out "$tmp/no"
mkdir "$tmp/empty"
refuses "a folder without recordings" 2 "holds no recording" "$root/scripts/sweep.sh" tum --rendered "$tmp/empty" --out "$tmp/no"
finish
