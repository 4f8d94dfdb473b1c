# cell_data.sh - quality measures written beside the mesh: the same in every format, and read by others
. "$(dirname "$0")/lib.sh"

exits 0 "measures in four formats" "$MESHGEN" -2 "$ROOT/geo/conge.geo" -clscale 2 -cell_data gamma,kappa1,angle -no_report \
  -o c.msh -o c.vtk -o c.vtu -o c2.msh2
exits 0 "and in binary" "$MESHGEN" c.msh -bin -cell_data gamma,kappa1,angle -no_report -o cb.msh -o cb.vtk -o cb2.msh2
"$MESHGEN" c.msh --json -o again.vtk >report.json 2>/dev/null
cat >values.py <<'END'
import json
import sys

import meshio
import numpy as np
import vtk


def of_meshio(path, name):
    return np.concatenate(meshio.read(path).cell_data[name])


def of_vtk(path, name):
    reader = vtk.vtkXMLUnstructuredGridReader() if path.endswith("vtu") else vtk.vtkUnstructuredGridReader()
    reader.SetFileName(path)
    if path.endswith("vtk"):
        reader.ReadAllScalarsOn()
    reader.Update()
    array = reader.GetOutput().GetCellData().GetArray(name)
    return np.array([array.GetValue(i) for i in range(array.GetNumberOfValues())])


def of_msh2(path, name):  # meshio's reader of MSH 2 knows no element data
    text = open(path, "rb").read()
    at = text.index(b'$ElementData\n1\n"%s"\n1\n0\n3\n0\n1\n' % name.encode())
    head, rest = text[at:].split(b"\n", 9)[8:]
    n = int(head)
    if b"$MeshFormat\n2.2 1 8" in text[:40]:
        return np.frombuffer(rest[:12 * n], dtype=[("id", "<i4"), ("v", "<f8")])["v"]
    return np.array([float(line.split()[1]) for line in rest.split(b"\n")[:n]])


report = json.load(open("report.json"))["mesh"]
for name, figure in (("gamma", "min_gamma"), ("kappa1", "min_kappa1"), ("angle", "min_angle")):
    want = of_meshio("c.msh", name)
    surface = want[want != 0]
    assert len(surface) == report["elements"] and abs(surface.min() - report[figure]) < 1e-9, name
    for path, read in (("cb.msh", of_meshio), ("c.vtk", of_vtk), ("cb.vtk", of_vtk), ("c.vtu", of_vtk)):
        assert np.array_equal(read(path, name), want), (path, name)
    for path in ("c2.msh2", "cb2.msh2"):  # there in another order
        assert np.array_equal(np.sort(of_msh2(path, name)), np.sort(want)), (path, name)
END
check "the same values, read by meshio and VTK" "$PYTHON" values.py
check "the mesh is the same with and without" sh -c "'$MESHGEN' c.vtk -o d.vtk -no_report && '$MESHGEN' diff c.vtk d.vtk"
exits 0 "a format without room for them" "$MESHGEN" c.msh -cell_data gamma -no_report -o c.su2
says "format su2 has no room for the measures of elements" "is told"
exits 2 "a measure that there is not" "$MESHGEN" c.msh -cell_data gamma,beauty -no_report -o c.vtk
says "not 'beauty'" "and which"
exits 0 "pictures by any measure" "$MESHGEN" c.msh -color_by kappa4 -width 400 -no_report -o c.svg
