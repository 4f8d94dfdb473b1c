"""Break a small mesh by hand in every format that can hold the damage, and ask meshgen check: broken_meshes.py MESHGEN

Two faces of a rectangle, [0,1]x[0,1] and [1,2]x[0,1], of 8 triangles each, 15 nodes and 14 line elements on 7 curves. Each damage is done
to the mesh and written here, by hand, in each format. Prints TAP.
"""
import json
import subprocess
import sys

# What a format can hold; in what does not tell which curves bound a face, a hole is known by the lines left over alone.
LINES, NAMES, POINTS, BOUNDS, NO_BOUNDS = "lines", "names", "points of their own", "curves that bound faces", "no such curves"
FACES = {1: "left", 2: "right"}


class Mesh:
    def __init__(self):
        self.node = {1 + i + 5 * j: (i / 2, j / 2) for j in range(3) for i in range(5)}
        self.tri, self.line, self.extra = [], [], {}
        for j in range(2):
            for i in range(4):
                a, face = 1 + i + 5 * j, 1 if i < 2 else 2
                self.tri += [[a, a + 1, a + 6, face], [a, a + 6, a + 5, face]]
        curves = {1: (1, 2, 3), 2: (3, 4, 5), 3: (5, 10, 15), 4: (15, 14, 13), 5: (13, 12, 11), 6: (11, 6, 1), 7: (3, 8, 13)}
        for curve, run in curves.items():
            self.line += [[a, b, curve] for a, b in zip(run, run[1:])]
        self.name = {(2, 1): "left", (2, 2): "right"}

    def replace(self, old, new, face):
        for t in self.tri:
            if t[3] == face:
                t[:3] = [new if v == old else v for v in t[:3]]


# ---- damages: each returns where it is; 1-based node numbers, node (1 + i + 5 j) is at (i/2, j/2) -------------------------------------
def nothing(m):
    return None


def duplicate_node(m):  # the triangles of one face above y = 1/2 get their own copy of its middle node
    m.node[16] = m.node[7]
    for t in m.tri:
        if t[3] == 1 and max(m.node[v][1] for v in t[:3]) == 1:
            t[:3] = [16 if v == 7 else v for v in t[:3]]
    return 0.5, 0.5


def orphan_node(m):
    m.node[16] = (0.3, 0.1)
    return 0.3, 0.1


def inverted_element(m):
    m.tri[0][1:3] = m.tri[0][2], m.tri[0][1]
    return 0.5 * 2 / 3, 0.5 / 3


def node_twice(m):
    m.tri[0][1] = m.tri[0][0]
    return 0, 0


def collinear_corners(m):
    m.node[7] = (0.25, 0.75)  # the middle node of the left face onto the diagonal of (0, 1/2), (1/2, 1)
    return None


def third_element_on_an_edge(m):
    m.tri.append([1, 7, 8, 1])
    return 0.25, 0.25


def element_twice(m):
    m.tri.append(list(m.tri[3]))
    return None


def hole(m):
    del m.tri[4:6]  # at the lower left of the right face: its edges on curves 2 and 7 go with it
    return None


def lost_edge(m):
    m.line.append([7, 8, 1])  # a line element across the left face, said to be on curve 1: an edge, but of no curve there
    m.line[0][1] = 3          # and one from node 1 to 3 past node 2
    return None


def t_junction(m):
    m.node[16] = (0.25, 0.25)  # the middle of the edge 1-7: only one side knows it
    m.tri[0:1] = [[1, 2, 16, 1], [2, 7, 16, 1]]
    return 0.25, 0.25


def group_without_elements(m):
    m.name[2, 9] = "nobody"
    return None


def two_groups_of_one_name(m):
    m.name[2, 2] = "left"
    return None


# ---- writers ------------------------------------------------------------------------------------------------------------------------
def rows(items, text):
    return "".join(text(i, *x) if isinstance(x, (list, tuple)) else text(i, x) for i, x in enumerate(items))


def names(m):
    return f"$PhysicalNames\n{len(m.name)}\n" + "".join(f'{d} {t} "{n}"\n' for (d, t), n in m.name.items()) + "$EndPhysicalNames\n"


def msh2(m):
    nodes = "".join(f"{k} {x} {y} 0\n" for k, (x, y) in m.node.items())
    lines = rows(m.line, lambda i, a, b, c: f"{i + 1} 1 2 {c} {c} {a} {b}\n")
    tris = rows(m.tri, lambda i, a, b, c, f: f"{i + 100} 2 2 {f} {f} {a} {b} {c}\n")
    return (f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n{names(m)}$Nodes\n{len(m.node)}\n{nodes}$EndNodes\n"
            f"$Elements\n{len(m.line) + len(m.tri)}\n{lines}{tris}$EndElements\n")


def msh4(m):
    bounds, of = {1: (1, 7, 5, 6), 2: (2, 3, 4, -7)}, lambda items, k: [x for x in items if x[-1] == k]
    ends = {1: (1, 3), 2: (3, 5), 3: (5, 15), 4: (15, 13), 5: (13, 11), 6: (11, 1), 7: (3, 13)}
    text = f"$MeshFormat\n4.1 0 8\n$EndMeshFormat\n{names(m)}$Entities\n6 7 2 0\n"
    text += "".join(f"{v} {(v - 1) % 5 / 2} {(v - 1) // 5 / 2} 0 0\n" for v in (1, 3, 5, 11, 13, 15))
    text += "".join(f"{c} 0 0 0 2 1 0 0 2 {a} {-b}\n" for c, (a, b) in ends.items())
    text += "".join(f"{f} 0 0 0 2 1 0 1 {f} 4 {' '.join(map(str, bounds[f]))}\n" for f in (1, 2)) + "$EndEntities\n"
    text += f"$Nodes\n1 {len(m.node)} 1 {max(m.node)}\n2 1 0 {len(m.node)}\n" + "".join(f"{k}\n" for k in m.node)
    text += "".join(f"{x} {y} 0\n" for x, y in m.node.values()) + "$EndNodes\n"
    text += f"$Elements\n9 {len(m.line) + len(m.tri)} 1 {len(m.line) + len(m.tri)}\n"
    number = 1
    for dim, kind, items in ((1, 1, m.line), (2, 2, m.tri)):
        for tag in range(1, 8 if dim == 1 else 3):
            run = of(items, tag)
            text += f"{dim} {tag} {kind} {len(run)}\n"
            for x in run:
                text += f"{number} {' '.join(map(str, x[:-1]))}\n"
                number += 1
    return text + "$EndElements\n"


def cells(m):
    at = {k: i for i, k in enumerate(m.node)}
    return [[at[a], at[b]] for a, b, _ in m.line] + [[at[v] for v in t[:3]] for t in m.tri], [x[-1] for x in m.line + m.tri]


def vtk(m):
    c, tag = cells(m)
    return (f"# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {len(m.node)} double\n"
            + "".join(f"{x} {y} 0\n" for x, y in m.node.values()) + f"CELLS {len(c)} {sum(len(k) + 1 for k in c)}\n"
            + "".join(f"{len(k)} {' '.join(map(str, k))}\n" for k in c) + f"CELL_TYPES {len(c)}\n"
            + "".join(f"{3 if len(k) == 2 else 5}\n" for k in c) + f"CELL_DATA {len(c)}\nSCALARS GeometricalEntityIds int 1\n"
            + "LOOKUP_TABLE default\n" + "".join(f"{t}\n" for t in tag))


def vtu(m):
    c, tag = cells(m)

    def array(name, kind, values, more=""):
        return f'<DataArray type="{kind}" Name="{name}" format="ascii"{more}>\n{" ".join(map(str, values))}\n</DataArray>\n'
    ends = [sum(len(k) for k in c[:i + 1]) for i in range(len(c))]
    return (f'<VTKFile type="UnstructuredGrid" version="1.0">\n<UnstructuredGrid>\n<Piece NumberOfPoints="{len(m.node)}" '
            f'NumberOfCells="{len(c)}">\n<Points>\n'
            + array("Points", "Float64", [v for x, y in m.node.values() for v in (x, y, 0)], ' NumberOfComponents="3"')
            + "</Points>\n<Cells>\n" + array("connectivity", "Int32", [v for k in c for v in k]) + array("offsets", "Int32", ends)
            + array("types", "UInt8", [3 if len(k) == 2 else 5 for k in c]) + "</Cells>\n<CellData>\n"
            + array("GeometricalEntityIds", "Int32", tag) + "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n")


def medit(m):
    at = {k: i + 1 for i, k in enumerate(m.node)}
    return (f"MeshVersionFormatted 2\nDimension 3\nVertices\n{len(m.node)}\n" + "".join(f"{x} {y} 0 0\n" for x, y in m.node.values())
            + f"Edges\n{len(m.line)}\n" + "".join(f"{at[a]} {at[b]} {c}\n" for a, b, c in m.line)
            + f"Triangles\n{len(m.tri)}\n" + "".join(f"{at[a]} {at[b]} {at[c]} {f}\n" for a, b, c, f in m.tri) + "End\n")


def inp(m):
    text = "*HEADING\nx\n*NODE\n" + "".join(f"{k}, {x}, {y}, 0\n" for k, (x, y) in m.node.items())
    number = 1
    for kind, prefix, items in (("T3D2", "Line", m.line), ("CPS3", "Surface", m.tri)):
        for x in items:
            text += f"*ELEMENT, type={kind}, ELSET={prefix}{x[-1]}\n{number}, {', '.join(map(str, x[:-1]))}\n"
            number += 1
    return text


def su2(m):
    at = {k: i for i, k in enumerate(m.node)}
    text = f"NDIME= 2\nNELEM= {len(m.tri)}\n" + "".join(f"5 {at[a]} {at[b]} {at[c]}\n" for a, b, c, _ in m.tri)
    text += f"NPOIN= {len(m.node)}\n" + "".join(f"{x} {y}\n" for x, y in m.node.values()) + "NMARK= 7\n"
    for c in range(1, 8):
        run = [x for x in m.line if x[2] == c]
        text += f"MARKER_TAG= c{c}\nMARKER_ELEMS= {len(run)}\n" + "".join(f"3 {at[a]} {at[b]}\n" for a, b, _ in run)
    return text


def unv(m):
    text = "    -1\n  2411\n" + "".join(f"{k:10d}         1         1        11\n {x:.16E} {y:.16E} 0.0\n" for k, (x, y) in m.node.items())
    text += "    -1\n    -1\n  2412\n"
    for i, x in enumerate(m.line + m.tri):
        kind = 11 if len(x) == 3 else 41
        text += f"{i + 1} {kind} {x[-1]} 0 7 {len(x) - 1}\n" + ("0 0 0\n" if kind == 11 else "") + " ".join(map(str, x[:-1])) + "\n"
    return text + "    -1\n"


def off(m):
    at = {k: i for i, k in enumerate(m.node)}
    return (f"OFF\n{len(m.node)} {len(m.tri)} 0\n" + "".join(f"{x} {y} 0\n" for x, y in m.node.values())
            + "".join(f"3 {at[a]} {at[b]} {at[c]}\n" for a, b, c, _ in m.tri))


def obj(m):
    at = {k: i + 1 for i, k in enumerate(m.node)}
    return ("".join(f"v {x} {y} 0\n" for x, y in m.node.values())
            + "".join(f"g {FACES[f]}\nf {at[a]} {at[b]} {at[c]}\n" for a, b, c, f in m.tri))


def ply(m):
    return ("ply\nformat ascii 1.0\n" + f"element vertex {len(m.node)}\n" + "".join(f"property double {c}\n" for c in "xyz")
            + f"element face {len(m.tri)}\nproperty list uchar int vertex_indices\nend_header\n" + off(m).split("\n", 2)[2])


def stl(m):
    text = ""
    for face in (1, 2):
        text += f"solid {FACES[face]}\n"
        for t in m.tri:
            if t[3] == face:
                corners = "".join(f"vertex {x} {y} 0\n" for x, y in (m.node[v] for v in t[:3]))
                text += f"facet normal 0 0 1\nouter loop\n{corners}endloop\nendfacet\n"
        text += f"endsolid {FACES[face]}\n"
    return text


def triangle(m):
    with open("x.ele", "w") as f:
        f.write(f"{len(m.tri)} 3 1\n" + rows(m.tri, lambda i, a, b, c, face: f"{i + 1} {a} {b} {c} {face}\n"))
    with open("x.poly", "w") as f:
        f.write(f"0 2 0 0\n{len(m.line)} 1\n" + rows(m.line, lambda i, a, b, c: f"{i + 1} {a} {b} {c}\n") + "0\n")
    return f"{len(m.node)} 2 0 0\n" + "".join(f"{k} {x} {y}\n" for k, (x, y) in m.node.items())


FORMATS = {  # extension: writer, what it can hold
    "msh": (msh4, {LINES, NAMES, POINTS, BOUNDS}), "msh2": (msh2, {LINES, NAMES, POINTS, NO_BOUNDS}),
    **{ext: (write, {LINES, POINTS, NO_BOUNDS}) for ext, write in
       {"vtk": vtk, "vtu": vtu, "mesh": medit, "inp": inp, "su2": su2, "unv": unv, "node": triangle}.items()},
    "off": (off, {POINTS}), "obj": (obj, {POINTS}), "ply": (ply, {POINTS}), "stl": (stl, set())}
# damage: rule, an error or a warning, what a format must hold for it
DAMAGES = [
    (nothing, None, None, set()), (duplicate_node, "duplicate-node", "error", {POINTS}), (orphan_node, "orphan-node", "warning", {POINTS}),
    (inverted_element, "orientation", "error", set()), (node_twice, "degenerate", "error", set()),
    (collinear_corners, "degenerate", "error", set()), (third_element_on_an_edge, "edge", "error", set()),
    (element_twice, "duplicate-element", "error", set()), (hole, "hole", "error", {BOUNDS}), (hole, "lost-edge", "warning", {NO_BOUNDS}),
    (lost_edge, "lost-edge", "error", {BOUNDS}), (lost_edge, "lost-edge", "warning", {NO_BOUNDS}),
    (t_junction, "t-junction", "error", set()), (group_without_elements, "group", "warning", {NAMES}),
    (two_groups_of_one_name, "group", "warning", {NAMES})]

def main(meshgen):
    count = 0
    for damage, rule, kind, needs in DAMAGES:
        for ext, (write, holds) in FORMATS.items():
            if not needs <= holds:
                continue
            m = Mesh()
            at = damage(m)
            with open(f"x.{ext}", "w") as f:
                f.write(write(m))
            r = subprocess.run([meshgen, "check", "-json", f"x.{ext}"], capture_output=True, text=True)
            count += 1
            try:
                found = json.loads(r.stdout)["findings"]
            except ValueError:
                found = [{"kind": "error", "rule": "json", "at": [0, 0], "text": r.stdout + r.stderr}]
            hits = [f for f in found if f["rule"] == rule and f["kind"] == kind]
            near = at is None or any(abs(f["at"][0] - at[0]) + abs(f["at"][1] - at[1]) < 0.35 for f in hits)
            good = r.returncode == (1 if kind == "error" else 0) and near and (bool(hits) if rule else not found)
            print(f"{'ok' if good else 'not ok'} {count} - {damage.__name__.replace('_', ' ')} in .{ext}")
            if not good:
                print(f"# exit {r.returncode}, {rule} at {at} wanted, found", *(f"{f['kind']} {f['rule']} {f['at']} {f['text']}" for f in found[:4]))


if __name__ == "__main__":
    main(sys.argv[1])
