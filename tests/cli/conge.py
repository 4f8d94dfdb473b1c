# conge.py - properties of the meshes of geo/conge.geo, read by a reader of our own from MSH 2.2
# SPDX-License-Identifier: MIT
import math, sys

count = 0


def test(name, good, detail=""):
    global count
    count += 1
    print("%s %d - %s%s" % ("ok" if good else "not ok", count, name, "" if good else "\n# %s" % detail))


def read(path):
    nodes, elems = {}, {1: [], 2: [], 15: []}
    lines = iter(open(path))
    for line in lines:
        if line.startswith("$Nodes"):
            for _ in range(int(next(lines))):
                w = next(lines).split()
                nodes[int(w[0])] = (float(w[1]), float(w[2]))
        elif line.startswith("$Elements"):
            for _ in range(int(next(lines))):
                w = [int(x) for x in next(lines).split()]
                elems[w[1]].append((w[4], tuple(w[3 + w[2]:])))
    return nodes, elems


def polygon_area(points):  # of closed chains given as directed segments
    return 0.5 * math.fsum(a[0] * b[1] - b[0] * a[1] for a, b in points)


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


results = []
args = sys.argv[1:]
for scale, path in zip(args[0::2], args[1::2]):
    nodes, elems = read(path)
    tris = elems[2]
    edge_faces, worst_angle, gammas, inverted, area = {}, 180.0, [], 0, {22: [], 24: []}
    for face, (a, b, c) in tris:
        pa, pb, pc = nodes[a], nodes[b], nodes[c]
        twice = (pb[0] - pa[0]) * (pc[1] - pa[1]) - (pb[1] - pa[1]) * (pc[0] - pa[0])
        inverted += twice <= 0
        area[face].append(twice / 2)
        la, lb, lc = math.dist(pb, pc), math.dist(pc, pa), math.dist(pa, pb)
        angles = [math.acos(max(-1, min(1, (y * y + z * z - x * x) / (2 * y * z)))) for x, y, z in ((la, lb, lc), (lb, lc, la), (lc, la, lb))]
        worst_angle = min(worst_angle, math.degrees(min(angles)))
        sines = [math.sin(x) for x in angles]
        gammas.append(4 * sines[0] * sines[1] * sines[2] / sum(sines))
        for e in ((a, b), (b, c), (c, a)):
            edge_faces.setdefault(frozenset(e), []).append((face, e))
    interface = set(range(15, 21))
    lines = elems[1]
    lost = [e for curve, e in lines if frozenset(e) not in edge_faces]
    both = [e for curve, e in lines if curve in interface and {f for f, _ in edge_faces[frozenset(e)]} != {22, 24}]
    name = "conge at %s: " % scale
    test(name + "triangles %d" % len(tris), {"1": 8e3, "0.3": 9e4, "0.1": 8e5}[scale] < len(tris) < {"1": 2e4, "0.3": 2e5, "0.1": 2e6}[scale])
    test(name + "each edge of the 1D mesh is an edge of the 2D mesh", not lost, lost[:3])
    test(name + "both faces share every edge of the interface", not both, both[:3])
    test(name + "no inner edge has more or fewer than two triangles", all(len(v) == 2 for k, v in edge_faces.items() if k not in {frozenset(e) for _, e in lines}))
    test(name + "no triangle inverted", inverted == 0, inverted)
    boundary = [(nodes[e[0]], nodes[e[1]]) for k, v in edge_faces.items() if len(v) == 1 for _, e in v]
    polygon, total = polygon_area(boundary), math.fsum(area[22] + area[24])
    test(name + "area equals the polygon's to 1e-12", abs(total - polygon) <= 1e-12 * polygon, (total, polygon))
    test(name + "smallest angle %.2f above 25" % worst_angle, worst_angle > 25)
    mean = sum(gammas) / len(gammas)
    test(name + "mean gamma %.4f above 0.93" % mean, mean > 0.93)
    cover, body = analytic()
    results.append((float(scale), abs(math.fsum(area[22]) - cover) / cover, abs(math.fsum(area[24]) - body) / body))
for (s0, c0, b0), (s1, c1, b1) in zip(results, results[1:]):
    for what, x0, x1 in (("cover", c0, c1), ("body", b0, b1)):
        order = math.log(x0 / x1) / math.log(s0 / s1)
        test("area of the %s tends to the analytic one at second order (%.2f from %g to %g)" % (what, order, s0, s1), 1.6 < order < 2.5)
