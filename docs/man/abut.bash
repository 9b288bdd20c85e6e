# bash completion of abut, written by tools/make_command_line_docs.py
_abut() {
  local word="${COMP_WORDS[COMP_CWORD]}" before="${COMP_WORDS[COMP_CWORD-1]}" command="${COMP_WORDS[1]}"
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W 'run resume check report -h --help --version' -- "$word"))
    return
  fi
  case "$command $before" in
    'run --profile') COMPREPLY=($(compgen -W 'standard reference' -- "$word")); return ;;
    'run --interface-law') COMPREPLY=($(compgen -W 'stiffening constant' -- "$word")); return ;;
    'run --orient') COMPREPLY=($(compgen -W 'none auto' -- "$word")); return ;;
    'check --profile') COMPREPLY=($(compgen -W 'standard reference' -- "$word")); return ;;
    'check --orient') COMPREPLY=($(compgen -W 'none auto' -- "$word")); return ;;
  esac
  case "$command $word" in
    'run -'*) COMPREPLY=($(compgen -W '-h --help -o --output --threads --profile --interface-law --checkpoint-every --hash-every --timing --quiet --orient --write-deck --allow-findings' -- "$word")); return ;;
    'resume -'*) COMPREPLY=($(compgen -W '-h --help --deck --threads --checkpoint-every --timing --quiet' -- "$word")); return ;;
    'check -'*) COMPREPLY=($(compgen -W '-h --help --profile --json --orient --write-deck' -- "$word")); return ;;
    'report -'*) COMPREPLY=($(compgen -W '-h --help -o --output --all-fields --quiet' -- "$word")); return ;;
  esac
  COMPREPLY=($(compgen -f -- "$word"))
}
complete -o filenames -F _abut abut
