# Completes verbs, options and the values of options that have a few, as the help of chironomia lists them.
_chironomia_complete() {
    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} help word choices
    local verb=()
    for word in "${COMP_WORDS[@]:1:$((COMP_CWORD - 1))}"; do
        [[ $word == -* ]] && break
        verb+=("$word")
    done
    help=$("${COMP_WORDS[0]}" "${verb[@]}" --help 2>/dev/null) || return 0
    if [[ $current == -* ]]; then
        choices=$(grep -oE '^  (-[a-z],)?--[a-z0-9-]+' <<<"$help" | grep -oE -- '--.+')
    elif [[ $previous == --* ]]; then
        choices=$(sed -nE "s/^  $previous ([^ ]*\|[^ ]*).*/\1/p" <<<"$help" | tr '|' '\n')
    else
        choices=$(sed -nE '/^Subcommands:/,$ s/^  ([a-z]+) .*/\1/p' <<<"$help")
    fi
    COMPREPLY=($(compgen -W "$choices" -- "$current"))
}
# Where nothing is found files are completed.
complete -o default -F _chironomia_complete chironomia
