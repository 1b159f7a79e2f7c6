#!/usr/bin/env bash
# A download survives interruptions: scripts/download_tum.sh against a server that breaks off.
# usage: download_tum_test.sh FLAKY_HTTP_SERVER
# shellcheck source=tests/support/script_test.sh
source "$(dirname "$0")/../support/script_test.sh"
server=$1
download=$root/scripts/download_tum.sh

# A sequence of 250 kB that does not compress, as on the benchmark's site.
name=rgbd_dataset_freiburg1_xyz
mkdir -p "$tmp/site/freiburg1" "$tmp/made/$name/rgb"
head -c 250000 /dev/urandom >"$tmp/made/$name/rgb/1.png"
touch "$tmp/made/$name/rgb.txt" "$tmp/made/$name/depth.txt"
tar -czf "$tmp/site/freiburg1/$name.tgz" -C "$tmp/made" "$name"
bytes=$(stat -c %s "$tmp/site/freiburg1/$name.tgz")

# serve LOG CUT_BYTES [FLAG]: starts a server and names it in SEDIMENT_TUM_URL.
serve() {
  "$server" "$tmp/site" "${@:2}" >"$tmp/$1" &
  await "$tmp/$1"
  export SEDIMENT_TUM_URL
  SEDIMENT_TUM_URL=http://127.0.0.1:$(head -n 1 "$tmp/$1")
}
first_bytes() { tail -n +2 "$tmp/$1" | cut -d' ' -f2 | tr '\n' ' '; }
whole() { diff -r "$tmp/made/$name" "$1/$name"; }
nothing_else() { same "$(find "$1" -mindepth 1 -maxdepth 1 ! -name '.*.lock' | sort)" "$1/$name"; }

serve broken 100000
run "$download" --to "$tmp/a folder" fr1/xyz
check "an interrupted download goes on by itself" same "$code" 0
check "the folder's path is the last line of the output" same "$(tail -n 1 <<<"$output")" "$tmp/a folder/$name"
check "it goes on where it stopped" same "$(first_bytes broken)" "0 100000 200000 "
check "what arrives is whole" whole "$tmp/a folder"
check "no archive and no half folder is left" nothing_else "$tmp/a folder"

SEDIMENT_TUM_URL=http://127.0.0.1:9 run "$download" --to "$tmp/a folder" freiburg1_xyz "$name"
check "a sequence that is there needs no server" same "$code" 0

mkdir "$tmp/killed"
head -c 70000 "$tmp/site/freiburg1/$name.tgz" >"$tmp/killed/$name.tgz.part"
mkdir "$tmp/killed/$name.partial"
serve resumed 0
check "a download that was killed ends with the next call" "$download" --to "$tmp/killed" fr1/xyz
check "that call fetches only the rest" same "$(first_bytes resumed)" "70000 "
check "what arrives in two calls is whole" whole "$tmp/killed"
check "no rest of the killed call is left" nothing_else "$tmp/killed"

mkdir "$tmp/complete"
cp "$tmp/site/freiburg1/$name.tgz" "$tmp/complete/$name.tgz.part"
check "a download killed after its last byte ends with the next call" "$download" --to "$tmp/complete" fr1/xyz
check "it is whole" whole "$tmp/complete"

serve rangeless 0 --no-ranges
mkdir "$tmp/rangeless_data"
head -c 70000 "$tmp/site/freiburg1/$name.tgz" >"$tmp/rangeless_data/$name.tgz.part"
check "a server that cannot resume is asked from the start" "$download" --to "$tmp/rangeless_data" fr1/xyz
check "what it sends is whole" whole "$tmp/rangeless_data"

head -c "$bytes" /dev/urandom >"$tmp/site/freiburg1/rgbd_dataset_freiburg1_desk.tgz"
refuses "a damaged archive is an error and removed" 1 "was damaged and is removed" "$download" --to "$tmp/bad" fr1/desk
check "nothing of it stays" same "$(find "$tmp/bad" -mindepth 1 ! -name '.*.lock')" ""
refuses "a sequence that the server has not is an error" 1 "the server answers 404" "$download" --to "$tmp/bad" fr2/xyz
refuses "an unknown sequence is a wrong call" 2 "unknown sequence fr1/xyzzy" "$download" fr1/xyzzy
refuses "no sequence is a wrong call" 2 "which sequence?" "$download"
finish
