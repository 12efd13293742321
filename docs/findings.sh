#!/bin/sh
# SPDX-License-Identifier: MIT
#
# findings.sh FOLDER: docs/findings.md from docs/findings.in and the claims that `bandlimit reproduce
# --quick -o FOLDER` left. A line of the template
#
#   @FIGURE | beginning of the claim | beginning of its reading | verdict | words %.2f words @ | factor
#
# becomes those words, with the measured number times the factor; with two %.2f, the ends of its
# interval. It is an error if there is not just one such claim, or if its verdict is another one.
set -e
awk -v folder="$1" '
    function field(line) { sub(/^[^:]*: "?/, "", line); sub(/"?,?$/, "", line); return line }
    function trim(s) { gsub(/^ +| +$/, "", s); return s }
    function stop(why) { print "docs/findings.in: " why > "/dev/stderr"; failed = 1; exit 1 }
    function read_claims(figure,    file, line, n) {
        file = folder "/" figure "/" figure ".json"
        while ((getline line < file) > 0) {
            if (line ~ /^      "claim": /) { n = ++count[figure]; claim[figure, n] = field(line) }
            if (line ~ /^      "reading": /) reading[figure, n] = field(line)
            if (line ~ /^      "measured": /) measured[figure, n] = field(line)
            if (line ~ /^      "interval": /) {
                getline line < file; lower[figure, n] = trim(line)
                getline line < file; upper[figure, n] = trim(line)
            }
            if (line ~ /^      "verdict": /) verdict[figure, n] = field(line)
        }
        close(file)
        if (!n) stop("no claims in " file)
    }
    # The words until now, broken into lines.
    function flush_words(    n, i, word, line) {
        n = split(held, word, " ")
        line = indent word[1]
        for (i = 2; i <= n; i++)
            if (length(line) + length(word[i]) + 1 <= 98) line = line " " word[i]
            else { print line; line = "  " word[i] }
        if (n) print line
        held = ""
    }
    /^ *@/ {
        split(substr($0, index($0, "@") + 1), part, "|")
        figure = trim(part[1]); sentence = trim(part[2]); about = trim(part[3])
        text = trim(part[5]); sub(/ *@$/, "", text); factor = part[6] + 0
        if (!count[figure]) read_claims(figure)
        found = 0
        for (n = 1; n <= count[figure]; n++)
            if (index(claim[figure, n], sentence) == 1 && index(reading[figure, n], about) == 1) {
                found++; at = n
            }
        if (found != 1) stop(figure ": " found " claims: " sentence " (" about ")")
        if (verdict[figure, at] != trim(part[4]))
            stop(figure ": now " verdict[figure, at] ": " sentence " (" about ")")
        gsub(/% ?\]/, "%%]", text); gsub(/f %/, "f %%", text); gsub(/%%+/, "%%", text)
        if (split(text, pieces, /%\.[0-9]f/) == 3)
            text = sprintf(text, factor * lower[figure, at], factor * upper[figure, at])
        else
            text = sprintf(text, factor * measured[figure, at])
        held = held " " text
        next
    }
    /^- / { flush_words(); indent = ""; held = $0; inside = 1; next }
    inside && /^  / { held = held " " trim($0); next }
    { flush_words(); inside = 0; print }
    END { if (!failed) flush_words() }' "$(dirname "$0")/findings.in"
