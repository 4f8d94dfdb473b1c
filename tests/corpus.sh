#!/bin/sh
# corpus.sh FOLDER [--reference FILE.tsv]... [--jobs N] [--timeout S] [--args "..."] [--only PATTERN] [--bad] [--floor N]
# Run every .geo file of a folder through meshgen and print a table: parsed / meshed / audited / compared, and totals.
# With --floor N the run fails only when fewer than N files are good (the others are listed by name).
# With --recombine [METHODS] every face is recombined, once for each method of Mesh.RecombinationAlgorithm and each of --algorithms
# (default 6): all must finish, pass the audit and, with methods 1 to 3, keep no triangle but where a boundary is fixed odd.
# With --gmsh PROGRAM the members of all physical groups are compared with what that gmsh makes of the same file.
# With --stand-in FILE=TEXT a file of that text is put beside scripts that name FILE, where it was not published; the note says so.
# Faces that the reference says its program left without a mesh are not compared; the note names them.
# With --bad, files are expected to be refused with an error that has a position. Last line: "N passed, N failed".
exec "${PYTHON:-/usr/bin/python3}" "$(dirname "$0")/corpus.py" "$@"
