# conge.py - properties of the meshes of geo/conge.geo, read by a reader of our own from MSH 2.2
# SPDX-License-Identifier: MIT
import math, sys
import numpy as np

count = 0


def test(name, good, detail=""):
    global count
    count += 1
    print("%s %d - %s%s" % ("ok" if good else "not ok", count, name, "" if good else "\n# %s" % detail))


def read(path):
    """Coordinates by node number, and per element type an array of rows (entity, nodes...) of an ASCII MSH 2.2 file."""
    with open(path) as f:
        lines = f.read().split("\n")
    at = lines.index("$Nodes")
    n = int(lines[at + 1])
    table = np.array(" ".join(lines[at + 2:at + 2 + n]).split(), dtype=float).reshape(n, 4)
    xy = np.full((int(table[:, 0].max()) + 1, 2), np.nan)
    xy[table[:, 0].astype(int)] = table[:, 1:3]
    at = lines.index("$Elements")
    n = int(lines[at + 1])
    by_type = {1: [], 2: [], 15: []}
    for line in lines[at + 2:at + 2 + n]:
        w = line.split()
        by_type[int(w[1])].append(w[4:])  # entity, nodes: two tags
    return xy, {t: np.array(rows, dtype=int).reshape(len(rows), -1) for t, rows in by_type.items() if rows}


# analytic areas: trapezoids, triangles and circular segments
def analytic():
    e1, e2, e3, h1, h2, h3, h4, h5, R1, R2, r = 4.5, 3, 2.5, 5, 10, 5, 2, 4.5, 1, 1.5, 1
    c = (-h5 * R1 + e2 * math.sqrt(h5**2 + e2**2 - R1**2)) / (h5**2 + e2**2)
    s = math.sqrt(1 - c * c)
    cover = 2 * R2 * h4 + math.pi * R2**2
    foot = 2 * (e1 + e2) * h1
    tower = 2 * e3 * h2 + 2 * (r * r - math.pi * r * r / 4)
    xa, ya = R1 / s, h5 + R1 * c
    below = (e2 + xa) * ya  # trapezoid between the legs, up to the height of the tangent points
    half = math.atan2(xa, ya - h5)  # the arch from one tangent point over the top to the other
    rad = math.hypot(xa, ya - h5)
    arch = rad * rad * (2 * half - math.sin(2 * half)) / 2
    return cover, foot + tower - below - arch - cover


def edges_of(tri):
    return np.concatenate([tri[:, [0, 1]], tri[:, [1, 2]], tri[:, [2, 0]]])


def key(edges):  # of unordered pairs
    return edges.min(axis=1) << 32 | edges.max(axis=1)


results = []
args = sys.argv[1:]
for scale, path in zip(args[0::2], args[1::2]):
    xy, elems = read(path)
    face, tri = elems[2][:, 0], elems[2][:, 1:]
    curve, line = elems[1][:, 0], elems[1][:, 1:]
    a, b, c = (xy[tri[:, k]] for k in range(3))
    cross = lambda u, v: u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    area = cross(b - a, c - a) / 2
    angles = []
    for p, q, r in ((a, b, c), (b, c, a), (c, a, b)):
        angles.append(np.arctan2(cross(q - p, r - p), np.sum((q - p) * (r - p), axis=1)))
    sines = np.sin(angles)
    gamma = 4 * sines.prod(axis=0) / sines.sum(axis=0)
    edges = edges_of(tri)
    k, owner = key(edges), np.tile(face, 3)
    keys, inverse, times = np.unique(k, return_inverse=True, return_counts=True)
    lines = key(line)
    interface = lines[(curve >= 15) & (curve <= 20)]
    sides = lambda f: np.isin(interface, k[owner == f])
    inner = ~np.isin(keys, lines)
    name = "conge at %s: " % scale
    test(name + "triangles %d" % len(tri), {"1": 8e3, "0.3": 9e4, "0.1": 8e5}[scale] < len(tri) < {"1": 2e4, "0.3": 2e5, "0.1": 2e6}[scale])
    test(name + "each edge of the 1D mesh is an edge of the 2D mesh", np.isin(lines, keys).all())
    test(name + "both faces share every edge of the interface", (sides(22) & sides(24)).all() and len(interface) > 0)
    test(name + "every inner edge has two triangles", (times[inner] == 2).all())
    test(name + "no triangle inverted", (area > 0).all())
    rim = edges[times[inverse] == 1]
    polygon = math.fsum(cross(xy[rim[:, 0]], xy[rim[:, 1]])) / 2
    total = math.fsum(area)
    test(name + "area equals the polygon's to 1e-12", abs(total - polygon) <= 1e-12 * polygon, (total, polygon))
    worst = math.degrees(np.min(angles))
    test(name + "smallest angle %.2f above 25" % worst, worst > 25)
    test(name + "mean gamma %.4f above 0.93" % gamma.mean(), gamma.mean() > 0.93)
    cover, body = analytic()
    results.append((float(scale), abs(math.fsum(area[face == 22]) - cover) / cover, abs(math.fsum(area[face == 24]) - body) / body))
for (s0, c0, b0), (s1, c1, b1) in zip(results, results[1:]):
    for what, x0, x1 in (("cover", c0, c1), ("body", b0, b1)):
        order = math.log(x0 / x1) / math.log(s0 / s1)
        test("area of the %s tends to the analytic one at second order (%.2f from %g to %g)" % (what, order, s0, s1), 1.6 < order < 2.5)
