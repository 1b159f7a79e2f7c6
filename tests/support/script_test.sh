# shellcheck shell=bash
# Sourced by tests in bash: a temporary folder that vanishes, and checks whose names are sentences.
set -uo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
tmp=$(mktemp -d)
trap 'kill $(jobs -p) 2>/dev/null; rm -rf "$tmp"' EXIT
export SEDIMENT_BIN=${SEDIMENT_BIN:-$root/build/release/bin}
failures=0

# check SENTENCE COMMAND...: the command succeeds.
check() {
  local sentence=$1
  shift
  if "$@" >"$tmp/.check" 2>&1; then
    echo "ok: $sentence"
  else
    echo "FAILED: $sentence: $*"
    sed 's/^/    /' "$tmp/.check"
    failures=$((failures + 1))
  fi
}

# run COMMAND...: leaves the exit code in $code and both outputs in $output.
run() {
  code=0
  output=$("$@" 2>&1) || code=$?
}

# refuses SENTENCE CODE WORDS COMMAND...: the command exits with CODE and says WORDS.
refuses() {
  local sentence=$1 expected=$2 words=$3
  shift 3
  run "$@"
  if [ "$code" = "$expected" ] && grep -qF -- "$words" <<<"$output"; then
    echo "ok: $sentence"
  else
    echo "FAILED: $sentence: expected exit code $expected and \"$words\", found $code and:"
    sed 's/^/    /' <<<"$output"
    failures=$((failures + 1))
  fi
}

says() { grep -qF -- "$1" <<<"$output"; }
same() { [ "$1" = "$2" ] || { echo "expected \"$2\", found \"$1\""; return 1; }; }

# await FILE: waits until the file has content, ten seconds at most.
await() {
  local tries
  for tries in $(seq 200); do
    [ ! -s "$1" ] || return 0
    sleep 0.05
  done
  echo "FAILED: $1 stays empty"
  exit 1
}

# The last line of each test.
finish() { [ "$failures" = 0 ] || { echo "$failures checks failed"; exit 1; }; }
