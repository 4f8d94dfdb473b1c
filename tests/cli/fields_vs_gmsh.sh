#!/bin/bash
# fields_vs_gmsh.sh - every type of size field with its options: edges on curves, counted curve by curve, against the gmsh of the system
exec "${PYTHON:-/usr/bin/python3}" "$(dirname "$0")/fields_vs_gmsh.py"
