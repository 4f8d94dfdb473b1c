#!/bin/bash
# structured_vs_gmsh.sh - transfinite and extruded meshes, node by node and cell by cell, against the gmsh of the system
exec "${PYTHON:-/usr/bin/python3}" "$(dirname "$0")/structured_vs_gmsh.py"
