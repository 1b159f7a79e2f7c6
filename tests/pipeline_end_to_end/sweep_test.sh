#!/usr/bin/env bash
# 4 sequences x 3 voxel sizes x 2 settings of the outlier removal: what instances share runs once, and the table of the
# sweep is the one made by hand from the sizes of the files.
# shellcheck source=tests/pipeline_end_to_end/small_scene.sh
source "$(dirname "$0")/small_scene.sh"
cd "$tmp" || exit 1
sequences=(one two three four) leaves=(0.01 0.02 0.05) neighbors=(20 50)
unset MODEL POSES SEQUENCE MASKS
seed=0
for sequence in "${sequences[@]}"; do
  "$bin/synthesize" walking --out "$sequence" --frames 8 --width 320 --height 240 --seed $((++seed)) >log 2>&1 || { cat log; exit 1; }
done
list() { local IFS=,; echo "[$*]"; }
cat >sizes.yaml <<YAML
pipeline: $paper
over:
  - {sequence: $(list "${sequences[@]}"), masks: $(list "${sequences[@]/%//truth/instances}")}
  - voxel.leaf: $(list "${leaves[@]}")
  - sor.neighbors: $(list "${neighbors[@]}")
set: {segment.engine: given}
YAML
sweep() { run "$bin/sediment" sweep sizes.yaml -j2; }
# ran STAGE: how often the closing table says that it ran.
ran() { awk -v stage="$1" '$1 == stage { print $3 }' <<<"$output"; }
# sized FOLDER FILE: bytes of a file of an instance.
sized() { stat -Lc %s "out/sizes/$1/$2"; }

sweep
check "the sweep succeeds" same "$code" 0 || echo "$output"
for stage in segment interaction-mask track fuse; do
  check "$stage runs once a sequence" same "$(ran $stage)" 4
done
check "sor runs once for each of its settings" same "$(ran sor)" 8
for stage in voxel octree project2d; do check "$stage runs for every instance" same "$(ran $stage)" 24; done

by_hand() {
  echo "sequence,voxel.leaf,sor.neighbors,fuse.cloud.pcd,sor.cloud.pcd,voxel.cloud.pcd,octree.map.ot"
  local s v n folder
  for s in "${sequences[@]}"; do for v in "${leaves[@]}"; do for n in "${neighbors[@]}"; do
    folder=$s/voxel.leaf=$v,sor.neighbors=$n
    echo "$s,$v,$n,$(sized "$folder" fuse/cloud.pcd),$(sized "$folder" sor/cloud.pcd),$(sized "$folder" voxel/cloud.pcd),$(sized "$folder" octree/map.ot)"
  done; done; done
}
table() { "$bin/sediment" table out/sizes "$@"; }
values=(--value fuse.cloud.pcd --value sor.cloud.pcd --value voxel.cloud.pcd --value octree.map.ot)
check "its table has the sizes of the files" diff <(by_hand) <(table "${values[@]}" --format csv)
sweep
check "a second sweep runs nothing" says "192 kept in"
check "and prints the table" says "| four     | 0.05       | 50"
finish
