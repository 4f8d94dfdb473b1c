# structured_vs_gmsh.py - one .geo a case, meshed by both; equal elements on equal nodes. Prints TAP.
# SPDX-License-Identifier: MIT
# Uniform nodes on straight curves agree to 1e-10. Others agree as far as the quadrature goes by which gmsh places its nodes: 2e-8 where
# the speed along the curve is constant, 5e-7 on splines.
import os, subprocess, sys, tempfile
from collections import Counter
import numpy as np

FINE, COARSE, SPLINE = 1e-10, 2e-8, 5e-7
QUAD = """Point(1)={0,0,0,1};Point(2)={2,0.2,0,1};Point(3)={2.5,1.5,0,1};Point(4)={-0.3,1,0,1};
Line(1)={1,2};Line(2)={2,3};Line(3)={3,4};Line(4)={4,1};Curve Loop(1)={1,2,3,4};%s(1)={1};
"""
UNIFORM = "Transfinite Curve{1,3}=7;Transfinite Curve{2,4}=5;\n"
PLANE = QUAD % "Plane Surface" + UNIFORM
FILL = QUAD % "Surface"
TRI = """Point(1)={0,0,0,1};Point(2)={2,0.2,0,1};Point(3)={0.8,1.7,0,1};
Line(1)={1,2};Line(2)={2,3};Line(3)={3,1};Curve Loop(1)={1,2,3};Plane Surface(1)={1};
"""
ANNULUS = """Point(1)={0,0,0,1};Point(2)={1,0,0,1};Point(3)={2,0,0,1};Point(4)={0,2,0,1};Point(5)={0,1,0,1};
Line(1)={2,3};Circle(2)={3,1,4};Line(3)={4,5};Circle(4)={5,1,2};Curve Loop(1)={1,2,3,4};%s(1)={1};
"""
CURVED = """Point(1)={0,0,0,1};Point(2)={2,0,0,1};Point(3)={2,1,0,1};Point(4)={0,1,0,1};Point(5)={1,0.3,0,1};Point(6)={0.5,-0.2,0,1};
%s;Line(2)={2,3};Line(3)={3,4};Line(4)={4,1};Curve Loop(1)={1,2,3,4};Plane Surface(1)={1};
"""
LINE = "Point(1)={1,0,0,1};Point(2)={2,0.3,0,1};Line(1)={1,2};Transfinite Curve{1}=4;\n"
SPOKE = "Point(1)={0,0,0,1};Point(2)={2,0.3,0,1};Line(1)={%s};Transfinite Curve{1}=4;\n"
MANY = """Point(1)={0,0,0,1};Point(2)={1,0,0,1};Point(3)={2,0.3,0,1};Point(4)={2,1,0,1};Point(5)={0.7,1.2,0,1};Point(6)={0,1,0,1};
Line(1)={1,2};Line(2)={2,3};Line(3)={3,4};Line(4)={4,5};Line(5)={5,6};Line(6)={6,1};Curve Loop(1)={1:6};Plane Surface(1)={1};
Transfinite Curve{1,4}=5;Transfinite Curve{2,5}=4;Transfinite Curve{3,6}=6;
"""

CASES = [
    ("default arrangement", PLANE + "Transfinite Surface{1};", FINE),
    ("Left", PLANE + "Transfinite Surface{1} Left;", FINE),
    ("Right", PLANE + "Transfinite Surface{1} Right;", FINE),
    ("Alternate", PLANE + "Transfinite Surface{1} Alternate;", FINE),
    ("AlternateRight", PLANE + "Transfinite Surface{1} AlternateRight;", FINE),
    ("AlternateLeft", PLANE + "Transfinite Surface{1} AlternateLeft;", FINE),
    ("recombined", PLANE + "Transfinite Surface{1};Recombine Surface{1};", FINE),
    ("all surfaces", PLANE + "Transfinite Surface{:};", FINE),
    ("corners from the third", PLANE + "Transfinite Surface{1}={3,4,1,2} Right;", FINE),
    ("corners the other way round", PLANE + "Transfinite Surface{1}={2,1,4,3} AlternateLeft;", FINE),
    ("clockwise loop", PLANE.replace("{1,2,3,4};Plane", "{-4,-3,-2,-1};Plane") + "Transfinite Surface{1};", FINE),
    ("sides of several curves", MANY + "Transfinite Surface{1}={1,3,4,6};", FINE),
    ("sides of several curves, recombined", MANY + "Transfinite Surface{1}={4,6,1,3};Recombine Surface{1};", FINE),
    ("progression", QUAD % "Plane Surface" + "Transfinite Curve{1,-3}=7 Using Progression 1.3;Transfinite Curve{2,4}=5;Transfinite Surface{1};", COARSE),
    ("progressions all round", QUAD % "Plane Surface" + "Transfinite Curve{1,3}=7 Using Progression 1.3;Transfinite Curve{-2}=5 Using Progression 1.2;Transfinite Curve{4}=5 Using Progression 0.7;Transfinite Surface{1};", COARSE),
    ("bump", QUAD % "Plane Surface" + "Transfinite Curve{1,3}=8 Using Bump 0.2;Transfinite Curve{2,4}=6 Using Bump 4;Transfinite Surface{1};", COARSE),
    ("quarter of an annulus", ANNULUS % "Plane Surface" + "Transfinite Curve{1,3}=4;Transfinite Curve{2,4}=9;Transfinite Surface{1};", COARSE),
    ("annulus, progression along the arcs", ANNULUS % "Plane Surface" + "Transfinite Curve{1,-3}=4;Transfinite Curve{2,-4}=9 Using Progression 1.15;Transfinite Surface{1};Recombine Surface{1};", COARSE),
    ("spline side", CURVED % "Spline(1)={1,6,5,2}" + UNIFORM + "Transfinite Surface{1};", SPLINE),
    ("B-spline side", CURVED % "BSpline(1)={1,6,5,2}" + UNIFORM + "Transfinite Surface{1} Right;", SPLINE),
    ("Bezier side", CURVED % "Bezier(1)={1,6,5,2}" + UNIFORM + "Transfinite Surface{1};", SPLINE),
    ("smoother", CURVED % "Bezier(1)={1,6,5,2}" + UNIFORM + "Transfinite Surface{1};Smoother Surface{1}=7;", SPLINE),
    ("Mesh.Smoothing", ANNULUS % "Plane Surface" + "Transfinite Curve{1,3}=6;Transfinite Curve{2,4}=9;Transfinite Surface{1};Mesh.Smoothing=5;", COARSE),
    ("three corners", TRI + "Transfinite Curve{1,3}=6;Transfinite Curve{2}=4;Transfinite Surface{1};", FINE),
    ("three corners, the second is the apex", TRI + "Transfinite Curve{1,2}=6;Transfinite Curve{3}=4;Transfinite Surface{1}={2,3,1};", FINE),
    ("three corners recombined", TRI + "Transfinite Curve{1:3}=5;Transfinite Surface{1};Recombine Surface{1};", FINE),
    ("three corners, Right", TRI + "Transfinite Curve{1:3}=5;Transfinite Surface{1} Right;", FINE),
    ("filling", FILL + UNIFORM + "Transfinite Surface{1};", FINE),
    ("filling, graded", FILL + "Transfinite Curve{1,3}=7 Using Progression 1.2;Transfinite Curve{2,4}=5;Transfinite Surface{1};", COARSE),
    ("filling of arcs", ANNULUS % "Surface" + "Transfinite Curve{1,3}=4;Transfinite Curve{2,4}=9;Transfinite Surface{1};", COARSE),
    ("plane x = 0", PLANE.replace("2,0.2,0,1", "0,0.2,2,1").replace("2.5,1.5,0,1", "0,1.5,2.5,1").replace("-0.3,1,0,1", "0,1,-0.3,1") + "Transfinite Surface{1};", FINE),
    ("extrusion", LINE + "Extrude {-0.1,1,0}{ Line{1}; Layers{3}; }", FINE),
    ("extrusion, graded layers", LINE + "Extrude {-0.1,1,0}{ Line{1}; Layers{{1,2,2},{0.2,0.5,1}}; }", FINE),
    ("extrusion, recombined", LINE + "Extrude {-0.1,1,0}{ Line{1}; Layers{3}; Recombine; }", FINE),
    ("extrusion of a point and of its curve", "Point(1)={0,0,0,1};Extrude {1,0.2,0}{ Point{1}; Layers{4}; }\nExtrude {0,1,0}{ Line{1}; Layers{{2,3},{0.3,1}}; Recombine; }", FINE),
    ("extrusion backwards", LINE.replace("{1,2}", "{2,1}") + "Extrude {0,1,0}{ Line{1}; Layers{2}; }", FINE),
    ("extrusion of an arc", "Point(1)={0,0,0,1};Point(2)={1,0,0,1};Point(3)={0,1,0,1};Circle(1)={2,1,3};Transfinite Curve{1}=7;\nExtrude {2,2,0}{ Line{1}; Layers{3}; }", COARSE),
    ("rotation", LINE + "Extrude {{0,0,1},{0,0,0},1.2}{ Line{1}; Layers{3}; }", FINE),
    ("rotation, graded and recombined", LINE + "Extrude {{0,0,1},{0,-1,0},-0.8}{ Line{1}; Layers{{2,2},{0.3,1}}; Recombine; }", FINE),
    ("rotation about an end point", SPOKE % "1,2" + "Extrude {{0,0,1},{0,0,0},1.2}{ Line{1}; Layers{3}; }", FINE),
    ("rotation about the other end, recombined", SPOKE % "2,1" + "Extrude {{0,0,1},{0,0,0},1.2}{ Line{1}; Layers{3}; Recombine; }", FINE),
    ("four rotations to a ring", LINE + "".join("r%d[]=Extrude {{0,0,1},{0,0,0},Pi/2}{ Line{%s}; Layers{4}; };\n" % (i, "1" if i == 0 else "r%d[0]" % (i - 1)) for i in range(3)), FINE),
]


def read(path):
    lines = open(path).read().split("\n")
    i = lines.index("$Nodes")
    rows = [l.split() for l in lines[i + 2 : i + 2 + int(lines[i + 1])]]
    xyz, index = np.array([[float(v) for v in r[1:4]] for r in rows]), {r[0]: k for k, r in enumerate(rows)}
    i = lines.index("$Elements")
    elems = []
    for l in lines[i + 2 : i + 2 + int(lines[i + 1])]:
        w = l.split()
        if w[1] in ("1", "2", "3"):
            elems.append((int(w[1]), [index[v] for v in w[3 + int(w[2]) :]]))
    return xyz, elems


def cells(elems, number):
    """Elements as sets of nodes, quadrangles with their order but not where they begin or which way they turn."""
    out = Counter()
    for t, nodes in elems:
        v = [number[k] for k in nodes]
        if t == 3:
            k = v.index(min(v))
            v = v[k:] + v[:k]
            v = min(v, [v[0]] + v[:0:-1])
        else:
            v = sorted(v)
        out[(t, tuple(v))] += 1
    return out


def compare(a, b, tolerance):
    (xa, ea), (xb, eb) = read(a), read(b)
    ua, ub = ({k for _, n in e for k in n} for e in (ea, eb))
    if len(ua) != len(ub):
        return "%d nodes in elements, gmsh has %d" % (len(ua), len(ub))
    ub = sorted(ub)
    number, worst = {}, 0
    for k in sorted(ua):
        d = np.abs(xb[ub] - xa[k]).max(axis=1)
        number[k] = ub[int(np.argmin(d))]
        worst = max(worst, float(d.min()))
    if worst > tolerance:
        return "nodes differ by %.3g" % worst
    ca, cb = cells(ea, number), cells(eb, {k: k for k in ub})
    return "" if ca == cb else "%d elements differ" % sum(((ca - cb) + (cb - ca)).values())


def main():
    failed, mine = 0, os.environ["MESHGEN"]
    print("1..%d" % len(CASES))
    with tempfile.TemporaryDirectory() as folder:
        for i, (name, text, tolerance) in enumerate(CASES):
            geo, a, b = (os.path.join(folder, "case." + x) for x in ("geo", "a", "b"))
            with open(geo, "w") as f:
                f.write(text + "\n")
            subprocess.run(["gmsh", "-2", "-v", "1", "-format", "msh22", "-o", b, geo], check=True, stdout=subprocess.DEVNULL)
            p = subprocess.run([mine, "-2", "-v", "1", "-no_report", "-format", "msh22", "-o", a, geo], stderr=subprocess.PIPE, text=True)
            why = "exit status %d: %s" % (p.returncode, p.stderr.strip()) if p.returncode else compare(a, b, tolerance)
            failed += bool(why)
            print("%sok %d - %s%s" % ("not " if why else "", i + 1, name, "\n# " + why if why else ""))
    sys.exit(1 if failed else 0)


main()
