# Completion of abut for bash. Written by tools/command_line.py from the program's --help; do not edit.
_abut() {
  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} verb= word
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    case $word in run|resume|check|report|replay|keywords) verb=$word; break ;; esac
  done
  COMPREPLY=()
  case $verb:$before in
    run:-o|run:--output) COMPREPLY=($(compgen -d -- "$current")); return ;;
    run:--threads) return ;;
    run:--profile) COMPREPLY=($(compgen -W 'standard reference' -- "$current")); return ;;
    run:--interface) return ;;
    run:--checkpoint-every) return ;;
    run:--record-contact) return ;;
    run:--hash-every) return ;;
    run:--orient) COMPREPLY=($(compgen -W 'none auto' -- "$current")); return ;;
    run:--write-deck) COMPREPLY=($(compgen -f -- "$current")); return ;;
    resume:--deck) COMPREPLY=($(compgen -f -- "$current")); return ;;
    resume:--threads) return ;;
    resume:--checkpoint-every) return ;;
    check:--profile) COMPREPLY=($(compgen -W 'standard reference' -- "$current")); return ;;
    check:--interface) return ;;
    check:--orient) COMPREPLY=($(compgen -W 'none auto' -- "$current")); return ;;
    check:--write-deck) COMPREPLY=($(compgen -f -- "$current")); return ;;
    report:-o|report:--output) COMPREPLY=($(compgen -f -- "$current")); return ;;
  esac
  case $verb in
    run) COMPREPLY=($(compgen -W '-h --help -o --output --threads --profile --interface --checkpoint-every --record-contact --hash-every --timing --quiet --orient --write-deck --allow-findings' -- "$current")); [[ $current == -* ]] || COMPREPLY=($(compgen -d -- "$current") $(compgen -f -X '!*_[0-9][0-9][0-9][0-9].rad' -- "$current")) ;;
    resume) COMPREPLY=($(compgen -W '-h --help --deck --threads --checkpoint-every --timing --quiet' -- "$current")) ;;
    check) COMPREPLY=($(compgen -W '-h --help --profile --interface --json --orient --write-deck' -- "$current")); [[ $current == -* ]] || COMPREPLY=($(compgen -d -- "$current") $(compgen -f -X '!*_[0-9][0-9][0-9][0-9].rad' -- "$current")) ;;
    report) COMPREPLY=($(compgen -W '-h --help -o --output --all-fields --quiet' -- "$current")); [[ $current == -* ]] || COMPREPLY=($(compgen -d -- "$current")) ;;
    replay) COMPREPLY=($(compgen -W '-h --help --steps' -- "$current")) ;;
    keywords) COMPREPLY=($(compgen -W '-h --help' -- "$current")) ;;
    *) COMPREPLY=($(compgen -W 'run resume check report replay keywords -h --help --version' -- "$current")) ;;
  esac
}
complete -o filenames -F _abut abut
