#!/bin/bash
# examples.sh - the worked examples of geo/: they mesh, pass the audit, and are what their comments say
. "$(dirname "$0")/lib.sh"
for e in plate_hole backward_step naca0012 machine_sector pipe_sensors porous coastline; do
  exits 0 "$e meshes" "$MESHGEN" -2 "$ROOT/geo/$e.geo" -format msh2 -o "$e.msh" -no_report -v 2
  if [ -z "$err" ]; then ok "$e without a warning"; else not_ok "$e without a warning" "$err"; fi
  exits 0 "$e passes the audit when read back" "$MESHGEN" check "$e.msh"
done
have() { # FILE TYPE: number of elements of a type
  awk -v type="$2" '/^\$Elements/ { on = 1 } on && $2 == type { n++ } END { print n + 0 }' "$1"
}
check "the plate is all quadrangles" [ "$(have plate_hole.msh 2)/$(have plate_hole.msh 3)" = 0/768 ]
check "the step is all quadrangles of its blocks" [ "$(have backward_step.msh 2)/$(have backward_step.msh 3)" = 0/5220 ]
check "first height of the aerofoil's layer is 1e-4, its growth 1.2" "$PYTHON" "$here/examples.py" naca naca0012.msh
check "the nodes of the machine's left cut are those of the right cut, turned" "$PYTHON" "$here/examples.py" periodic machine_sector.msh
check "the porous medium has 200 grains" "$PYTHON" "$here/examples.py" disks porous.msh
