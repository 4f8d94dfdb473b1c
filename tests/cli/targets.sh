# targets.sh - every writer against every way a target can fail: right exit status, a message, no half file, the old file untouched
. "$(dirname "$0")/lib.sh"
cat >m.geo <<'END'
h = 0.1; Point(1)={0,0,0,h}; Point(2)={1,0,0,h}; Point(3)={0,1,0,h}; Line(1)={1,2}; Line(2)={2,3}; Line(3)={3,1};
Curve Loop(1)={1:3}; Plane Surface(1)={1}; Physical Surface("face")={1}; Physical Curve("rim")={1:3};
END
"$MESHGEN" -2 m.geo -v 1 -no_report -o m.msh
# a mesh of some megabytes, so that a writer is still at it when it is stopped
"$MESHGEN" -2 m.geo -v 1 -no_report -setnumber Mesh.MeshSizeFactor 0.03 -o big.msh

formats=$("$MESHGEN" -list_formats | awk '$2 ~ /w/ { print $1 }')
[ "$(echo "$formats" | wc -w)" -ge 20 ] && ok "the formats are listed" || not_ok "the formats are listed" "$formats"
left() { find . -name '*.tmp*' | head -n 3; }
for f in $formats; do
  if [ "$f" = triangle ]; then
    exits 2 "$f: three files need a name" "$MESHGEN" m.msh -v 1 -format "$f" -o -
    exits 2 "$f: a device is none" "$MESHGEN" m.msh -v 1 -format "$f" -o /dev/full
  else
    exits 3 "$f: full disk" "$MESHGEN" m.msh -v 1 -format "$f" -o /dev/full
    says "No space left" "$f: full disk is said"
  fi
  exits 3 "$f: no such folder" "$MESHGEN" m.msh -v 1 -format "$f" -o "no/such/x.$f"
  says "No such file" "$f: no such folder is said"
  echo old >"old.$f"
  (ulimit -f 0; "$MESHGEN" m.msh -v 1 -format "$f" -o "old.$f" >/dev/null 2>&1)
  [ "$(cat "old.$f")" = old ] && ok "$f: a write that fails leaves the old file" || not_ok "$f: a write that fails leaves the old file"
  # a reader that goes away is an error, not a signal
  { "$MESHGEN" big.msh -v 1 -format "$f" -o -; echo $? >status; } 2>/dev/null | head -c 10 >/dev/null
  case $f$(cat status) in *3 | png0 | svg0 | pdf0 | triangle*) ok "$f: closed pipe" ;; *) not_ok "$f: closed pipe" "$(cat status)" ;; esac
  # killed somewhere on the way: no file, or a whole one
  rm -f "killed.$f"
  "$MESHGEN" big.msh -v 1 -format "$f" -o "killed.$f" 2>/dev/null &
  pid=$!
  sleep 0.0$((RANDOM % 3 + 1))
  kill -TERM $pid 2>/dev/null
  wait $pid 2>/dev/null
  if [ -e "killed.$f" ]; then
    "$MESHGEN" big.msh -v 1 -format "$f" -o "whole.$f" 2>/dev/null
    same "$f: killed: the file is whole" "killed.$f" "whole.$f"
  else
    ok "$f: killed: no file"
  fi
  rm -f "whole.$f" "killed.$f"
done
[ -z "$(left)" ] && ok "no temporary is left" || not_ok "no temporary is left" "$(left)"
mkdir shut && chmod 500 shut
user= # root, without root's way past permissions
[ "$(id -u)" -ne 0 ] || user='setpriv --inh-caps=-dac_override,-dac_read_search --bounding-set=-dac_override,-dac_read_search'
if $user true 2>/dev/null; then
  # shellcheck disable=SC2086
  exits 3 "a folder without permission" $user "$MESHGEN" m.msh -v 1 -o shut/x.msh
else
  skip "a folder without permission" "root may write anywhere, and setpriv cannot take that away here"
fi
exits 3 "time limit" "$MESHGEN" -2 m.geo -clscale 0.0005 -max_elements 1e9 -time_limit 0.2 -o late.msh
says "-time_limit" "time limit is said"
absent "time limit: no file" late.msh
exits 3 "memory limit" "$MESHGEN" -2 m.geo -clscale 0.002 -max_memory 200 -o large.msh
says "out of memory" "memory limit is said"
absent "memory limit: no file" large.msh
exits 1 "element limit" "$MESHGEN" -2 m.geo -max_elements 10 -o many.msh
absent "element limit: no file" many.msh
cat >slivers.geo <<'END'
For k In {0:2}
  p = newp; Point(p) = {3 * k, 0, 0, 0.2}; Point(p + 1) = {3 * k + 1, 0, 0, 0.2}; Point(p + 2) = {3 * k + 1, 0.01, 0, 0.2};
  l = newl; Line(l) = {p, p + 1}; Line(l + 1) = {p + 1, p + 2}; Line(l + 2) = {p + 2, p}; Curve Loop(k + 1) = {l:l + 2}; Plane Surface(k + 1) = {k + 1};
EndFor
END
exits 1 "element limit, of all surfaces" "$MESHGEN" -2 slivers.geo -min_angle 30 -max_elements 700 -o many.msh
says "the surfaces have 807 elements, more than Mesh.MaxElements = 700" "is said"
absent "and no file is written" many.msh
exits 3 "a log that cannot be written" "$MESHGEN" -2 m.geo -log no/such/log.txt -o x.msh
mkdir lib && echo "no library" >lib/libcairo.so.2
exits 3 "a picture without the library that draws it" env LD_LIBRARY_PATH=lib "$MESHGEN" m.msh -v 1 -o m.png
says "libcairo.so.2, which cannot be loaded" "the library is named"
absent "no picture is left" m.png
cp m.msh n.msh
exits 2 "a picture of differences without it" env LD_LIBRARY_PATH=lib "$MESHGEN" diff m.msh n.msh -o d.png
exits 0 "SVG without it" env LD_LIBRARY_PATH=lib "$MESHGEN" m.msh -v 1 -o m.svg
