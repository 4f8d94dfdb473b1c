# batch.sh - several inputs in one call: threads, order, messages with places, summary, exit status; conversion of many meshes
. "$(dirname "$0")/lib.sh"

model() { # model NAME SIZE
  printf 'Point(1)={0,0,0,%s}; Point(2)={1,0,0,%s}; Point(3)={0,1,0,%s};\nLine(1)={1,2}; Line(2)={2,3}; Line(3)={3,1};
Curve Loop(1)={1:3}; Plane Surface(1)={1};\nPrintf("model %s");\n' "$2" "$2" "$2" "$1" >"$1.geo"
}
model a 0.2 && model b 0.1 && model c 0.3
printf 'Point(1) = {0, 0, 0};\nLine(1) = {1, 7};\n' >bad.geo

exits 0 "good inputs: exit status" "$MESHGEN" -2 a.geo b.geo c.geo -nt 4
prints "3 inputs: 3 good, 0 failed" "totals"
order=$(printf '%s\n' "$out" | grep -o '^model .\|^.\.geo:' | tr '\n' ' ')
if [ "$order" = "model a a.geo: model b b.geo: model c c.geo: " ]; then ok "output in the order of the inputs"; else not_ok "output in the order of the inputs" "$order"; fi
for f in a b c; do check "$f.msh is valid" "$MESHGEN" check $f.msh; done
for f in a b c; do mv $f.msh $f.threads; done
exits 0 "one thread" "$MESHGEN" -2 a.geo b.geo c.geo
for f in a b c; do same "$f: the same bytes" $f.threads $f.msh; done

exits 1 "one bad input: exit status" "$MESHGEN" -2 a.geo bad.geo c.geo -nt 2
says "bad.geo:2:" "one bad input: its place"
says "Line(1) = {1, 7};" "one bad input: its line"
prints "bad.geo: failed, exit status 1" "one bad input: its summary"
prints "3 inputs: 2 good, 1 failed" "one bad input: totals"
absent "one bad input: no mesh of it" bad.msh
exits 1 "the least exit status counts" "$MESHGEN" -2 none.geo bad.geo
exits 3 "a missing file among good ones" "$MESHGEN" -2 a.geo none.geo
exits 1 "-Werror holds in a batch" sh -c 'echo "EndFor;;" > w.geo; "$0" -2 a.geo w.geo -Werror' "$MESHGEN"
exits 1 "-log gets the messages" "$MESHGEN" -2 a.geo bad.geo -log log.txt -color always
err=$(cat log.txt)
says "bad.geo:2:" "-log: the place"
case $err in *$'\033'*) not_ok "-log: no colours" ;; *) ok "-log: no colours" ;; esac

exits 1 "--json in a batch" "$MESHGEN" -2 a.geo bad.geo b.geo -nt 2 --json
printf '%s\n' "$out" | grep -v '^model ' >batch.json
check "--json: one object each, with the exit status" "$PYTHON" - <<'END'
import json
text, at, all = open("batch.json").read(), 0, []
while text[at:].strip():
    at += len(text[at:]) - len(text[at:].lstrip())
    value, at = json.JSONDecoder().raw_decode(text, at)
    all.append(value)
assert [v["input"] for v in all] == ["a.geo", "bad.geo", "b.geo"], all
assert [v["exit_status"] for v in all] == [0, 1, 0]
assert all[1]["mesh"] is None and all[1]["messages"][0]["line"] == 2
END

mkdir out
exits 0 "into a folder" "$MESHGEN" -2 a.geo b.geo -o out -format vtk
check "into a folder: both are there" test -s out/a.vtk -a -s out/b.vtk
mkdir sub && cp a.geo sub/
exits 2 "two inputs of one name" "$MESHGEN" -2 a.geo sub/a.geo -o out
says "same file" "two inputs of one name: said"
exits 2 "several inputs, one output file" "$MESHGEN" -2 a.geo b.geo -o one.msh
absent "several inputs, one output file: nothing" one.msh

exits 0 "many conversions" "$MESHGEN" a.msh b.msh c.msh -format vtu -nt 2
for f in a b c; do
  if [ "$("$MESHGEN" hash $f.msh | cut -d' ' -f1)" = "$("$MESHGEN" hash $f.vtu | cut -d' ' -f1)" ]; then ok "$f.vtu: the same hash"; else not_ok "$f.vtu: the same hash"; fi
done
cp a.msh before.msh
exits 2 "a conversion over its input is refused" "$MESHGEN" a.msh -format msh2
same "and leaves it alone" a.msh before.msh
exits 0 "a report of a mesh file" "$MESHGEN" a.msh --json
prints '"hash"' "a report of a mesh file: its hash"
exits 1 "a condition on a mesh file" "$MESHGEN" a.msh -require "min_gamma>1.5"

# On a terminal a long batch shows its progress; in a pipe it does not.
for i in $(seq 30); do model "slow$i" 0.003; done
if "$PYTHON" -c 'import os; os.openpty()' 2>/dev/null; then
  script -qec "$MESHGEN -2 slow*.geo -o out -nt 1" typescript >/dev/null 2>&1
  if grep -q 'inputs/s' typescript; then ok "progress on a terminal"; else not_ok "progress on a terminal" "$(tail -c 300 typescript)"; fi
else
  skip "progress on a terminal" "no pseudo-terminal can be opened (is /dev/pts mounted?)"
fi
"$MESHGEN" -2 slow*.geo -o out -nt 1 >piped.txt 2>&1
if grep -q 'inputs/s' piped.txt; then not_ok "no progress in a pipe"; else ok "no progress in a pipe"; fi

# Pictures: what the switches say
exits 0 "pictures by quality" "$MESHGEN" -2 b.geo -no_report -color_by gamma -mark_worst 3 -histogram -width 800 -o b.svg
grep -q 'quality gamma' b.svg && grep -q 'circle' b.svg && ok "histogram and rings are there" || not_ok "histogram and rings are there"
"$MESHGEN" -2 b.geo -no_report -o plain.svg >/dev/null
if grep -q 'quality gamma' plain.svg; then not_ok "no histogram unasked"; else ok "no histogram unasked"; fi
exits 2 "-color_by something else" "$MESHGEN" -2 b.geo -color_by colour -o b.svg
exits 2 "-mark_worst out of range" "$MESHGEN" -2 b.geo -mark_worst 51 -o b.svg
says "0 to 50" "-mark_worst out of range: the range"
exits 0 "a part of a picture" "$MESHGEN" -2 b.geo -no_report -window 0.1,0.1,0.4,0.3 -width 800 -o w.svg
check "is clipped" grep -q 'clip-path="url(#window)"' w.svg
exits 2 "-window with one corner" "$MESHGEN" -2 b.geo -window 0.1,0.1 -o w.svg
exits 2 "-width not a whole number" "$MESHGEN" -2 b.geo -width 500.5 -o b.svg
exits 0 "-sync" "$MESHGEN" -2 b.geo -no_report -sync -o synced.msh
same "-sync: the same bytes" b.msh synced.msh
