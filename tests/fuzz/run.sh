#!/bin/sh
# run.sh COMPILE LIBS FOLDER SECONDS - build each tests/fuzz/fuzz_*.c against the library of CONFIG=fuzz and run it for a while.
# Seeds are the sample models and meshes of them in every format; the corpus grows in FOLDER. Fails if anything was found.
set -eu
compile=$1 libs=$2 folder=$3 seconds=$4
here=$(dirname "$0")
make --no-print-directory CONFIG=release all >/dev/null
mkdir -p "$folder/corpus-script" "$folder/corpus-mesh" "$folder/seeds"
cp geo/*.geo "$folder/corpus-script/"
for f in tests/script/*/*.geo; do
  ! grep -q "does not come to an end" "$f" || continue # seconds until the limit, and minutes with sanitizers on a busy machine
  cp "$f" "$folder/corpus-script/$(echo "$f" | tr / _)"
done
k=0 # the first byte of a mesh chooses the format, in the order of fuzz_mesh.c
for f in msh vtk vtu mesh inp su2 unv off obj ply stl; do
  for bin in "" -bin; do
    # shellcheck disable=SC2086
    ./build/release/meshgen -2 geo/square.geo -clscale 4 -v 0 $bin -format $f -o "$folder/seeds/x" || continue
    { printf "\\$(printf %o $k)"; cat "$folder/seeds/x"; } >"$folder/corpus-mesh/seed_$f$bin"
  done
  k=$((k + 1))
done
for f in msh msh2; do # in parts, with ghost cells
  for bin in "" -bin; do
    # shellcheck disable=SC2086
    ./build/release/meshgen -2 geo/square.geo -clscale 4 -part 3 -part_ghosts -v 0 $bin -format $f -o "$folder/seeds/x" || continue
    { printf '\0'; cat "$folder/seeds/x"; } >"$folder/corpus-mesh/seed_parts_$f$bin"
  done
done
status=0
for name in script mesh; do
  $compile -o "$folder/fuzz_$name" "$here/fuzz_$name.c" $libs
  echo "fuzz_$name: $seconds seconds"
  "$folder/fuzz_$name" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=4096 -max_len=20000 -artifact_prefix="$folder/found_$name-" \
    -print_final_stats=1 "$folder/corpus-$name" >"$folder/fuzz_$name.log" 2>&1 || status=1
  grep -E "ERROR|SUMMARY|Test unit|number_of_executed" "$folder/fuzz_$name.log" || true
done
exit $status
