"""From a JSON report on standard input, what dealii_grid prints of the mesh: cells, nodes, area, elements by group."""
import json
import sys

r = json.load(sys.stdin)
m = r["mesh"]
words = ["%d %d %.12g" % (m["elements"], m["nodes"], m["area"])]
words += ["material %d:%d" % (g["tag"], g["elements"]) for g in r["groups"] if g["dim"] == 2]
words += ["boundary %d:%d" % (g["tag"], g["elements"]) for g in r["groups"] if g["dim"] == 1]
print(*words)
