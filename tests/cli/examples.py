# examples.py - what examples.sh cannot say in the shell: heights of layers, periodic nodes, number of holes
# SPDX-License-Identifier: MIT
import math, sys


def read(path):
    lines = open(path).read().split("\n")
    i = lines.index("$Nodes")
    nodes = {w[0]: tuple(map(float, w[1:4])) for w in (l.split() for l in lines[i + 2 : i + 2 + int(lines[i + 1])])}
    i = lines.index("$Elements")
    elems = [l.split() for l in lines[i + 2 : i + 2 + int(lines[i + 1])]]
    names = {}
    i = lines.index("$PhysicalNames")
    for l in lines[i + 2 : i + 2 + int(lines[i + 1])]:
        dim, tag, name = l.split(" ", 2)
        names[name.strip('"')] = (int(dim), tag)
    return nodes, elems, names


def group(elems, names, name):
    return [w[3 + int(w[2]) :] for w in elems if w[3] == names[name][1] and w[1] == "1"]


def naca(path):
    """Of each edge of the aerofoil: the heights of the stack of quadrangles that stands on it."""
    nodes, elems, names = read(path)
    quads = [w[3 + int(w[2]) :] for w in elems if w[1] == "3"]
    at = {}
    for q in quads:
        for k in range(4):
            at.setdefault(frozenset((q[k], q[(k + 1) % 4])), []).append((q, k))
    for a, b in group(elems, names, "aerofoil"):
        edge, seen, heights = frozenset((a, b)), set(), []
        while True:
            here = [(q, k) for q, k in at.get(edge, []) if tuple(q) not in seen]
            if len(here) != 1:
                break
            q, k = here[0]
            seen.add(tuple(q))
            p = [nodes[q[(k + i) % 4]] for i in range(4)]
            length = math.dist(p[0], p[1])
            area = abs(sum(p[i][0] * p[(i + 1) % 4][1] - p[i][1] * p[(i + 1) % 4][0] for i in range(4))) / 2
            heights.append(area / (0.5 * (length + math.dist(p[2], p[3]))))
            edge = frozenset((q[(k + 2) % 4], q[(k + 3) % 4]))
        if len(heights) != 20:
            return "an edge of the aerofoil has %d layers" % len(heights)
        for k, h in enumerate(heights):
            if abs(h / (1e-4 * 1.2**k) - 1) > 0.01:
                return "layer %d is %g high" % (k, h)


def periodic(path):
    nodes, elems, names = read(path)
    cut = [{v for e in group(elems, names, name) for v in e} for name in ("right cut", "left cut")]
    if len(cut[0]) != len(cut[1]):
        return "the cuts have %d and %d nodes" % (len(cut[0]), len(cut[1]))
    c, s = math.cos(math.pi / 4), math.sin(math.pi / 4)
    for v in cut[0]:
        x, y, _ = nodes[v]
        image = (c * x - s * y, s * x + c * y, 0)
        if min(math.dist(image, nodes[w]) for w in cut[1]) > 1e-15:
            return "node %s has no image" % v
    text = open(path).read()
    if "$Periodic" not in text:
        return "the file does not list the pairs"


def disks(path):
    nodes, elems, names = read(path)
    parent = {}

    def root(v):
        while parent.setdefault(v, v) != v:
            v = parent[v]
        return v

    for a, b in group(elems, names, "grains"):
        parent[root(a)] = root(b)
    rings = {root(v) for v in parent}
    if len(rings) != 200:
        return "%d grains" % len(rings)


why = {"naca": naca, "periodic": periodic, "disks": disks}[sys.argv[1]](sys.argv[2])
if why:
    print("#", why)
    sys.exit(1)
