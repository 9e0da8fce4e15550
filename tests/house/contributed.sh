#!/usr/bin/env bash
# contributed.sh PROGRAM FOLDER BLOCKS SOURCE: does what CONTRIBUTING.md promises of an experiment follow from its text? BLOCKS holds the
# files of its example.
set -euo pipefail
program=$1 folder=$2 blocks=$3 source=$4
fail() {
  echo "contributed: $*" >&2
  exit 1
}
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"

if command -v clang-format-16 >/dev/null; then
  clang-format-16 --dry-run --Werror --style="file:$source/.clang-format" "$blocks/experiments/chord/chord.cpp" || fail "the example is not formatted"
fi
"$program" run "$blocks/tests/results/small/chord.toml" --out small >small.log
"$program" report small --check >check.log 2>&1 || fail "$(cat check.log)"

"$program" run chord --out whole >whole.log
grep -q '^chords,longer\|,chords,longer,share,lower,upper,theory$' whole/data/cells.csv || fail "its columns are $(head -n 1 whole/data/cells.csv)"
(($(wc -l <whole/data/cells.csv) == 4)) || fail "not a row for each circle"
grep -q '<h3 id="chord.theory">Theory</h3>' whole/report.html || fail "the report does not say what its page does"
"$program" report whole --check >check.log 2>&1 || fail "$(cat check.log)"

"$program" run chord --trials 2000000000000 --out refused 2>refused.log && fail "more trials are taken than are allowed"
grep -q 'chords' refused.log || fail "a refusal that does not name the key: $(cat refused.log)"

# Killed while it computes, it goes on where it was, and ends with the same bytes.
cat >many.toml <<'TOML'
experiment = "chord"
radius = [1, 2, 3, 4, 5, 6, 7, 8]
chords = 3_000_000
TOML
"$program" run many.toml --seed 3 --out undisturbed >undisturbed.log
"$program" run many.toml --seed 3 --threads 1 --out killed >killed.log 2>&1 &
pid=$!
until [[ -s killed/journal.tsv ]] && (($(wc -l <killed/journal.tsv) >= 3)); do
  kill -0 $pid 2>/dev/null || fail "it ended before it could be killed: $(cat killed.log)"
done
kill -9 $pid
wait $pid 2>/dev/null || true
"$program" run many.toml --seed 3 --out killed >resumed.log 2>&1
cmp undisturbed/data/cells.csv killed/data/cells.csv || fail "a killed run ends otherwise"
"$program" report killed --check >check.log 2>&1 || fail "$(cat check.log)"
