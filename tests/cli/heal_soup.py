# heal_soup.py MESHGEN N - N random soups of polygons, each a surface of its own: healed, they cover the union of what they enclose
# SPDX-License-Identifier: MIT
import random, re, subprocess, sys
import numpy


def polygon(r, kind):
    n = r.randint(3, 8)
    if kind == 0:
        return [(r.random(), r.random()) for _ in range(n)]
    if kind == 1:  # on a grid: vertices on edges, edges on edges
        p = [(r.randint(0, 6) / 6, r.randint(0, 6) / 6) for _ in range(n)]
        return [q for i, q in enumerate(p) if q != p[i - 1]]
    x, y, w, h = (r.randint(a, b) / 10 for a, b in ((0, 5), (0, 5), (1, 5), (1, 5)))
    return [(x, y), (x + w, y), (x + w, y + h), (x, y + h)]


def inside(poly, x, y):
    odd = numpy.zeros(x.shape, bool)
    for (ax, ay), (bx, by) in zip(poly, poly[1:] + poly[:1]):
        if ay != by:
            odd ^= ((ay > y) != (by > y)) & (x < ax + (y - ay) * (bx - ax) / (by - ay))
    return odd


def area(poly):
    return sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(poly, poly[1:] + poly[:1])) / 2


def soup(seed):
    r = random.Random(seed)
    polys = [polygon(r, seed % 3) for _ in range(r.randint(1, 6))]
    return [p for p in polys if len(set(p)) > 2 and any(abs(area([p[0], b, c])) > 1e-9 for b in p for c in p)]


def script(polys):
    out, point, curve = [], 0, 0
    for k, p in enumerate(polys, 1):
        first, n = point + 1, len(p)
        out += ["Point(%d) = {%r, %r, 0, 0.1};" % (first + i, x, y) for i, (x, y) in enumerate(p)]
        out += ["Line(%d) = {%d, %d};" % (curve + 1 + i, first + i, first + (i + 1) % n) for i in range(n)]
        out.append("Curve Loop(%d) = {%d:%d}; Plane Surface(%d) = {%d};" % (k, curve + 1, curve + n, k, k))
        point, curve = point + n, curve + n
    return "\n".join(out) + '\nPhysical Surface("all") = {1:%d};\n' % len(polys)


def main():
    prog, bad = sys.argv[1], 0
    x, y = numpy.meshgrid((numpy.arange(700) + 0.4873) / 700, (numpy.arange(700) + 0.5177) / 700)
    for seed in range(int(sys.argv[2])):
        polys = [p for p in soup(seed) if inside(p, x, y).any()]
        covered = numpy.zeros(x.shape, bool)
        for p in polys:
            covered |= inside(p, x, y)
        if not covered.any():
            continue
        open("soup.geo", "w").write(script(polys))
        r = subprocess.run([prog, "-2", "-heal", "soup.geo", "-o", "soup.msh"], capture_output=True, text=True, timeout=20)
        m = re.search(r"all +\d+ +(\S+)", r.stdout)
        if r.returncode or not m or abs(float(m[1]) - covered.mean()) > 0.004:
            bad += 1
            print("seed", seed, "status", r.returncode, "area", m and m[1], "want", covered.mean(), r.stderr[:300])
    return bad != 0


sys.exit(main())
