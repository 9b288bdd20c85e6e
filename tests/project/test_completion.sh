# The completion of bash: what it offers in a few places. usage: bash test_completion.sh docs/man/abut.bash
set -eu
source "$1"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
touch deck_0000.rad deck_0001.rad notes.txt
mkdir results

offers() {  # offers EXPECTED WORD ...: completes the last word
  local expected=$1
  shift
  COMP_WORDS=(abut "$@") COMP_CWORD=$#
  _abut || true
  local word
  for word in $expected; do
    if ! printf '%s\n' "${COMPREPLY[@]}" | grep -qxF -- "$word"; then
      echo "abut $*: '$word' is not offered, but: ${COMPREPLY[*]}"
      exit 1
    fi
  done
  for word in notes.txt; do
    if printf '%s\n' "${COMPREPLY[@]}" | grep -qxF -- "$word"; then
      echo "abut $*: $word is offered"
      exit 1
    fi
  done
}

offers "run check keywords" ""
offers "run" r
offers "--profile --threads" run --
offers "standard reference" run --profile ""
offers "deck_0000.rad results" run ""
offers "results" report ""
offers "--json" check --j
echo "the completion offers what it should"
