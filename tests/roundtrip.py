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


def read_all(reader, paths):
    """What the reader says of each file, in one process: words after its name."""
    r = run("/usr/bin/python3", os.path.join(here, "cli", "readers.py"), reader, *paths)
    said = {line.split(" ")[1]: line.split(" ", 2)[2] for line in r.stdout.splitlines() if line.startswith(reader + " ")}
    return {path: said.get(path, r.stdout) for path in paths}


def expected(fmt, report):
    """Lines, triangles, quadrangles, area, names that a reader must see."""
    m, groups = report["mesh"], report["groups"]
    counts = [m["lines"], m["triangles"], m["quads"]]
    if fmt.startswith("msh2"):  # an element of k groups stands there k times
        lines, faces = (sum(g["elements"] for g in groups if g["dim"] == d) for d in (1, 2))
        counts[0] = max(counts[0], lines)
        if faces > m["elements"]:
            return None
    if fmt.split("-")[0] in ("ply", "obj", "stl"):
        counts[0] = 0
    if fmt == "stl":
        counts = [0, m["triangles"] + 2 * m["quads"], 0]
    names = ",".join(sorted({g["name"].replace('"', "'") for g in groups if g["name"]})) or "-"
    return [str(c) for c in counts], m["area"], names


def agrees(fmt, got, want):
    words = got.split(" ", 5)
    if len(words) < 6 or words[1:4] != want[0]:
        return False
    single = fmt.split("-")[0] in ("ply", "obj", "stl")  # VTK keeps these in single precision
    if abs(float(words[4]) - want[1]) > (1e-5 if single else 1e-9) * abs(want[1]) and fmt != "stl":
        return False
    return fmt not in NAMED or words[5] == want[2]


def check_readers(model, files, report):
    order = report["mesh"]["order"]
    for reader in ("gmsh", "meshio", "vtk"):
        mine = [f for f in files if reader in READERS.get(f, []) and order <= (1 if f == "mesh" else 2)]
        said = read_all(reader, [files[f] for f in mine]) if mine else {}
        for fmt in mine:
            want = expected(fmt, report)
            if want:
                verdict(agrees(fmt, said[files[fmt]], want), reader, fmt, model, "%s, not %s" % (said[files[fmt]], want))


def check_hashes(model, files, whole):
    shapes = {"curves": {}, "surface": {}}
    for fmt, path in files.items():
        back = parts(path)
        if fmt in PARTS:
            verdict(back[PARTS[fmt]] == whole[PARTS[fmt]], "hash", fmt, model, "%s %s" % (back, whole))
        elif fmt != "stl":
            shapes["curves" if fmt in NO_POINTS else "surface"][fmt] = back[2]
    for kind in shapes.values():
        first = next(iter(kind.values()), None)
        for fmt, shape in kind.items():
            verdict(shape == first, "hash", fmt, model, "%s %s" % (shape, first))


def take(model, source):
    for f in os.listdir("."):
        os.remove(f)
    r = run(meshgen, "-2", source, "-v", "1", "-no_report", "-time_limit", str(args.limit), "-max_elements", str(args.max), "-o", "a.msh")
    # what is saved by groups, should the script have asked for everything
    if r.returncode == 0:
        r = run(meshgen, "a.msh", "-v", "1", "-o", "r.msh")
    report = json.loads(run(meshgen, "r.msh", "-v", "0", "--json").stdout) if r.returncode == 0 else None
    if not report or not report["mesh"] or not report["mesh"]["elements"]:
        count["left out"] += 1
        return
    files = {}
    for fmt in list(PARTS) + NO_POINTS + SURFACE + ["stl"]:
        name, binary = fmt.split("-")[0], ["-bin"] if fmt.endswith("-bin") else []
        path = "%s.%s" % (fmt, name)
        r = run(meshgen, "r.msh", "-v", "1", *binary, "-o", path)
        if r.returncode == 1:
            table[fmt]["refused"] += 1
        elif r.returncode:
            verdict(False, "write", fmt, model, r.stdout)
        else:
            files[fmt] = path
    check_hashes(model, files, parts("r.msh"))
    check_readers(model, files, report)
    count["models"] += 1


for name in sorted(os.listdir(args.folder)):
    if name.endswith(".geo"):
        take(name, os.path.join(os.path.abspath(args.folder), name))
for fmt in table:
    print("%-10s %s" % (fmt, ", ".join("%s %d" % kv for kv in sorted(table[fmt].items()))))
print("%d models, %d left out (not meshed, or above -max elements)" % (count["models"], count["left out"]))
print("%d passed, %d failed" % (count[True], count[False]))
sys.exit(1 if count[False] else 0)
