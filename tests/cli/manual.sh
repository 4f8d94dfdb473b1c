# manual.sh - every switch, option, message of the manual page and exit status is exercised by some test
# A new switch or option without a test fails here: add the test, not an exception.
. "$(dirname "$0")/lib.sh"

# What the tests say, all of them but this one.
find "$ROOT/tests" "$ROOT/docs" "$ROOT/README.md" -type f ! -name manual.sh ! -name '*.png' -exec cat {} + >said.txt

used() { grep -qE -- "$1" said.txt; }
switches=$("$MESHGEN" -dump_man | sed -n 's/^\.B \\-\([A-Za-z0-9_]*\).*/\1/p')
[ "$(echo "$switches" | wc -w)" -gt 60 ] && ok "switches are listed" || not_ok "switches are listed" "$switches"
for s in $switches; do
  if used "(^|[^A-Za-z0-9_-])--?$s([^A-Za-z0-9_]|\$)"; then ok "-$s is used by a test"; else not_ok "-$s is used by a test"; fi
done
options=$("$MESHGEN" -help_options | sed -n 's/^\([A-Za-z]*\.[A-Za-z0-9]*\) = .*/\1/p')
for o in $options; do
  key=${o#*.}
  if used "(${o%.*}[._]$key|\"$key\")([^A-Za-z0-9_]|\$)"; then ok "$o is used by a test"; else not_ok "$o is used by a test"; fi
done
for code in 0 1 2 3 4; do
  if used "^ *exits $code "; then ok "exit status $code is tested"; else not_ok "exit status $code is tested"; fi
done
# Every switch is accepted, by both spellings, and asks for its argument.
for s in $switches; do
  case $s in
  0 | 1 | 2 | 3 | save | parse_and_exit | refine | barycentric_refine | delaunay | voronoi | insertion) continue ;; # tested with inputs
  esac
  "$MESHGEN" --$s >out.txt 2>&1 </dev/null
  if grep -q "unknown switch" out.txt; then not_ok "--$s is known" "$(cat out.txt)"; else ok "--$s is known"; fi
done
# Every option is accepted by -setnumber or -setstring with the value it has, and shown with it; read-only ones are refused.
"$MESHGEN" -help_options >options.txt
while IFS= read -r line; do
  name=${line%% = *} value=${line#* = }
  value=${value%%;*}
  case $line in
  *"(read-only)"*)
    "$MESHGEN" -setnumber "$name" 1 -help_options >out.txt 2>&1
    [ $? = 1 ] && grep -q "can only be read" out.txt && ok "$name is read-only" || not_ok "$name is read-only" "$(cat out.txt)"
    ;;
  *' = "'*)
    "$MESHGEN" -setstring "$name" "some text" -help_options >out.txt 2>&1 && grep -qF "$name = \"some text\"" out.txt && ok "$name is set" || not_ok "$name is set"
    ;;
  *)
    "$MESHGEN" -setnumber "$name" "$value" -help_options >out.txt 2>&1 && cmp -s options.txt out.txt && ok "$name is set" || not_ok "$name is set" "$(diff options.txt out.txt | head -n 4)"
    "$MESHGEN" -setnumber "$name" nan -help_options >out.txt 2>&1
    [ $? = 1 ] && grep -qE "out of range|takes one of" out.txt && ok "$name: nan is refused with the range" || not_ok "$name: nan is refused with the range" "$(head -n 2 out.txt)"
    ;;
  esac
done <options.txt
