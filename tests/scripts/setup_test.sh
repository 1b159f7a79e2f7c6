#!/usr/bin/env bash
# scripts/setup.sh on a machine where things are missing: apt-get, dpkg-query and npm are stand-ins that note their calls.
# shellcheck source=tests/support/script_test.sh
source "$(dirname "$0")/../support/script_test.sh"

# A checkout with only these scripts, so that ONNX Runtime and the page's libraries are missing whatever this machine has.
mkdir -p "$tmp/checkout/scripts" "$tmp/bin"
cp "$root/scripts/setup.sh" "$root/scripts/fetch_onnxruntime.sh" "$root/scripts/fetch_web.sh" "$tmp/checkout/scripts/"
setup=$tmp/checkout/scripts/setup.sh
export PATH=$tmp/bin:$PATH NOTES=$tmp/notes ABSENT=
unset ONNXRUNTIME_ROOT

stand_in() { printf '#!/usr/bin/env bash\n%s\n' "$2" >"$tmp/bin/$1"; chmod +x "$tmp/bin/$1"; }
stand_in dpkg-query 'case " $ABSENT " in *" ${*: -1} "*) echo "no such package" >&2; exit 1 ;; *) echo -n installed ;; esac'
stand_in apt-get 'echo "apt-get $*" >>"$NOTES"'
stand_in sudo 'exec "$@"'
stand_in npm 'echo "npm $*" >>"$NOTES"; exit 1'
noted() { cat "$NOTES" 2>/dev/null; }

run "$setup" --check --no-onnxruntime --no-web
check "--check is content when nothing is missing" same "$code" 0
run "$setup" --no-onnxruntime --no-web
check "with nothing missing set-up succeeds" same "$code" 0
check "with nothing missing apt-get is never called" same "$(noted)" ""

export ABSENT="libpcl-dev catch2"
refuses "--check names what is missing" 1 "missing packages: libpcl-dev catch2" "$setup" --check --no-onnxruntime --no-web
check "--check installs nothing" same "$(noted)" ""
run "$setup" --no-onnxruntime --no-web
check "only what is missing is installed, without recommended packages" same "$(noted)" \
  "apt-get update -q
apt-get install -q -y --no-install-recommends libpcl-dev catch2"

export ABSENT=snakemake
run "$setup" --check --no-onnxruntime --no-web
check "what only benchmarks need is not missed" same "$code" 0
refuses "unless they are asked for" 1 "missing packages: snakemake" "$setup" --check --no-onnxruntime --no-web --benchmarks

ABSENT=
if ! compgen -G '/usr/include/onnxruntime*' >/dev/null && ! compgen -G '/usr/local/include/onnxruntime*' >/dev/null; then
  refuses "--check names a missing ONNX Runtime" 1 "missing: ONNX Runtime" "$setup" --check --no-web
  run "$setup" --no-web
  check "set-up goes on where ONNX Runtime cannot be had" same "$code" 0
  check "and says what that means" says "networks run with OpenCV's engine"
fi
refuses "--check names what the page lacks" 1 "missing: three.js" "$setup" --check --no-onnxruntime
run "$setup" --no-onnxruntime
check "set-up goes on where the page's libraries cannot be had" same "$code" 0
check "and says that reports have no page" says "has no page"
stand_in apt-get 'exit 100'
export ABSENT=libpcl-dev
refuses "a failed installation is a failure" 1 "could not install libpcl-dev" "$setup" --no-onnxruntime --no-web
refuses "an unknown flag is a wrong call" 2 "unknown argument --chek" "$setup" --chek
finish
