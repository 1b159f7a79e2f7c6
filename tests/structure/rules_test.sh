#!/usr/bin/env bash
# Each rule of structure_test.sh finds a tree that breaks it.
# shellcheck source=tests/support/script_test.sh
source "$(dirname "$0")/../support/script_test.sh"
rules=$root/tests/structure/structure_test.sh
tree=$tmp/tree

# file PATH LINE...
file() { mkdir -p "$tree/$(dirname "$1")"; printf '%s\n' "${@:2}" >"$tree/$1"; }

file pipeline/scene/pose.cpp '#include "pipeline/artifacts/cloud.hpp"'
file pipeline/sorting/radix_sort.cpp '#include "pipeline/scene/pose.hpp"'
file pipeline/motion/flow.cpp '#include "pipeline/artifacts/cloud.hpp"'
file pipeline/artifacts/CMakeLists.txt 'sediment_library(sediment_artifacts LINKS sediment_contract)'
file pipeline/contract/stage.cpp '#include <pipeline/scene/pose.hpp>'
file pipeline/runner/plan.cpp '#include "pipeline/artifacts/cloud.hpp"'
file stages/sor/CMakeLists.txt 'sediment_stage(sor LINKS stage_voxel)'
file stages/sor/outliers.cpp '#include "pipeline/contract/stage.hpp"' '#include "outliers.hpp"'
file stages/voxel/CMakeLists.txt 'sediment_stage(voxel)'
file stages/voxel/README.md 'Voxel'
file stages/voxel/main.cpp "$(yes '//' | head -n 130)"
file stages/voxel/voxel.hpp 'struct Voxel {};'
file tools/render/main.cpp '#include "stages/sor/outliers.hpp"'
file helpers/long.cpp "$(yes '//' | head -n 300)"
file README.md "it lies in $(printf '/%s/' home)somebody" '[a page](nowhere.md)'
file build/compile_commands.json '"command": "c++ -O2 -march=native"'
# A runner that loads OpenCV, and stages that call themselves something else.
mkdir -p "$tree/build/bin"
printf '#!/bin/sh\necho "{\\"stage\\": \\"another\\"}"\n' >"$tree/build/bin/voxel"
chmod +x "$tree/build/bin/voxel"
cp "$tree/build/bin/voxel" "$tree/build/bin/sor"
printf 'int main() {}\n' >"$tmp/empty.c"
cc -Wl,--no-as-needed "$tmp/empty.c" -lopencv_core -o "$tree/build/bin/sediment"

SEDIMENT_BIN=$tree/build/bin run bash "$rules" "$tree"
check "a tree that breaks every rule is refused" same "$code" 1
check "each rule finds what breaks it" same "$(grep '^ok' <<<"$output")" ""
check "there are rules" test "$(grep -c '^FAILED' <<<"$output")" -ge 19
finish
