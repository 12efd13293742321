#!/bin/sh
# SPDX-License-Identifier: MIT
#
# run.sh TEST LOG: runs one test program and keeps what it prints, with its exit status last. With
# T=word, a program whose own name has the word runs whole; the others run only the tests whose
# names have it. One that does not end within TIMEOUT seconds is stopped and has failed. What failed
# is printed, and last of all the command that repeats it: REPEAT with T=name.
program=$1
log=$2
name=$(basename "$program")
filter=
case "$name" in
*"$T"*) ;;
*) filter="*$T*" ;;
esac
limit=${TIMEOUT:-1800}
OMP_WAIT_POLICY=passive BL_TEST_FILTER="$filter" CMOCKA_MESSAGE_OUTPUT=tap \
    timeout -k 10 "$limit" "$program" >"$log" 2>&1
status=$?
if [ "$status" -eq 124 ] || [ "$status" -eq 137 ]; then
    echo "# stopped: it did not end within $limit seconds" >>"$log"
fi
echo "# exit $status" >>"$log"
passed=$(grep -c '^ok ' "$log")
skipped=$(grep -c '^not ok .*# SKIP' "$log") # so cmocka writes it
failed=$(($(grep -c '^not ok ' "$log") - skipped))
if [ "$status" -ne 0 ] || [ "$failed" -gt 0 ]; then
    # A program that died has no failed test to name.
    names=$(sed -n '/# SKIP/d; s/^not ok [0-9]* - //p' "$log")
    for failed_one in ${names:-$name}; do
        echo "repeat: ${REPEAT:-make check} T=$failed_one" >>"$log"
    done
    printf '%-28s FAILED (%s passed, %s failed, exit %s)\n' "$name" "$passed" "$failed" "$status"
    sed '/^repeat: /!s/^/    /' "$log"
elif [ "$passed" -gt 0 ] || [ "$skipped" -gt 0 ]; then
    left=
    [ "$skipped" -eq 0 ] || left=", $skipped skipped"
    walked=$(sed -n 's/^# SCALE below 1: /; /p' "$log") # what a walk left out
    printf '%-28s %s passed%s%s\n' "$name" "$passed" "$left" "$walked"
fi
