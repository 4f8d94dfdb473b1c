# docs.sh - the manual page agrees with the tables, and every command in the documents runs
. "$(dirname "$0")/lib.sh"

check "meshgen.1 is up to date (make man)" sh -c "cd '$ROOT' && sh tests/update-man.sh '$MESHGEN' --check"
for shell in bash zsh fish; do exits 0 "completion for $shell" "$MESHGEN" -completion $shell; done
bash -n <("$MESHGEN" -completion bash) && ok "bash completion parses" || not_ok "bash completion parses"

# each offers the switches of the manual, no more and no less
"$MESHGEN" -dump_man | sed -n 's/^\.B \\-\([A-Za-z0-9_]*\).*/-\1/p' | sort >switches.txt
"$MESHGEN" -completion bash | sed -n 's/.*-W "\(.*\)" --.*/\1/p' | tr ' ' '\n' | grep . | sort >of_bash.txt
"$MESHGEN" -completion zsh | sed -n "s/^  '\*\(-[^']*\)'.*/\1/p" | sort >of_zsh.txt
"$MESHGEN" -completion fish | sed -n 's/^complete -c meshgen -o \(.*\)/-\1/p' | sort >of_fish.txt
[ "$(wc -l <switches.txt)" -gt 60 ] && ok "the manual lists the switches" || not_ok "the manual lists the switches"
for shell in bash zsh fish; do same "completion for $shell has the switches of the manual" switches.txt of_$shell.txt; done

# what the shells make of it
complete=$(bash -c 'source <("$0" -completion bash); COMP_WORDS=(meshgen -clsc); COMP_CWORD=1; _meshgen; echo "${COMPREPLY[@]}"' "$MESHGEN")
[ "$complete" = -clscale ] && ok "bash completes" || not_ok "bash completes" "$complete"
"$MESHGEN" -completion zsh >_meshgen && check "zsh completion parses" zsh -n _meshgen
"$MESHGEN" -completion fish >meshgen.fish
complete=$(HOME=$work fish -c 'source meshgen.fish; complete -C "meshgen -clsc"' 2>&1)
[ "$complete" = -clscale ] && ok "fish completes" || not_ok "fish completes" "$complete"

check "comments and documents name what is there" "$PYTHON" "$ROOT/tests/check_comments.py"

# run every block marked ```sh of a document, in a folder of its own with the models at hand
mkdir bin && ln -s "$MESHGEN" bin/meshgen
PATH=$work/bin:$PATH
for doc in "$ROOT"/README.md "$ROOT"/docs/*.md; do
  name=$(basename "$doc" .md)
  mkdir -p "run-$name"
  ln -sfn "$ROOT/geo" "run-$name/geo"
  awk '/^```sh$/ { on = 1; next } /^```/ { on = 0 } on' "$doc" | grep -vE '^(make|git|sudo|apt)' >"run-$name/block.sh"
  [ -s "run-$name/block.sh" ] || continue
  check "commands of $name.md" sh -c "cd 'run-$name' && bash -eu block.sh"
done

# installed and removed: the same files, none left
make -s -C "$ROOT" CONFIG="${CONFIG:-release}" install DESTDIR="$work/root" prefix=/usr >out.txt 2>&1
[ "$(find root -type f | wc -l)" = 5 ] && ok "make install" || not_ok "make install" "$(cat out.txt)" "$(find root -type f)"
exits 0 "the installed program runs" root/usr/bin/meshgen -version
make -s -C "$ROOT" CONFIG="${CONFIG:-release}" uninstall DESTDIR="$work/root" prefix=/usr >out.txt 2>&1
[ "$(find root -type f | wc -l)" = 0 ] && ok "make uninstall" || not_ok "make uninstall" "$(find root -type f)"
