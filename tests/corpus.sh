#!/bin/sh
# corpus.sh FOLDER [--reference FILE.tsv]... [--jobs N] [--timeout S] [--args "..."] [--only PATTERN] [--bad] [--floor N]
# Run every .geo file of a folder through meshgen and print a table: parsed / meshed / audited / compared, and totals.
# With --floor N the run fails only when fewer than N files are good (the others are listed by name).
# With --bad, files are expected to be refused with an error that has a position. Last line: "N passed, N failed".
exec "${PYTHON:-/usr/bin/python3}" "$(dirname "$0")/corpus.py" "$@"
