# shellcheck shell=bash
# Sourced by the tests here: a small synthetic sequence with its truth, and what the pipeline reads of it.
# shellcheck source=tests/support/script_test.sh
source "$(dirname "${BASH_SOURCE[0]}")/../support/script_test.sh"
bin=$SEDIMENT_BIN
paper=$root/configs/paper/pipeline.yaml
stages="segment interaction-mask track fuse sor voxel octree project2d"

# make_scene DIR: 24 frames with two people, in the layout of the TUM benchmark, with truth/.
make_scene() {
  "$bin/synthesize" walking --out "$1" --frames 24 --width 320 --height 240 --seed 7 >"$tmp/synthesize.log" 2>&1 ||
    { cat "$tmp/synthesize.log"; exit 1; }
}

# map DIR ARGUMENT...: runs the paper's pipeline with the masks of the renderer.
map() { "$bin/sediment" run "$paper" --out "$1" --set segment.engine=given "${@:2}"; }

# results DIR: the manifests of all stages, in one text.
results() {
  local stage
  for stage in $stages; do echo "$stage"; cat "$1/$stage/manifest.json" || return 1; done
}
