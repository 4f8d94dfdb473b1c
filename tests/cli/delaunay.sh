# delaunay.sh - meshgen -delaunay: point files, segments, holes, regions, Voronoi, errors with lines
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/lib.sh"

"$PYTHON" -c "
import random
random.seed(1)
p = ['%r %r' % (random.random(), random.random()) for _ in range(500)]
open('a.xyz', 'w').write('\n'.join(p) + '\n0.5 0.5\n0.5 0.5\n')
random.shuffle(p)
open('b.xyz', 'w').write('\n'.join(p) + '\n0.5 0.5\n')
"
exits 0 "points are triangulated" "$MESHGEN" -delaunay a.xyz -o a.msh -o a.vtk -o a.png --json
prints '"triangles": 9' "the report counts the triangles"
prints '"duplicates": 1' "and the duplicates"
says "1 points are equal to earlier ones" "duplicates are announced"
check "the pictures are there" test -s a.png
exits 0 "one by one" "$MESHGEN" -delaunay -insertion a.xyz -o i.msh --json
check "the walks and cavities are counted" "$PYTHON" -c "
import json
d = json.load(open('out.txt'))['delaunay']
assert d['insertions'] > 490 and 1 < d['walk_steps'] < 2.5 and 3.5 < d['cavity'] < 4.2 and d['merge_triangles'] == 0, d
"
exits 0 "the triangles are the same" "$MESHGEN" diff a.msh i.msh
exits 0 "Voronoi cells" "$MESHGEN" -delaunay -voronoi a.xyz -o v.vtk -o v.ply -o v.obj -o v.off -o v.msh -o v.svg
check "are polygons, one a point, that fill a rectangle" "$PYTHON" -c "
import meshio, vtk
r = vtk.vtkUnstructuredGridReader()
r.SetFileName('v.vtk')
r.Update()
g = r.GetOutput()
area = 0
for k in range(g.GetNumberOfCells()):
    c = g.GetCell(k).GetPoints()
    p = [c.GetPoint(i) for i in range(c.GetNumberOfPoints())]
    area += sum(p[i-1][0] * p[i][1] - p[i-1][1] * p[i][0] for i in range(len(p))) / 2
b = g.GetBounds()
want = (b[1] - b[0]) * (b[3] - b[2])
ids = g.GetCellData().GetArray('point')
assert abs(area - want) < 1e-12 * want and sorted(int(ids.GetTuple1(k)) for k in range(501)) == list(range(1, 502)), area
for f in ('v.ply', 'v.obj'):
    assert sum(len(b.data) for b in meshio.read(f).cells) == 501
"
exits 0 "one thread or two" "$MESHGEN" -delaunay a.xyz -nt 1 -o one.msh
exits 0 "two threads" "$MESHGEN" -delaunay a.xyz -nt 2 -o two.msh
check "give the same bytes" cmp one.msh two.msh

cat >d.poly <<'END'
# a square with a square hole
8 2 0 0
1 0 0
2 4 0
3 4 4
4 0 4
5 1 1
6 3 1
7 3 3
8 1 3
8 1
1 1 2 30
2 2 3 30
3 3 4 7
4 4 1
5 5 6
6 6 7
7 7 8
8 8 5
1
1 2 2
1
1 0.1 0.1 7 0
END
exits 0 "a .poly with a hole and a region" "$MESHGEN" -delaunay d.poly -o d.msh --json
prints '"triangles": 8' "the hole is left out"
check "boundary marks are the numbers of curves" "$PYTHON" -c "
import collections, meshio
tags = meshio.read('d.msh').cell_data_dict['gmsh:geometrical']['line']
assert collections.Counter(map(int, tags)) == {7: 1, 30: 2, 31: 5}, tags
"
check "the region is the face's number" grep -q '^7 0 0 0 4 4 0' d.msh

printf '4 2 0 0\n1 0 0\n2 4 0\n3 4 4\n4 0 4\n2 0\n1 1 3\n2 2 4\n0\n' >x.poly
exits 1 "crossing segments are refused" "$MESHGEN" -delaunay x.poly -o x.msh
says "segments 2 and 1 (counted from 1) cross at (2, 2)" "and named with the point"
check "nothing is written" test ! -e x.msh
printf '# c\n1 2\n3 nan\n' >n.xyz
exits 1 "nan is refused" "$MESHGEN" -delaunay n.xyz
says "n.xyz:3: y is not a finite number" "with the line"
printf '1 2\n3\n' >m.xyz
exits 1 "a missing number is refused" "$MESHGEN" -delaunay m.xyz
says "m.xyz:2: y is missing" "with the line too"
: >e.xyz
exits 1 "an empty file is refused" "$MESHGEN" -delaunay e.xyz
says "e.xyz:1: the file ends without a point" "with its line"
printf '# nothing\n\n' >e2.xyz
exits 1 "one with comments alone, too" "$MESHGEN" -delaunay e2.xyz
says "e2.xyz:2: the file ends without a point" "with the last line"
printf '1 2\n-inf 3\n' >i.xyz
exits 1 "infinity is refused" "$MESHGEN" -delaunay i.xyz
says "i.xyz:2: x is not a finite number" "with the line"
exits 3 "a missing file is refused" "$MESHGEN" -delaunay none.xyz
printf '0 0\n1 1\n2 2\n' >l.xyz
exits 0 "points on a line have no triangles" "$MESHGEN" -delaunay l.xyz -o l.msh
printf '0 0\n' >o.xyz
exits 0 "one point" "$MESHGEN" -delaunay o.xyz -o o.msh
echo "1..$count"
