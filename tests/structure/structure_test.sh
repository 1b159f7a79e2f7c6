#!/usr/bin/env bash
# The rules of CONTRIBUTING.md that a program can check. One function a rule; each prints what breaks it.
# usage: structure_test.sh [TREE]     (another tree than this checkout: for the test of this test)
# shellcheck source=tests/support/script_test.sh
source "$(dirname "$0")/../support/script_test.sh"
cd "${1:-$root}" || exit 1
bin=$SEDIMENT_BIN

# files EXTENSION...: our own files, without what builds and runs leave.
files() {
  local names=() extension
  for extension in "$@"; do names+=(-o -name "*$extension"); done
  find . \( -path ./build -o -path ./out -o -path ./data -o -path ./third_party -o -path ./.git -o -path ./.cache \) -prune \
    -o -type f \( "${names[@]:1}" \) -print
}
nothing() { local found; found=$("$@"); [ -z "$found" ] || { echo "$found"; return 1; }; }
folders_of() { find "$1" -mindepth 2 -maxdepth 2 -name CMakeLists.txt -printf '%h\n' | sort; }

# foreign_includes FOLDER ALLOWED_REGEX: our own headers that the folder's files include though they may not.
foreign_includes() {
  grep -rnE '^ *# *include *[<"](pipeline|stages|tools|tests|benchmarks)/' --include='*.cpp' --include='*.hpp' "$1" |
    grep -vE "[<\"]($2)/"
}
# foreign_links FOLDER ALLOWED_REGEX: our own layers that the folder's CMakeLists.txt names though it may not.
foreign_links() {
  grep -noHE '\b(sediment_(scene|sorting|motion|artifacts|contract|runner)|stage_[a-z0-9-]+|tool_[a-z-]+)\b' "$1/CMakeLists.txt" |
    grep -vE ":($2)$"
}

scene_includes() { foreign_includes pipeline/scene pipeline/scene; foreign_links pipeline/scene sediment_scene; }
sorting_includes() { foreign_includes pipeline/sorting pipeline/sorting; foreign_links pipeline/sorting sediment_sorting; }
motion_includes() {
  foreign_includes pipeline/motion 'pipeline/(scene|motion)'
  foreign_links pipeline/motion 'sediment_(scene|motion)'
}
artifacts_includes() {
  foreign_includes pipeline/artifacts 'pipeline/(scene|artifacts)'
  foreign_links pipeline/artifacts 'sediment_(scene|artifacts)'
}
contract_includes() { foreign_includes pipeline/contract pipeline/contract; foreign_links pipeline/contract sediment_contract; }
runner_includes() {
  foreign_includes pipeline/runner 'pipeline/(contract|runner)'
  foreign_links pipeline/runner 'sediment_(contract|runner)|sediment'
}
stages_include() {
  local stage
  for stage in $(folders_of stages); do
    foreign_includes "$stage" "pipeline/(scene|sorting|motion|artifacts|contract)|$stage"
    foreign_links "$stage" "sediment_(scene|sorting|motion|artifacts|contract)|stage_$(basename "$stage")"
  done
}
algorithms_know_flags() {
  grep -nE '#include "pipeline/contract/(stage|command_line|parameter|description|manifest)' stages/*/*.[ch]pp | grep -v /main.cpp:
}
tools_include() { foreign_includes tools 'pipeline/(scene|artifacts|contract)|tools'; }

junk_drawers() {
  find . \( -path ./build -o -path ./out -o -path ./data -o -path ./third_party -o -path ./.git \) -prune -o -type d \
    \( -name 'util*' -o -name common -o -name core -o -name 'helper*' -o -name misc -o -name types -o -name shared \) -print
}
machine_paths() {
  files .cpp .hpp .sh .txt .cmake .json .yaml .yml .md | xargs -rd '\n' grep -nE '(^|[^a-zA-Z0-9_.~-])/(work|tmp|home|root|Users)/'
}
native_code() { grep -oE -- '-m(arch|tune|cpu)=native' compile_commands.json | sort -u; }
long_files() { files .cpp .hpp .sh | xargs -rd '\n' wc -l | awk '$2 != "total" && $1 > 250 { print $2 ": " $1 " lines" }'; }
long_mains() { wc -l stages/*/main.cpp | awk '$2 != "total" && $1 > 120 { print $2 ": " $1 " lines" }'; }
unguarded_headers() { files .hpp | xargs -rd '\n' grep -L '^#pragma once'; }
relative_includes() { files .cpp .hpp | xargs -rd '\n' grep -nE '#include "(\.|[^/"]+")'; }
incomplete_stages() {
  local stage file
  for stage in $(folders_of stages); do
    for file in README.md main.cpp; do [ -f "$stage/$file" ] || echo "$stage/$file is missing"; done
  done
}
misnamed_stages() {
  local stage name
  for stage in $(folders_of stages); do
    name=$(basename "$stage")
    "$bin/$name" --describe 2>/dev/null | grep -E "\"stage\": *\"$name\"" >/dev/null || echo "$stage: bin/$name does not say that it is $name"
  done
}
heavy_libraries() { (ldd "$bin/sediment" || echo "cannot be read: $bin/sediment, opencv?") | grep -iE 'opencv|pcl|octomap|vtk|onnx|ceres|yolo'; }
unlisted_stages() {
  local stage
  for stage in $(folders_of stages); do
    grep -qF "]($stage/README.md)" README.md || echo "README.md does not name $stage"
  done
}

dead_links() {
  local page link
  files .md | while read -r page; do
    grep -oE '\]\([^)# ]+' "$page" | cut -c3- | grep -vE '^(https?|mailto):' | while read -r link; do
      [ -e "$(dirname "$page")/$link" ] || echo "$page: $link does not exist"
    done
  done
}

check "scene stands on nothing of ours" nothing scene_includes
check "sorting stands on nothing of ours" nothing sorting_includes
check "motion stands on the scene alone" nothing motion_includes
check "artifacts stand on the scene alone" nothing artifacts_includes
check "the contract stands on nothing of ours" nothing contract_includes
check "the runner stands on the contract alone" nothing runner_includes
check "the runner loads neither OpenCV nor PCL" nothing heavy_libraries
check "a stage stands on scene, sorting, motion, artifacts and contract, not on another stage or the runner" nothing stages_include
check "the algorithm of a stage knows no flags" nothing algorithms_know_flags
check "tools stand on neither stages nor the runner" nothing tools_include
check "a stage has a page and a main.cpp" nothing incomplete_stages
check "a stage's executable has the name of its folder" nothing misnamed_stages
check "the README lists every stage" nothing unlisted_stages
check "every link between pages leads somewhere" nothing dead_links
check "a stage's main.cpp is a declaration and a call" nothing long_mains
check "no folder is a junk drawer" nothing junk_drawers
check "no file has more than 250 lines" nothing long_files
check "headers are included once" nothing unguarded_headers
check "our headers are included by their path from the root" nothing relative_includes
check "no path of one machine is written down" nothing machine_paths
cd "$bin/.." || exit 1
check "nothing is built for one machine's processor" nothing native_code
finish
