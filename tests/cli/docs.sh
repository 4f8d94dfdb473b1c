# docs.sh - the manual page agrees with the tables, and every command in the documents runs
. "$(dirname "$0")/lib.sh"

check "meshgen.1 is up to date (make man)" sh -c "cd '$ROOT' && sh tests/update-man.sh '$MESHGEN' --check"
for shell in bash zsh fish; do exits 0 "completion for $shell" "$MESHGEN" -completion $shell; done
bash -n <("$MESHGEN" -completion bash) && ok "bash completion parses" || not_ok "bash completion parses"

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
