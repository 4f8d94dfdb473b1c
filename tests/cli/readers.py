"""Read mesh files with meshio, gmsh and VTK, and print what each sees: one line "reader file points lines triangles quads area
names" per file. A reader that warns or fails prints what it said instead. Usage: readers.py reader file..."""
import contextlib
import io
import os
import re
import subprocess
import sys
import tempfile

import numpy as np


def area(points, cells):
    """Sum of the areas of polygons given as arrays of corner indices."""
    total = 0.0
    for cell in cells:
        p = points[cell]  # (n, corners, 3)
        n = np.zeros((len(p), 3))
        for k in range(1, p.shape[1] - 1):
            n += np.cross(p[:, k] - p[:, 0], p[:, k + 1] - p[:, 0])
        total += 0.5 * np.linalg.norm(n, axis=1).sum()
    return total


def show(reader, path, points, lines, tris, quads, names):
    used = np.unique(np.concatenate([np.ravel(c) for c in lines + tris + quads])) if lines + tris + quads else []
    a = area(points, [c[:, :3] for c in tris] + [c[:, :4] for c in quads])
    count = [sum(len(c) for c in kind) for kind in (lines, tris, quads)]
    print(reader, os.path.basename(path), len(used), *count, "%.12g" % a, ",".join(sorted(names)) or "-")


def complain(reader, path, text):
    print(reader, os.path.basename(path), "COMPLAINS:", " ".join(text.split())[:300])


def by_meshio(path):
    import meshio

    formats = {"msh": "gmsh", "msh2": "gmsh", "msh4": "gmsh", "inp": "abaqus", "mesh": "medit"}
    said = io.StringIO()
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
        m = meshio.read(path, file_format=formats.get(path.rsplit(".", 1)[1]))
    if said.getvalue().strip():
        return complain("meshio", path, said.getvalue())
    points = np.zeros((len(m.points), 3))
    points[:, : m.points.shape[1]] = m.points
    kind = lambda *types: [c.data for c in m.cells if c.type in types]
    names = set(m.field_data) | set(m.cell_sets) | set(getattr(m, "cell_tags", {}))
    names = {n for n in names if not re.match(r"(Line|Surface)\d+$", n) and not n.startswith("gmsh:")}
    show("meshio", path, points, kind("line", "line3"), kind("triangle", "triangle6"), kind("quad", "quad8", "quad9"), names)


def by_gmsh(path):
    out = tempfile.mktemp(suffix=".msh")
    run = subprocess.run(["gmsh", path, "-save", "-save_all", "-format", "msh41", "-o", out, "-v", "3"], capture_output=True,
                         text=True, timeout=120)
    said = run.stdout + run.stderr
    if run.returncode or re.search("warning|error", said, re.I):
        return complain("gmsh", path, said)
    text = open(out).read().split("\n")
    os.remove(out)
    names, points, elements = set(), {}, {1: [], 2: [], 3: []}
    width = {1: 2, 8: 2, 2: 3, 9: 3, 3: 4, 10: 4, 16: 4}
    every = {1: 2, 8: 3, 2: 3, 9: 6, 3: 4, 10: 9, 16: 8}
    if "$PhysicalNames" in text:
        i = text.index("$PhysicalNames")
        names = {line.split('"')[1] for line in text[i + 2 : i + 2 + int(text[i + 1])]}
    i = text.index("$Nodes") + 1
    blocks = int(text[i].split()[0])
    i += 1
    for _ in range(blocks):
        n = int(text[i].split()[3])
        for k in range(n):
            points[int(text[i + 1 + k])] = [float(v) for v in text[i + 1 + n + k].split()[:3]]
        i += 1 + 2 * n
    tags = sorted(points)
    index = {t: k for k, t in enumerate(tags)}
    i = text.index("$Elements") + 1
    blocks = int(text[i].split()[0])
    i += 1
    for _ in range(blocks):
        dim, _, kind, n = (int(v) for v in text[i].split())
        if kind in width:
            shape = 1 if dim == 1 else 2 if width[kind] == 3 else 3
            rows = [[index[int(v)] for v in text[i + 1 + k].split()[1 : 1 + every[kind]]] for k in range(n)]
            elements[shape].append(np.array(rows))
        i += 1 + n
    show("gmsh", path, np.array([points[t] for t in tags]), elements[1], elements[2], elements[3], names)


def by_vtk(path):
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy

    readers = {"vtk": vtk.vtkUnstructuredGridReader, "vtu": vtk.vtkXMLUnstructuredGridReader, "ply": vtk.vtkPLYReader,
               "obj": vtk.vtkOBJReader, "stl": vtk.vtkSTLReader}
    said = []
    window = vtk.vtkStringOutputWindow()
    vtk.vtkOutputWindow.SetInstance(window)
    r = readers[path.rsplit(".", 1)[1]]()
    r.SetFileName(path)
    r.Update()
    said = window.GetOutput()
    if said.strip():
        return complain("vtk", path, said)
    g = r.GetOutput()
    points = vtk_to_numpy(g.GetPoints().GetData()).astype(float)
    kinds = {1: [], 2: [], 3: []}
    of = {3: 1, 21: 1, 5: 2, 22: 2, 9: 3, 23: 3, 28: 3}
    for k in range(g.GetNumberOfCells()):
        c = g.GetCell(k)
        ids = [c.GetPointId(j) for j in range(c.GetNumberOfPoints())]
        if c.GetCellType() in of:
            kinds[of[c.GetCellType()]].append(ids)
    pack = lambda rows: [np.array([r for r in rows if len(r) == n]) for n in sorted({len(r) for r in rows})]
    names = set()
    field = g.GetFieldData()
    for k in range(field.GetNumberOfArrays()):
        names.add(field.GetArrayName(k))
    show("vtk", path, points, pack(kinds[1]), pack(kinds[2]), pack(kinds[3]), names)


for name in sys.argv[2:]:
    try:
        {"meshio": by_meshio, "gmsh": by_gmsh, "vtk": by_vtk}[sys.argv[1]](name)
    except BaseException as e:  # what a reader throws is its answer; some call exit()
        complain(sys.argv[1], name, "%s: %s" % (type(e).__name__, e))
