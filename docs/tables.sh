#!/bin/sh
# The tables of this folder, from what the program says of itself: sh docs/tables.sh PROGRAM noises
# (or: speeds). `make docs` writes both files; a test holds noises.md to the program.
set -e
program=$1

# The value of a key of the outermost object, or of "facts" below it, in JSON of one key a line.
value() {
    sed -n "s/^ \{1,2\}\"$2\": \"\{0,1\}\(.*[^\",]\)\"\{0,1\},\{0,1\}$/\1/p" <<JSON | head -n 1
$1
JSON
}

dimensions() { # the range of the key dims, else the dimensions that there are
    printf '%s\n' "$1" | awk '
        /^ "dimensions":/ { gsub(/[^0-9]/, ""); fixed = $0 }
        /^   "key":/ { inside = /"dims"/ }
        inside && /^   "minimum":/ { gsub(/[^0-9.]/, ""); from = $0 + 0 }
        inside && /^   "maximum":/ { gsub(/[^0-9.]/, ""); to = $0 + 0 }
        END { print to ? from " to " to : fixed }'
}

band() { # "0 : 1, -27.27 dB", or a dash
    printf '%s\n' "$1" | awk '
        /^  "band_cycles_per_unit": \[/ { inside = 1; next }
        inside && /^  \]/ { inside = 0 }
        inside { gsub(/[ ,]/, ""); edge[n++] = $0 + 0 }
        /^  "leak_db":/ { leak = $2; sub(/,/, "", leak) }
        END { print n == 2 ? edge[0] " : " edge[1] (leak == "null" ? "" : ", " leak + 0 " dB") : "-" }'
}

noises() {
    cat <<'TEXT'
# Noises

Written by `make docs` from what the program states; edit nothing here. All with the default
settings: `bandlimit show NAME` tells the parameters, the formula, the bound and its proof.

- **dims**: the dimensions that there are.
- **class**: how often the noise is continuously differentiable; C0 is continuous.
- **variance**: over random places and seeds; a dash where it is not stated.
- **band**: cycles per unit along an axis, and the share of the variance outside of it.
- **closed form**: whether the power spectrum, or the covariance, is known in closed form.

| name | what it is | dims | class | variance | band | closed form | source |
| --- | --- | --- | --- | --- | --- | --- | --- |
TEXT
    for name in $("$program" list noises --json | sed -n 's/^   "name": "\(.*\)",$/\1/p'); do
        shown=$("$program" show "$name" --json)
        variance=$(value "$shown" variance)
        [ "$variance" = null ] && variance=- || variance=$(printf '%.4g' "$variance")
        [ "$(value "$shown" closed_form)" = true ] && form=yes || form=no
        echo "| \`$name\` | $(value "$shown" title): $(value "$shown" summary) |" \
            "$(dimensions "$shown") | $(value "$shown" continuity) | $variance |" \
            "$(band "$shown") | $form | $(value "$shown" paper) |"
    done
}

speeds() {
    "$program" bench --json | awk -v day="$(date -u +%Y-%m-%d)" '
        function number(x) { return sprintf(x + 0 < 99.5 ? "%.2g" : "%.0f", x) }
        function text(s) { sub(/^[^:]*: "?/, "", s); sub(/"?,?$/, "", s); return s }
        /^ "processor":/ { processor = text($0) }
        /^ "compiler":/ { compiler = text($0) }
        /^   "signal":/ { signal = text($0) }
        /^   "path":/ { path = text($0) }
        /^   "axis":/ { axis = text($0) }
        /^   "isa":/ { isa = text($0) }
        /^   "ns_per_sample":/ { ns = text($0) }
        /^   "ratio_textbook":/ {
            if (path == "row-20" && axis == "x") { order[count++] = signal; set = isa }
            if (path == "points" || axis == "x")
                cell[signal, path] = number(ns) " ns, " number(text($0)) " x"
        }
        END {
            print "# Speeds\n"
            print "Written by `make docs` from `bandlimit bench --json`; edit nothing here. Measured on"
            print day ", one thread of " processor ", instruction set " set ", gcc " compiler "."
            print "Times are of that machine: run `bandlimit bench` on yours.\n"
            print "Nanoseconds a sample, and how many times faster than a plain loop in float, the"
            print "textbook'\''s own where it prints one, measured by turns in one run. Floats agree with the"
            print "double reference to about 1e-6. Rows run along x; points are scattered over many cells.\n"
            print "| noise | rows, 20 samples a cell | rows, 2 samples a cell | scattered points |"
            print "| --- | --- | --- | --- |"
            for (i = 0; i < count; i++)
                print "| `" order[i] "` | " cell[order[i], "row-20"] " | " cell[order[i], "row-2"] \
                    " | " cell[order[i], "points"] " |"
        }'
}

"$2"
