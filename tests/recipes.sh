#!/bin/sh
# SPDX-License-Identifier: MIT
#
# recipes.sh BUILD: adding a thing is one file and one line. Copies the tree with the objects that
# BUILD has of it, adds the least thing of each kind (tests/recipes/: each file where it would stand,
# and `lines`: the file, its registry and the line), edits nothing else, and runs the tests that walk
# the registries.
set -eu
build=$1
tree=$build/recipes
rm -rf "$tree"
mkdir -p "$tree/build"
# Times are kept, so that only what the lines touch is compiled.
tar -cf - --exclude=./build --exclude=./out --exclude=./.git . | tar -xf - -C "$tree"
(cd "$build" && find . -path ./recipes -prune -o \( -name '*.o' -o -name '*.d' \) -print |
    tar -cf - -T -) | tar -xf - -C "$tree/build"

while read -r file list line; do
    cp "tests/recipes/$file" "$tree/$file"
    printf '%s\n' "$line" >>"$tree/$list"
done <tests/recipes/lines

programs="t-layers t-registries t-registry t-facts t-rows t-bounds t-textbook t-filters
    t-pulse-train t-textures t-view t-alias t-trade t-score t-cli-help"
cd "$tree"
logs=
for program in $programs; do
    logs="$logs build/tests/$program.log"
done
${MAKE:-make} --no-print-directory --output-sync=target $logs REPEAT="cd $tree && make check"
sh tests/summary.sh $logs

# The source, which no walk opens.
test "$(build/bandlimit eval ramp: 0.5)" = 0.5

# The figure alone, as its walk would run all of them again.
build/bandlimit reproduce least-figure --quick -o build/out --quiet
test -s build/out/index.html
echo "recipes: each thing is one file and one line"
