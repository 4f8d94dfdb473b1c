# conge.sh - the running example at three sizes: conformity, area, angles, order of convergence (conge.py does the sums)
. "$(dirname "$0")/lib.sh"

for s in 1 0.3 0.1; do
  check "mesh conge at $s" "$MESHGEN" -2 "$ROOT/geo/conge.geo" -clscale $s -v 2 -no_report -format msh2 -o conge$s.msh
done
"$PYTHON" "$here/conge.py" 1 conge1.msh 0.3 conge0.3.msh 0.1 conge0.1.msh || not_ok "conge.py ran to its end"
