#!/bin/bash
# consumers.sh - do the programs that people have read our files? Solves the same problem on the same mesh in DOLFIN, FreeFEM, GetDP
# and SfePy (the results must agree), pulls a plate in CalculiX, reads with deal.II's GridIn. Installs what Debian has of them
# (line "consumers" of packages.txt), so it is not part of make check. Prints a table and the last line "N passed, N failed".
set -u
cd "$(dirname "$0")/.." || exit 3
root=$PWD meshgen=$PWD/build/release/meshgen python=/usr/bin/python3
sh tests/install-packages.sh consumers || exit 3
make --no-print-directory all >/dev/null || exit 3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 3
cp "$root"/tests/consumers/* .
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMP_NUM_THREADS=1
passed=0 failed=0

# row PROGRAM FILE VERDICT DETAIL
row() {
  printf '%-12s %-12s %-6s %s\n' "$1" "$2" "$3" "$4"
  if [ "$3" = reads ]; then passed=$((passed + 1)); else failed=$((failed + 1)); fi
}

# near A B: equal to 8 digits
near() { awk -v a="$1" -v b="$2" 'BEGIN { d = a - b; if (d < 0) d = -d; exit !(a != "" && b != "" && d <= 1e-8 * (b < 0 ? -b : b)) }'; }

# same PROGRAM FILE "RESULT integral nodes area": against the first result
integral= nodes= area=
same() {
  local word i n a
  read -r word i n a <<<"$3"
  if [ "$word" != RESULT ]; then row "$1" "$2" FAILS "$3"; return; fi
  [ -n "$integral" ] || { integral=$i nodes=$n area=$a; }
  if near "$i" "$integral" && [ "$n" = "$nodes" ] && near "$a" "$area"; then row "$1" "$2" reads "integral of u $i, $n nodes, area $a"
  else row "$1" "$2" DIFFERS "$i $n $a, not $integral $nodes $area"; fi
}

mesh() { "$meshgen" -2 "$@" -v 2 -no_report || exit 1; }

# The model of two faces, held at its foot (group 3). deal.II and SfePy want no line elements inside: the same without curve groups.
mesh "$root/geo/conge.geo" -clscale 2 -setnumber Mesh.SaveElementTagType 2 -o foot.msh2 -o foot.mesh2d
mv foot.msh2 foot.msh
grep -v 'Physical Curve' "$root/geo/conge.geo" >faces.geo
mesh faces.geo -clscale 2 -o faces.vtk -o faces.mesh -o faces.msh -o faces.msh2
mv faces.msh2 faces2.msh

dolfin-convert foot.msh foot.xml >convert.txt 2>&1 || cat convert.txt
same DOLFIN foot.msh "$($python dolfin_poisson.py foot 3 2>/dev/null | grep RESULT)"
same FreeFEM foot.mesh2d "$(FreeFem++ -nw -v 0 poisson.edp | grep RESULT)"
getdp poisson.pro -msh foot.msh -solve R -pos O -v 1 >getdp.txt 2>&1 || cat getdp.txt
same GetDP foot.msh "RESULT $(awk '{ print $2 }' u.txt) $nodes $(awk '{ print $2 }' area.txt)"
for f in faces.vtk faces.mesh faces2.msh; do same SfePy $f "$($python sfepy_poisson.py $f 2>&1 | tail -n 1)"; done

# CalculiX: what pulls at the right comes out at the left; orders 1 and 2 agree to 0.1 %
force() { awk -v set="$1" '$0 ~ "for set " set { getline; getline; print $1 }' plate.dat; }
for order in 1 2; do
  mesh quarter_plate.geo -order $order -setnumber Mesh.SaveGroupsOfNodes -10 -setnumber Mesh.SaveGroupsOfElements -100 -o quarter.inp
  rm -f plate.dat
  ccx plate >ccx.txt 2>&1 || tail -n 5 ccx.txt
  left[$order]=$(force LEFT) right=$(force RIGHT)
  if awk -v l="${left[$order]}" -v r="$right" -v one="${left[1]}" \
    'BEGIN { exit !(r > 100 && (l + r)^2 < (1e-5 * r)^2 && (l - one)^2 < (1e-3 * r)^2) }'; then
    row CalculiX "order $order" reads "force $right at the right, ${left[$order]} at the left"
  else
    row CalculiX "order $order" DIFFERS "force $right at the right, ${left[$order]} at the left"
  fi
done

# deal.II: cells, nodes, area and the numbers of groups
mesh "$root/geo/plate_hole.geo" -o plate.msh -o plate.msh2
mv plate.msh2 plate2.msh
# shellcheck disable=SC2046
g++ -std=c++17 -O0 -w dealii_grid.cc -o dealii_grid $(pkg-config --cflags --libs mpi-cxx) -I/usr/include/trilinos \
  -Wl,--copy-dt-needed-entries -ldeal.ii -ltbb 2>build.txt || tail -n 3 build.txt
./dealii_grid plate.msh plate2.msh faces.msh faces2.msh >dealii.txt 2>&1
for f in plate.msh plate2.msh faces.msh faces2.msh; do
  want="RESULT $f $("$meshgen" $f --json | $python counts.py)"
  got=$(grep "^RESULT $f " dealii.txt)
  if [ "$got" = "$want" ]; then row deal.II $f reads "${want#RESULT * }"
  else row deal.II $f FAILS "$want: ${got:-$(grep -A 12 "^$f FAILS" dealii.txt | tr '\n' ' ' | cut -c1-300)}"; fi
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
