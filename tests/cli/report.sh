# report.sh - every JSON report agrees with docs/report.schema.json, whatever the mesh; the text report has the same content
. "$(dirname "$0")/lib.sh"

schema() { check "$1" "$PYTHON" "$here/schema.py" "$ROOT/docs/report.schema.json" "$2" "$3"; }

for model in "$ROOT"/geo/*.geo; do
  name=$(basename "$model" .geo)
  "$MESHGEN" -2 "$model" -clscale 4 -v 0 --json -o "$name.msh" >"$name.json"
  schema "report of $name" run "$name.json"
done
"$MESHGEN" -1 "$ROOT/geo/conge.geo" -v 0 --json -o one.msh >one.json
schema "report of curves alone" run one.json
"$MESHGEN" -2 "$ROOT/geo/conge.geo" -clscale 5 -order 2 -v 0 --json -require "nodes>0" -require "area<0" -o two.msh >two.json
schema "report of order 2, with conditions" run two.json
grep -q '"holds": false' two.json && grep -q '"holds": true' two.json && ok "conditions say whether they hold" || not_ok "conditions say whether they hold"
"$MESHGEN" two.msh --json >file.json
schema "report of a mesh file" run file.json
printf 'Point(1) = {0, 0, 0, 1}\nPoint(2) = ;\n' >bad.geo
"$MESHGEN" -2 bad.geo -v 0 --json >bad.json
schema "report of a failure" run bad.json
"$MESHGEN" -2 missing.geo -v 0 --json >missing.json
schema "report of a missing file" run missing.json
printf 'Point(1) = {0, 0, 0, 1};\n' | "$MESHGEN" -2 - -v 0 --json -o point.msh >point.json
schema "report of a point alone" run point.json
"$MESHGEN" -2 "$ROOT"/geo/conge.geo bad.geo -v 0 --json -o . >batch.json
schema "reports of a batch" run batch.json

"$MESHGEN" check -json conge.msh two.msh >check.json
schema "check of good meshes" check check.json
printf '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 1 0\n$EndNodes\n$Elements\n2\n1 2 2 0 1 1 2 3\n2 2 2 0 1 1 4 2\n$EndElements\n' >wrong.msh
"$MESHGEN" check -json wrong.msh >wrong.json
schema "check of a wrong mesh" check wrong.json
grep -q '"valid": false' wrong.json && ok "a wrong mesh is not valid" || not_ok "a wrong mesh is not valid"
for pair in "conge.msh conge.msh" "conge.msh two.msh" "one.msh conge.msh" "wrong.msh point.msh"; do
  # shellcheck disable=SC2086
  "$MESHGEN" diff -json $pair >diff.json
  schema "diff of $pair" diff diff.json
done
printf '0 0\n1 0\n1 1\n0 1\n.5 .5\n' >p.xyz
"$MESHGEN" -delaunay p.xyz -json -v 0 -o p.msh >p.json
schema "report of -delaunay" delaunay p.json

# every figure that -require knows is in the schema and the other way round
figures=$("$PYTHON" -c 'import json, sys; print(*[k for k, v in json.load(open(sys.argv[1]))["mesh"].items() if not isinstance(v, (list, str)) and k != "order"])' conge.json)
for f in $figures; do
  "$MESHGEN" conge.msh -v 0 -require "$f<-1"
  [ $? = 1 ] && ok "-require knows $f" || not_ok "-require knows $f"
  grep -q "^| \`$f\`" "$ROOT/docs/report.md" && ok "docs/report.md tells of $f" || not_ok "docs/report.md tells of $f"
done
exits 2 "-require of something unknown" "$MESHGEN" conge.msh -require "beauty>1"
exits 2 "-require without a comparison" "$MESHGEN" conge.msh -require "nodes"

# the text has the same content
exits 0 "full report as text" "$MESHGEN" -2 "$ROOT/geo/conge.geo" -clscale 4 -full_report -o conge.msh
for word in "meshgen " "Mesh.MeshSizeFactor = 4" "entity " "group " "gamma" "angle" "worst element" "efficiency tau" "hash" "mesh 2D"; do
  prints "$word" "full report: $word"
done
worst=$(printf '%s\n' "$out" | grep -c 'triangle [0-9]* of surface')
[ "$worst" = 10 ] && ok "full report: ten worst" || not_ok "full report: ten worst" "$worst"
