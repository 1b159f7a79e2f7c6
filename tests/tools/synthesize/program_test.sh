#!/bin/bash
# synthesize as a user calls it.
# shellcheck source=tests/support/script_test.sh
source "$(dirname "${BASH_SOURCE[0]}")/../../support/script_test.sh"
bin=$SEDIMENT_BIN
small=(--frames 4 --rate 2 --width 160 --height 120)

run "$bin/synthesize" --help
check "the help names every scene" says kidnapped
check "the help ends well" same "$code" 0
refuses "a wrong scene names the nearest" 2 "did you mean 'carried-box'" "$bin/synthesize" carriedbox --out "$tmp/a"
refuses "a wrong flag is refused" 2 "--frame" "$bin/synthesize" static --out "$tmp/a" --frame 3
refuses "no frames are refused" 2 "frames" "$bin/synthesize" static --out "$tmp/a" --frames 0
refuses "an output is needed" 2 "--out" "$bin/synthesize" static
refuses "a tiny image is refused" 2 "16 .. 8192" "$bin/synthesize" static --out "$tmp/a" --width 3
check "nothing was written by wrong calls" test ! -e "$tmp/a"

check "one thread writes a sequence" "$bin/synthesize" walking --out "$tmp/one" "${small[@]}" --threads 1
check "four threads write one" "$bin/synthesize" walking --out "$tmp/four" "${small[@]}" --threads 4
check "equal flags give equal bytes at any thread count" diff -r "$tmp/one" "$tmp/four"
check "another seed is written" "$bin/synthesize" walking --out "$tmp/other" "${small[@]}" --seed 2
refuses "another seed gives other bytes" 1 "differ" diff -rq "$tmp/one" "$tmp/other"
refuses "a folder that is not empty is left alone" 2 "is not empty" "$bin/synthesize" walking --out "$tmp/one" "${small[@]}"
check "there is a picture for each line" same "$(find "$tmp/one/rgb" "$tmp/one/depth" -name '*.png' | wc -l)" 8
check "there is nothing but the sequence" same "$(cd "$tmp/one" && echo *)" \
  "accelerometer.txt camera.txt depth depth.txt groundtruth.txt rgb rgb.txt sequence.yaml truth"
check "masks are written for each frame" same "$(find "$tmp/one/truth" -path '*masks*' -name '*.png' | wc -l)" 8

check "extras are written on demand" "$bin/synthesize" static --out "$tmp/extras/" --frames 2 --width 64 --height 48 --clean-depth --degrade-masks
check "there is exact depth" same "$(find "$tmp/extras/truth/depth" -name '*.png' | wc -l)" 2
check "there are degraded masks" test -s "$tmp/extras/truth/degraded_instances/instances.json"
check "nothing partial is left" same "$(find "$tmp" -name '*.partial')" ""
finish
