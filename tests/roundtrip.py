"""Take every .geo file of a folder through every format: roundtrip.py MESHGEN FOLDER [-limit SECONDS] [-max ELEMENTS].

A model that meshgen meshes is written in each format that does not refuse it, read back, and its fingerprint compared with that
of the MSH 4.1 file (meshgen hash -parts): in full, or as much of it as the format can hold. Every file is also read by meshio, gmsh
and VTK where they know the format: without a warning, with equal counts, area and, where the format has them, names.
Prints a row per fault, a table, and the last line "N passed, N failed".
"""
import argparse
import collections
import json
import os
import subprocess
import sys
import tempfile

PARTS = {"msh": 0, "msh-bin": 0, "msh2": 0, "msh2-bin": 0, "vtu": 0, "vtk": 2, "vtk-bin": 2, "msh1": 2}
# su2 holds the lines of groups alone
NO_POINTS, SURFACE = ["mesh", "inp", "unv", "node"], ["off", "obj", "ply", "ply-bin"]
READERS = {"msh": ["gmsh", "meshio"], "msh-bin": ["gmsh", "meshio"], "msh2": ["gmsh", "meshio"], "msh2-bin": ["gmsh", "meshio"],
           "vtk": ["gmsh", "meshio", "vtk"], "vtk-bin": ["gmsh", "meshio", "vtk"], "vtu": ["meshio", "vtk"], "mesh": ["gmsh", "meshio"],
           "unv": ["gmsh"], "ply": ["vtk", "meshio"], "obj": ["vtk"], "stl": ["gmsh", "vtk"]}
NAMED = {"msh", "msh-bin", "msh2", "msh2-bin", "vtu"}

args = argparse.ArgumentParser()
args.add_argument("meshgen")
args.add_argument("folder")
args.add_argument("-limit", type=float, default=20)
args.add_argument("-max", type=int, default=40000)
args = args.parse_args()
meshgen, here = os.path.abspath(args.meshgen), os.path.dirname(os.path.abspath(__file__))
count = collections.Counter()
table = collections.defaultdict(collections.Counter)
os.chdir(tempfile.mkdtemp())


def run(*words):
    return subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=300, text=True, errors="replace")


def verdict(good, kind, fmt, model, text=""):
    count[good] += 1
    table[fmt][kind if good else kind + " FAILS"] += 1
    if not good:
        print("not ok", model, fmt, kind, text.strip()[:300])


def parts(path):
    r = run(meshgen, "hash", "-parts", path)
    return r.stdout.split()[:3] if r.returncode == 0 else [r.stdout] * 3


def counted(reader, path):
    r = run("/usr/bin/python3", os.path.join(here, "cli", "readers.py"), reader, path)
    return r.stdout.strip().split(" ", 2)[2:] or [r.stdout]


def take(model, source):
    for f in os.listdir("."):
        os.remove(f)
    r = run(meshgen, "-2", source, "-v", "1", "-no_report", "-time_limit", str(args.limit), "-max_elements", str(args.max), "-o", "a.msh")
    if r.returncode:
        count["left out"] += 1
        return
    whole = parts("a.msh")
    report = json.loads(run(meshgen, "a.msh", "-v", "0", "--json").stdout)
    m = report["mesh"]
    if not m["elements"]:
        count["left out"] += 1
        return
    names = ",".join(sorted({g["name"].replace('"', "'") for g in report["groups"] if g["name"]})) or "-"
    shapes = {"curves": {}, "surface": {}}
    for fmt in list(PARTS) + NO_POINTS + SURFACE + ["stl"]:
        name, binary = fmt.split("-")[0], ["-bin"] if fmt.endswith("-bin") else []
        path = "b." + name
        r = run(meshgen, "a.msh", "-v", "1", *binary, "-o", path)
        if r.returncode == 1:
            table[fmt]["refused"] += 1
            continue
        if r.returncode:
            verdict(False, "write", fmt, model, r.stdout)
            continue
        back = parts(path)
        if fmt in PARTS:
            verdict(back[PARTS[fmt]] == whole[PARTS[fmt]], "hash", fmt, model, "%s %s" % (back, whole))
        elif fmt != "stl":
            shapes["curves" if fmt in NO_POINTS else "surface"][fmt] = back[2]
        for reader in READERS.get(fmt, []):
            got = counted(reader, path)[0].split(" ", 5)
            want = [str(m["lines"]), str(m["triangles"]), str(m["quads"])]
            if name in ("ply", "obj", "stl"):
                want[0] = "0"
            if name == "stl":
                want[1:] = [str(m["triangles"] + 2 * m["quads"]), "0"]
            good = len(got) == 6 and got[1:4] == want and abs(float(got[4]) - m["area"]) <= (1e-5 if name in ("ply", "obj", "stl") else 1e-9) * abs(m["area"])
            if good and fmt in NAMED:
                good = got[5] == names
            verdict(good, reader, fmt, model, "%s, not %s %s %s" % (" ".join(got), want, m["area"], names))
    for kind in shapes.values():
        first = next(iter(kind.values()), None)
        for fmt, shape in kind.items():
            verdict(shape == first, "hash", fmt, model, "%s %s" % (shape, first))
    count["models"] += 1


for name in sorted(os.listdir(args.folder)):
    if name.endswith(".geo"):
        take(name, os.path.join(os.path.abspath(args.folder), name))
for fmt in table:
    print("%-10s %s" % (fmt, ", ".join("%s %d" % kv for kv in sorted(table[fmt].items()))))
print("%d models, %d left out (not meshed, or above -max elements)" % (count["models"], count["left out"]))
print("%d passed, %d failed" % (count[True], count[False]))
sys.exit(1 if count[False] else 0)
