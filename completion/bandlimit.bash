# SPDX-License-Identifier: MIT
#
# Completion of bandlimit for bash. All names come from the program itself; the tests
# t-cli-help and t-registries hold the options and the kinds to it.

_bandlimit_names() {
    "${COMP_WORDS[0]}" list "$1" --names 2>/dev/null
}

# The keys that a noise takes.
_bandlimit_keys() {
    "${COMP_WORDS[0]}" show "$1" --json 2>/dev/null | sed -n 's/^ *"key": "\(.*\)",*$/\1/p'
}

_bandlimit() {
    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}
    local verbs=$(_bandlimit_names verbs)
    local common="--json -o --output --seed --threads --quick --full --isa -q --quiet -h --help
        --version"
    local spectral="--dims --axis --rate --size --average --window --place --level"
    local verb="" options="" words="" word files=""
    local i name prefix

    # bash splits --name=VALUE at the equals sign.
    if [[ $current == "=" ]]; then
        current=""
    elif [[ $previous == "=" ]]; then
        previous=${COMP_WORDS[COMP_CWORD - 2]}
    fi
    case $previous in
    --window) COMPREPLY=($(compgen -W "blackman-harris hann rectangle" -- "$current")) ;;
    --place) COMPREPLY=($(compgen -W "random lattice" -- "$current")) ;;
    --axis | --normal) COMPREPLY=($(compgen -W "x y z" -- "$current")) ;;
    --dims) COMPREPLY=($(compgen -W "1 2 3" -- "$current")) ;;
    --isa)
        words="baseline v3 v4"
        [[ " ${COMP_WORDS[*]} " == *" bench "* ]] && words+=" all"
        COMPREPLY=($(compgen -W "$words" -- "$current"))
        ;;
    --format) COMPREPLY=($(compgen -W "svg pdf" -- "$current")) ;;
    --components) COMPREPLY=($(compgen -W "1 2 3 4" -- "$current")) ;;
    --only | --skip)
        prefix=""
        [[ $current == *,* ]] && prefix=${current%,*},
        COMPREPLY=($(compgen -P "$prefix" -W "$(_bandlimit_names properties)" -- "${current##*,}"))
        ;;
    --view) COMPREPLY=($(compgen -W "$(_bandlimit_names views)" -- "$current")) ;;
    --method | --filter) COMPREPLY=($(compgen -W "all $(_bandlimit_names methods)" -- "$current")) ;;
    --trade) COMPREPLY=($(compgen -W "$(_bandlimit_names trades)" -- "$current")) ;;
    --pixel) COMPREPLY=($(compgen -W "box gaussian" -- "$current")) ;;
    --cache) COMPREPLY=($(compgen -d -- "$current")) ;;
    --bits) COMPREPLY=($(compgen -W "8 16" -- "$current")) ;;
    -o | --output) COMPREPLY=($(compgen -f -- "$current")) ;;
    --seed | --threads | --rate | --size | --average | --level | --band | --leak | --guard | \
        --autocorrelation | --alpha | --tolerance | --samples | --bins | --range | --width | --height | --scale | --at) return ;;
    esac
    [[ ${#COMPREPLY[@]} -gt 0 ]] && return

    # bash splits name:key=value,key=value at the colon and the equals signs.
    for ((i = COMP_CWORD; i > 1; i--)); do
        [[ ${COMP_WORDS[i]} == ":" ]] && break
        [[ $i -lt $COMP_CWORD && ${COMP_WORDS[i]} != "=" && ${COMP_WORDS[i + 1]} != "=" &&
            ${COMP_WORDS[i - 1]} != "=" ]] && i=1
    done
    if [[ $i -gt 1 && ($current == ":" || $previous == ":" || $current == *,*) ]]; then
        name=${COMP_WORDS[i - 1]}
        [[ $current == ":" ]] && current=""
        prefix=""
        [[ $current == *,* ]] && prefix=${current%,*},
        COMPREPLY=($(compgen -P "$prefix" -S "=" -W "$(_bandlimit_keys "$name")" -- \
            "${current##*,}"))
        compopt -o nospace 2>/dev/null
        return
    fi

    for ((i = 1; i < COMP_CWORD; i++)); do
        word=${COMP_WORDS[i]}
        if [[ $word != -* && " "$verbs" " == *[[:space:]]"$word"[[:space:]]* ]]; then
            verb=$word
            break
        fi
    done
    case $verb in
    list) options="--names" ;;
    show) options="--plot" ;;
    eval) options="--components" ;;
    render) options="--width --height --scale --at --normal --range --bits --components" ;;
    spectrum) options="$spectral --band --autocorrelation" ;;
    histogram) options="--samples --bins --range --level" ;;
    check) options="$spectral --band --leak --guard --claims --alpha" ;;
    score) options="--all --only --skip --strict --alpha" ;;
    alias) options="--view --method --filter --size --pixel --cache" ;;
    trade) options="--trade --view" ;;
    advise) options="--view --tolerance --largest --method --filter --size" ;;
    compare | reproduce) options="--format" ;;
    bench) options="--check" ;;
    esac
    case $verb in
    "" | help) words=$verbs ;;
    version) ;;
    list) words="noises primitives filters textures sources views methods trades properties figures verbs" ;;
    show) words=$("${COMP_WORDS[0]}" list --names 2>/dev/null) ;;
    reproduce) words=$(_bandlimit_names figures) ;;
    alias | trade | advise)
        words="$(_bandlimit_names textures) $(_bandlimit_names primitives) $(_bandlimit_names noises)"
        [[ $verb == trade ]] && words+=" spectrum"
        ;;
    *) words=$(_bandlimit_names noises) ;;
    esac
    case $verb in
    show | eval | render | spectrum | histogram | check | score | compare | alias) files=yes ;;
    esac
    if [[ $current == -* ]]; then
        COMPREPLY=($(compgen -W "$options $common" -- "$current"))
    else
        COMPREPLY=($(compgen -W "$words" -- "$current"))
        [[ $files ]] && COMPREPLY+=($(compgen -f -- "$current"))
    fi
}

complete -o filenames -o bashdefault -F _bandlimit bandlimit
