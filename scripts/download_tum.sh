#!/usr/bin/env bash
# Downloads sequences of the TUM RGB-D benchmark (CC BY 4.0) and prints the folder of each.
#
# usage: scripts/download_tum.sh [--to DIR] SEQUENCE...
#        scripts/download_tum.sh --list
#   SEQUENCE   rgbd_dataset_freiburg1_xyz, freiburg1_xyz, fr1/xyz; also as papers shorten it: fr3/w/half
#   --to DIR   where they are and go to: default $SEDIMENT_DATA, else data/ in the checkout
#   --list     the names of all sequences
#
# A sequence that is there is left alone. A broken download is resumed where it stopped, by itself or by the next call;
# a sequence's folder appears by one rename, so it is whole or absent. $SEDIMENT_TUM_URL names a mirror.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
mirror=${SEDIMENT_TUM_URL:-https://cvg.cit.tum.de/rgbd/dataset}
freiburg1="360 desk desk2 floor plant room rpy teddy xyz"
freiburg2="360_hemisphere 360_kidnap coke desk desk_with_person dishes flowerbouquet flowerbouquet_brownbackground
  large_no_loop large_with_loop metallic_sphere metallic_sphere2 pioneer_360 pioneer_slam pioneer_slam2 pioneer_slam3
  rpy xyz"
freiburg3="cabinet large_cabinet long_office_household nostructure_notexture_far nostructure_notexture_near_withloop
  nostructure_texture_far nostructure_texture_near_withloop sitting_halfsphere sitting_rpy sitting_static sitting_xyz
  structure_notexture_far structure_notexture_near structure_texture_far structure_texture_near teddy
  walking_halfsphere walking_rpy walking_static walking_xyz"

say() { echo "download_tum: $*" >&2; }
fail() { say "$*"; exit 1; }
wrong_call() { say "$* (--help explains)"; exit 2; }

known_names() {
  local name
  for name in $freiburg1; do echo "freiburg1_$name"; done
  for name in $freiburg2; do echo "freiburg2_$name"; done
  for name in $freiburg3; do echo "freiburg3_$name"; done
}

# canonical NAME: freiburg3_walking_halfsphere for each way to write it.
canonical() {
  sed -E 's#^rgbd_dataset_##; s#/#_#g; s#^fr([123])_#freiburg\1_#; s#^(freiburg3)_w_#\1_walking_#
          s#^(freiburg3)_s_#\1_sitting_#; s#_half$#_halfsphere#; s#^(freiburg2_desk)_p$#\1_with_person#' <<<"$1"
}

# fetch URL FILE: FILE.part grows over as many attempts as it takes while each brings something or five have not.
fetch() {
  local url=$1 file=$2 code state before after idle=0 progress=-sS
  [ ! -t 2 ] || progress=--progress-bar
  while true; do
    before=$(stat -c %s "$file.part" 2>/dev/null || echo 0)
    state=0
    code=$(curl -fL $progress -C - --connect-timeout 20 --speed-limit 1000 --speed-time 60 -w '%{http_code}' \
      -o "$file.part" "$url") || state=$?
    # 416: nothing is left to send, an earlier call was killed after the last byte
    if [ $state = 0 ] || [ "$code" = 416 ]; then break; fi
    [ $state != 23 ] || fail "$file.part cannot be written (disk full?)"
    case "$code" in 401 | 403 | 404 | 410) fail "$url: the server answers $code" ;; esac
    [ $state != 33 ] || rm -f "$file.part"  # a server that cannot resume: from the start
    after=$(stat -c %s "$file.part" 2>/dev/null || echo 0)
    if [ "$after" -gt "$before" ]; then idle=0; else idle=$((idle + 1)); fi
    [ $idle -lt 5 ] || fail "$url: no progress in 5 attempts (curl says $state); the next call goes on at $after bytes"
    say "interrupted at $after bytes, going on"
    sleep $((1 + idle))
  done
  mv "$file.part" "$file"
}

# unpack ARCHIVE NAME FOLDER
unpack() {
  local archive=$1 name=$2 folder=$3 partial=$3.partial
  rm -rf "$partial"
  mkdir "$partial"
  if ! tar -xzf "$archive" --no-same-owner -C "$partial"; then
    rm -rf "$archive" "$partial"
    fail "$archive was damaged and is removed: run again to download it anew"
  fi
  [ -f "$partial/$name/rgb.txt" ] || fail "$archive has no $name/rgb.txt; it is not a sequence of the benchmark"
  mv -T "$partial/$name" "$folder"
  rm -rf "$partial" "$archive"
}

# provide NAME: prints the folder.
provide() {
  local name=rgbd_dataset_$1
  local folder=$data/$name archive=$data/$name.tgz
  if [ ! -d "$folder" ]; then
    mkdir -p "$data"
    exec 9>"$data/.$name.lock"
    flock 9  # two at once: the second waits and finds the work done
    if [ ! -d "$folder" ]; then
      command -v curl >/dev/null || fail "curl is needed: apt-get install curl"
      say "$mirror/${1%%_*}/$name.tgz -> $folder"
      [ -f "$archive" ] || fetch "$mirror/${1%%_*}/$name.tgz" "$archive"
      unpack "$archive" "$name" "$folder"
    fi
    exec 9>&-
  fi
  echo "$folder"
}

data=${SEDIMENT_DATA:-$root/data}
names=()
while [ $# -gt 0 ]; do
  case "$1" in
    -h | --help) sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "$0"; exit 0 ;;
    --list) known_names; exit 0 ;;
    --to) data=$(realpath -m "${2:?"download_tum: --to needs a folder"}"); shift ;;
    -*) wrong_call "unknown flag $1" ;;
    *)
      name=$(canonical "$1")
      grep -qxF "$name" <<<"$(known_names)" || wrong_call "unknown sequence $1; --list names all"
      names+=("$name") ;;
  esac
  shift
done
[ ${#names[@]} -gt 0 ] || wrong_call "which sequence?"
for name in "${names[@]}"; do provide "$name"; done
