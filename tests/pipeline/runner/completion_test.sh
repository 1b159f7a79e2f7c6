#!/usr/bin/env bash
# Completion in bash, asked as bash asks it.
# shellcheck source=tests/support/script_test.sh
source "$(dirname "$0")/../../support/script_test.sh"
cd "$tmp" || exit 1
mkdir results
PATH=$SEDIMENT_BIN:$PATH
cat >pipeline.yaml <<'YAML'
sources: {sequence: {kind: sequence, path: ${SEQUENCE}}}
stages:
  segment: {reads: {sequence: sequence}}
  sor: {reads: {cloud: segment.cloud}}
YAML
printf 'pipeline: pipeline.yaml\nover: [{sor.neighbors: [1, 2]}]\n' >sweep.yaml
# shellcheck source=/dev/null
source <(sediment completion bash)
compopt() { :; }  # only works while bash completes

# offers WORD...: what is offered for the last word.
offers() {
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMPREPLY=()
  _sediment
  echo "${COMPREPLY[*]}"
}
commands_of_help() { sediment --help | sed -n '/^Subcommands:/,$s/^  \([a-z]*\) .*/\1/p'; }
every_command() {
  local command
  for command in $(commands_of_help); do [ "$(offers sediment "$command")" = "$command" ] || { echo "$command"; return 1; }; done
}
every_flag() {
  local command flag
  for command in $(commands_of_help); do
    for flag in $(sediment "$command" --help | grep -oE '(^|[ ,])--[a-z-]+' | tr -d ' ,'); do
      grep -qw -- "$flag" <<<"$(offers sediment "$command" --)" || { echo "$command $flag"; return 1; }
    done
  done
}
check "help lists more than ten commands" test "$(commands_of_help | wc -l)" -gt 10
check "every command that --help lists is offered" every_command
check "every flag that the --help of a command lists is offered, of every command" every_flag
check "a command is completed" same "$(offers sediment com)" "compare completion"
check "a flag is completed" same "$(offers sediment run --keep)" "--keep-going"
check "the choices of a flag are offered" same "$(offers sediment graph pipeline.yaml --format '')" "text mermaid dot"
check "also behind an equals sign" same "$(offers sediment graph --format = m)" "mermaid"
check "a pipeline is a file" same "$(offers sediment run pipe)" "pipeline.yaml"
check "a folder of results is a folder" same "$(offers sediment table r)" "results"
check "stages come from the pipeline" same "$(offers sediment why pipeline.yaml s)" "segment sor"
check "stages of a flag too, whatever stands between" \
  same "$(offers sediment run pipeline.yaml -j 2 --set sor.neighbors = 3 --only so)" "sor"
check "a sweep has the stages of its pipeline" same "$(offers sediment log sweep.yaml se)" "segment"
check "settings are sources and parameters" same "$(offers sediment run pipeline.yaml --set sor.nei)" "sor.neighbors="
check "sources among them" same "$(offers sediment run pipeline.yaml --set seq)" "sequence="
check "a file that is no pipeline offers nothing" same "$(offers sediment why nothing.yaml s)" ""
finish
