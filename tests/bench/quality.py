# quality.py - quality of the triangles of every face, ours and gmsh's on the same files; writes docs/quality.md
# SPDX-License-Identifier: MIT
#
#   quality.py [--page FILE] [--cache FOLDER] [--list N] [--jobs N] [--timeout S] FOLDER_OR_GEO[@S] ...
#
# @S meshes with -clscale S. Both mesh with the options that the file sets. Compared are the Plane Surfaces that are not transfinite
# and have triangles alone in both meshes. tau is measured in a field that belongs to neither: linear on the triangulation of the boundary
# nodes without inner vertices (-algo initial2d), with the mean length of the boundary edges at its nodes; files with size fields of
# their own (Field[...]) have no tau. Exit status 0 whatever comes out.
import argparse, concurrent.futures, os, re, shutil, subprocess, sys, tempfile
import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PROG = os.environ.get("MESHGEN", os.path.join(ROOT, "meshgen"))
MEASURES = ["mean gamma", "5 % gamma", "smallest angle", "tau"]
# Differences below these count as equal: one unit of the last digit that the report prints.
EQUAL = [1e-3, 1e-3, 0.1, 1e-3]
NODES = {1: 2, 2: 3, 3: 4, 15: 1, 8: 3, 9: 6, 16: 8, 10: 9}


def read_msh2(path):
    """Coordinates, {face tag: triangles}, faces with other elements."""
    tri, other = {}, set()
    with open(path, encoding="latin-1") as f:
        for line in f:
            if line.startswith("$Nodes"):
                n = int(next(f))
                rows = np.array([next(f).split()[:4] for _ in range(n)], float).reshape(-1, 4)
                index = np.zeros(int(rows[:, 0].max(initial=0)) + 1, int)
                index[rows[:, 0].astype(int)] = np.arange(n)
                xyz = rows[:, 1:]
            elif line.startswith("$Elements"):
                for _ in range(int(next(f))):
                    w = next(f).split()
                    kind, k = int(w[1]), int(w[2])
                    if kind == 2:
                        tri.setdefault(int(w[4]), []).append([int(x) for x in w[3 + k:]])
                    elif NODES.get(kind, 9) > 3 or kind == 9:
                        other.add(int(w[4]))
    return xyz, {t: index[np.unique(np.array(v), axis=0)] for t, v in tri.items()}, other


def shapes(xyz, tri):
    """gamma and the smallest angle of each triangle, degrees."""
    p = xyz[tri]
    l = np.stack([np.linalg.norm(p[:, (i + 1) % 3] - p[:, (i + 2) % 3], axis=1) for i in range(3)], 1)
    area = 0.5 * np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1)
    s = l.sum(1)
    with np.errstate(all="ignore"):
        gamma = np.nan_to_num(16 * area ** 2 / (l.prod(1) * s))
        c = [(l[:, (i + 1) % 3] ** 2 + l[:, (i + 2) % 3] ** 2 - l[:, i] ** 2) / (2 * l[:, (i + 1) % 3] * l[:, (i + 2) % 3]) for i in range(3)]
    angle = np.degrees(np.arccos(np.clip(np.nan_to_num(np.max(c, axis=0), nan=1), -1, 1)))
    return gamma, angle


def edges(tri):
    e = np.sort(np.concatenate([tri[:, [0, 1]], tri[:, [1, 2]], tri[:, [2, 0]]]), axis=1)
    return np.unique(e, axis=0)


def tau(xyz, tri, size):
    e = edges(tri)
    l = np.linalg.norm(xyz[e[:, 0]] - xyz[e[:, 1]], axis=1)
    a, b = size[e[:, 0]], size[e[:, 1]]
    with np.errstate(all="ignore"):
        mean = np.where(np.abs(a - b) < 1e-6 * a, a, (b - a) / np.log(b / a))
    l = l / mean
    return float(np.exp(np.nanmean(np.where(l < 1, l - 1, 1 / l - 1))))


def carry(xyz, tri, size, to):
    """The size field that is linear on our triangles, at other points."""
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    pts = vtk.vtkPoints()
    pts.SetData(numpy_to_vtk(np.ascontiguousarray(xyz), deep=True))
    cells = vtk.vtkCellArray()
    cells.SetCells(len(tri), numpy_to_vtkIdTypeArray(np.hstack([np.full((len(tri), 1), 3), tri]).astype(np.int64).ravel(), deep=True))
    grid = vtk.vtkPolyData()
    grid.SetPoints(pts)
    grid.SetPolys(cells)
    find = vtk.vtkCellLocator()
    find.SetDataSet(grid)
    find.BuildLocator()
    out = np.empty(len(to))
    near, cell, sub, d2 = [0.0] * 3, vtk.reference(0), vtk.reference(0), vtk.reference(0.0)
    for i, q in enumerate(to):
        find.FindClosestPoint(q, near, cell, sub, d2)
        t = tri[int(cell)]
        a, b, c = xyz[t]
        u, v, w = b - a, c - a, np.array(near) - a
        uu, uv, vv, wu, wv = u @ u, u @ v, v @ v, w @ u, w @ v
        d = uu * vv - uv * uv
        f, g = (vv * wu - uv * wv) / d, (uu * wv - uv * wu) / d
        out[i] = size[t[0]] * (1 - f - g) + size[t[1]] * f + size[t[2]] * g
    return out


def boundary_angle(xyz, tri):
    """The smallest angle of a triangle with two sides on the rim of the face: nobody can change that one."""
    e = np.sort(np.concatenate([tri[:, [0, 1]], tri[:, [1, 2]], tri[:, [2, 0]]]), axis=1)
    u, inv, n = np.unique(e, axis=0, return_inverse=True, return_counts=True)
    rim = (n[inv.ravel()] == 1).reshape(3, len(tri)).T  # sides 01, 12, 20
    p, least = xyz[tri], 180.0
    for i in range(3):  # corner i has the sides i and i + 2
        u, v = p[:, (i + 1) % 3] - p[:, i], p[:, (i + 2) % 3] - p[:, i]
        c = np.einsum("ij,ij->i", u, v) / (np.linalg.norm(u, axis=1) * np.linalg.norm(v, axis=1) + 1e-300)
        a = np.degrees(np.arccos(np.clip(c, -1, 1)))
        both = rim[:, i] & rim[:, (i + 2) % 3]
        if both.any():
            least = min(least, float(a[both].min()))
    return least


def boundary_field(xyz, tri):
    """Mean length of the rim edges at each node; of its shortest edge where there is none."""
    e = np.sort(np.concatenate([tri[:, [0, 1]], tri[:, [1, 2]], tri[:, [2, 0]]]), axis=1)
    u, n = np.unique(e, axis=0, return_counts=True)
    l = np.linalg.norm(xyz[u[:, 0]] - xyz[u[:, 1]], axis=1)
    total, count, least = np.zeros(len(xyz)), np.zeros(len(xyz)), np.full(len(xyz), np.inf)
    for k in (0, 1):
        np.add.at(total, u[n == 1, k], l[n == 1])
        np.add.at(count, u[n == 1, k], 1)
        np.minimum.at(least, u[:, k], l)
    return np.where(count > 0, total / np.maximum(count, 1), least)


def rim_of(xyz, tri):
    e = np.sort(np.concatenate([tri[:, [0, 1]], tri[:, [1, 2]], tri[:, [2, 0]]]), axis=1)
    u, n = np.unique(e, axis=0, return_counts=True)
    return int((n == 1).sum())


def run(cmd, cwd, limit):
    try:
        return subprocess.run(cmd, cwd=cwd, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=limit).returncode
    except subprocess.TimeoutExpired:
        return "timeout"


def plane_faces(name, cwd):
    """Tags of the Plane Surfaces that are meshed freely, from the model unrolled to plain statements."""
    flat = os.path.join(cwd, "flat.txt")
    subprocess.run([PROG, "-0", name, "-v", "0", "-o", flat], cwd=cwd, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    text = open(flat, encoding="latin-1").read() if os.path.exists(flat) else ""
    structured = set()
    for tags in re.findall(r"^Transfinite Surface\s*\{([^}]*)\}", text, re.M):
        structured |= {int(t) for t in re.findall(r"\d+", tags)}
    return {int(t) for t in re.findall(r"^Plane Surface\((\d+)\)", text, re.M)} - structured


def mesh_both(path, scale, opt):
    """Paths of both meshes, or None."""
    name = os.path.basename(path)
    key = re.sub(r"\W", "_", name) + ("" if scale == "1" else "_" + scale)
    scratch = tempfile.mkdtemp(prefix="quality.")
    folder = os.path.dirname(os.path.abspath(path))
    for f in os.listdir(folder):
        if f != name:
            os.symlink(os.path.join(folder, f), os.path.join(scratch, f))
    shutil.copy(path, os.path.join(scratch, name))
    ours = os.path.join(scratch, "us.msh2")
    run([PROG, "-2", name, "-v", "1", "-no_report", "-save_all", "-clscale", scale, "-format", "msh2", "-o", ours], scratch, opt.timeout)
    empty = os.path.join(scratch, "empty.msh2")
    with open(os.path.join(scratch, name), encoding="latin-1") as f:
        fields = re.search(r"Field\s*\[|Background Mesh", f.read())
    with open(os.path.join(scratch, "empty_" + name), "wb") as f, open(path, "rb") as g:
        f.write(g.read() + b"\nMesh.Algorithm = 3;\n")
    if not fields:
        run([PROG, "-2", "empty_" + name, "-v", "1", "-no_report", "-save_all", "-clscale", scale, "-format", "msh2", "-o", empty], scratch, opt.timeout)
    theirs = os.path.join(opt.cache or scratch, key + ".them.msh")
    if not os.path.exists(theirs):
        tmp = os.path.join(scratch, "them.msh")
        with open(os.path.join(scratch, name), "a") as f:  # what the file sets would win over switches
            f.write("\nMesh.MshFileVersion = 2.2; Mesh.Binary = 0; Mesh.SaveAll = 1; Mesh.ElementOrder = 1;\n")
        run(["gmsh", "-2", name, "-v", "0", "-save_all", "-nopopup", "-nt", "1", "-clscale", scale, "-format", "msh22", "-o", tmp], scratch, 4 * opt.timeout)
        if os.path.exists(tmp) or opt.cache:
            shutil.move(tmp, theirs) if os.path.exists(tmp) else open(theirs, "w").close()
    return scratch, ours, theirs, empty


def faces_of(path, scale, opt):
    """Rows (tag, ntri ours, theirs, measures ours, theirs, boundary angle, rim edges ours, theirs), or a reason."""
    scratch, ours, theirs, empty = mesh_both(path, scale, opt)
    try:
        if not os.path.exists(ours):
            return "not meshed by meshgen", 0
        if not os.path.exists(theirs) or os.path.getsize(theirs) == 0:
            return "not meshed by gmsh", 0
        a, b = read_msh2(ours), read_msh2(theirs)
        c = read_msh2(empty) if os.path.exists(empty) else None
        rows, skipped = [], 0
        for t in sorted(plane_faces(os.path.basename(path), scratch)):
            if t in a[2] or t in b[2] or t not in a[1] or t not in b[1]:
                skipped += 1
                continue
            rows.append(compare_face(t, a, b, c))
        return rows, skipped
    finally:
        shutil.rmtree(scratch, ignore_errors=True)


def compare_face(t, a, b, c):
    row = {"tag": t, "n": (len(a[1][t]), len(b[1][t]))}
    for who, m in (("us", a), ("them", b)):
        tri = m[1][t]
        gamma, angle = shapes(m[0], tri)
        k = max(0, int(np.ceil(0.05 * len(gamma))) - 1)
        row[who] = [float(gamma.mean()), float(np.sort(gamma)[k]), float(angle.min()), np.nan]
    row["rim"] = (rim_of(a[0], a[1][t]), rim_of(b[0], b[1][t]))
    row["corner"] = boundary_angle(a[0], a[1][t])
    if c and t in c[1]:
        field = boundary_field(c[0], c[1][t])
        for who, m in (("us", a), ("them", b)):
            used, size = np.unique(m[1][t]), np.full(len(m[0]), np.nan)
            size[used] = carry(c[0], c[1][t], field, m[0][used])
            row[who][3] = tau(m[0], m[1][t], size)
    return row


def good(row, k):
    return np.isnan(row["us"][k]) or row["us"][k] >= row["them"][k] - EQUAL[k]


def main():
    ap = argparse.ArgumentParser()
    ap.add_argument("paths", nargs="+")
    ap.add_argument("--page")
    ap.add_argument("--cache")
    ap.add_argument("--timeout", type=float, default=60)
    ap.add_argument("--jobs", type=int, default=2)
    ap.add_argument("--only", default="")
    ap.add_argument("--list", type=int, default=0, help="print this many of the worst faces per measure")
    opt = ap.parse_args()
    if opt.cache: os.makedirs(opt.cache, exist_ok=True)
    jobs = []
    for p in opt.paths:
        p, _, scale = p.partition("@")
        fs = [os.path.join(p, f) for f in sorted(os.listdir(p)) if f.endswith(".geo")] if os.path.isdir(p) else [p]
        jobs += [(f, scale or "1") for f in fs if opt.only in f]
    every, reasons = [], []
    with concurrent.futures.ProcessPoolExecutor(opt.jobs) as ex:
        results = list(ex.map(faces_of, *zip(*jobs), [opt] * len(jobs)))
    for (path, scale), (rows, skipped) in zip(jobs, results):
        name = os.path.basename(path) + ("" if scale == "1" else " -clscale " + scale)
        if isinstance(rows, str):
            reasons.append((name, rows))
            continue
        for r in rows:
            r["file"] = name
        every += rows
    n = len(every)
    print("%d files, %d without a mesh, %d faces compared" % (len(jobs), len(reasons), n))
    for k, m in enumerate(MEASURES):
        have = [r for r in every if not np.isnan(r["us"][k])]
        ok = sum(good(r, k) for r in have)
        print("%-15s at least as good on %5d of %5d faces, %.1f %%" % (m, ok, len(have), 100 * ok / max(1, len(have))))
    worse = {}
    for r in every:
        c = worse.setdefault(r["file"], [0] * 5)
        c[4] += 1
        for k in range(4): c[k] += not good(r, k)
    if opt.list:
        for f, c in worse.items():
            if sum(c[:4]): print("%-45s %s of %d" % (f[:45], c[:4], c[4]))
    for k, m in enumerate(MEASURES):
        bad = sorted((r for r in every if not good(r, k)), key=lambda r: r["us"][k] - r["them"][k])
        seen, kinds = {}, []  # faces alike within a file are told once
        for r in bad:
            key = (r["file"], r["n"], round(r["us"][k], 3))
            seen[key] = seen.get(key, 0) + 1
            if seen[key] == 1: kinds.append((r, key))
        for r, key in kinds[: opt.list]:
            print("%-14s %3dx %-22s face %-6d tri %d/%d rim %d/%d corner %.1f  %s | %s" % (m, seen[key], r["file"][:22], r["tag"], *r["n"], *r["rim"], r["corner"],
                  " ".join("%.4g" % x for x in r["us"]), " ".join("%.4g" % x for x in r["them"])))
    if opt.page:
        write_page(opt.page, every, reasons)
    return 0


def why(r, k):
    if k == 2 and r["us"][2] >= r["corner"] - 0.1:
        return "the corner between two boundary edges is no larger"
    if r["n"][0] != r["n"][1]:
        return "another number of triangles, %d against %d, weighs the four figures otherwise" % r["n"]
    return "as many triangles, %d, placed for the other figures" % r["n"][0]


def write_page(path, every, reasons):
    with open(path, "w") as f:
        f.write("# Quality of triangles, against Gmsh\n\nMade by `make docs-quality`; `tests/bench/quality.py FOLDER` prints the totals of any folder of `.geo` files. What the"
                " measures are: `docs/quality-measures.md`.\nEach cell: meshgen, Gmsh 4.8.4. Both mesh the same file with the options that it sets. Plane Surfaces"
                " of triangles that are not transfinite are\ncompared. tau is measured in a field that belongs to neither, which the boundary edges alone"
                " give, where the file has no size fields.\nDifferences under %g in gamma and tau and %g degrees count as equal; bold is worse than Gmsh.\n\n" % (EQUAL[0], EQUAL[2]))
        f.write("| file | face | triangles | " + " | ".join(MEASURES) + " |\n|" + "---|" * 7 + "\n")
        for r in every:
            cells = []
            for k in range(4):
                text = "" if np.isnan(r["us"][k]) else ("%.1f, %.1f" if k == 2 else "%.3f, %.3f") % (r["us"][k], r["them"][k])
                cells.append(text if good(r, k) else "**" + text + "**")
            f.write("| %s | %d | %d, %d | %s |\n" % (r["file"], r["tag"], *r["n"], " | ".join(cells)))
        f.write("\n## Totals\n\n| measure | at least as good |\n|---|---|\n")
        for k, m in enumerate(MEASURES):
            have = [r for r in every if not np.isnan(r["us"][k])]
            f.write("| %s | %d of %d faces |\n" % (m, sum(good(r, k) for r in have), len(have)))
        f.write("\n## Where it is worse\n\n")
        for r in every:
            for k, m in enumerate(MEASURES):
                if not good(r, k):
                    f.write("- %s, face %d, %s: %s.\n" % (r["file"], r["tag"], m, why(r, k)))
        for name, text in reasons:
            f.write("- %s: %s.\n" % (name, text))


if __name__ == "__main__":
    sys.exit(main())
