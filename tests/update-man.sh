#!/bin/sh
# update-man.sh PROGRAM [--check] - put the generated part into meshgen.1, or tell whether it is up to date
set -eu
new=$(mktemp)
"$1" -dump_man >"$new.part"
awk -v part="$new.part" '
  /BEGIN generated/ { print; while ((getline line < part) > 0) print line; skip = 1; next }
  /END generated/ { skip = 0 }
  !skip { print }' meshgen.1 >"$new"
if [ "${2:-}" = --check ]; then
  cmp "$new" meshgen.1
else
  cat "$new" >meshgen.1
fi
rm -f "$new" "$new.part"
