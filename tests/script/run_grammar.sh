#!/bin/bash
# run_grammar.sh [--write] - docs/grammar.md is what the comments above the parser's functions say; --write renews it
set -u
cd "$(dirname "$0")/../.." || exit 3
grammar() {
  cat <<'END'
# The grammar of .geo files

Made by `tests/script/run_grammar.sh --write` from the comments above the functions of `src/script/parse*.c`.

`"x"` is a word or sign of the text, CAPITALS are tokens, `[x]` may be left out, `x...` repeats, `|` separates choices. A text
is an `expr` whose value is a string, a `number` one whose value is a number; which of them a variable is shows when the
script runs. Parentheses and brackets do one another's work after names and functions. Words may be spelled in older ways: Curve or Line, Ellipsis, CatmullRom, Function for Macro, and so on
(`src/script/keywords.def`).

```
END
  awk '/^\/\/ [a-z_]+ -> / { print substr($0, 4); on = 1; next }
       on && /^\/\/    /    { print substr($0, 4); next }
                            { on = 0 }' \
    src/script/parse_{stmt,entity,mesh,constant}.c src/script/parse.c src/script/parse_{shape,value,expr}.c
  echo '```'
}
if [ "${1:-}" = --write ]; then
  grammar >docs/grammar.md
elif grammar | cmp -s - docs/grammar.md; then
  echo "ok 1 - docs/grammar.md is up to date"
else
  echo "not ok 1 - docs/grammar.md is not what the parser's comments say"
fi
# every nonterminal that is used is defined
undefined=$(grammar | sed -n '/^```$/,/^```$/p' | sed 's/"[^"]*"//g; s/[^a-z_ ]/ /g' | tr ' ' '\n' | sort -u |
  grep -xE '[a-z_]{3,}' | while read -r w; do
  grep -q "^$w -> " docs/grammar.md || echo "$w"
done | grep -vxE 'number|text|step|counts|heights|tags|tag|value|kind' | tr '\n' ' ')
if [ -z "$undefined" ]; then
  echo "ok 2 - all nonterminals are defined"
else
  echo "not ok 2 - not defined: $undefined"
fi
