#!/bin/sh
# SPDX-License-Identifier: MIT
#
# summary.sh LOG...: counts all tests, and says again how each failed one is repeated. A program that
# died without a failed test counts as one. What cmocka skipped (it writes "not ok N # SKIP name") is
# neither passed nor failed, and is said. That no test was run at all is a failure.
passed=0
failed=0
skipped=0
for log in "$@"; do
    passed=$((passed + $(grep -c '^ok ' "$log")))
    left=$(grep -c '^not ok .*# SKIP' "$log")
    skipped=$((skipped + left))
    bad=$(($(grep -c '^not ok ' "$log") - left))
    if [ "$bad" -eq 0 ] && ! grep -q '^# exit 0$' "$log"; then
        bad=1
        echo "$log: the program ended badly" >&2
    fi
    [ "$bad" -eq 0 ] || grep '^repeat: ' "$log"
    failed=$((failed + bad))
done
if [ "$skipped" -gt 0 ]; then
    echo "$passed passed, $failed failed, $skipped skipped"
else
    echo "$passed passed, $failed failed"
fi
if [ $((passed + failed + skipped)) -eq 0 ]; then
    echo "no test or test program has '$T' in its name" >&2
fi
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
