#!/bin/sh
# SPDX-License-Identifier: MIT
#
# summary.sh LOG...: counts all tests; a program that died without a failed test counts as one.
passed=0
failed=0
for log in "$@"; do
    passed=$((passed + $(grep -c '^ok ' "$log")))
    bad=$(grep -c '^not ok ' "$log")
    if [ "$bad" -eq 0 ] && ! grep -q '^# exit 0$' "$log"; then
        bad=1
        echo "$log: the program ended badly" >&2
    fi
    failed=$((failed + bad))
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
