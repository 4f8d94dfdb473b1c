"""Every message is provoked: messages.py MESHGEN ROOT. Prints TAP.

Two tables of inputs with what must be said of them: files that readers refuse, and command lines with scripts. Then the messages
are listed from the sources, src/cli, src/out and src/mesh: each must be said by some test, here or elsewhere in tests/. Of a message
the longest piece between its conversions is looked for. A new message without a test fails here: add the test, not an exception.
"""
import glob
import os
import re
import struct
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import broken_meshes  # noqa: E402

meshgen, root = sys.argv[1], sys.argv[2]
count, heard = 0, ""


def say(name, good, *why):
    global count
    count += 1
    print(f"ok {count} - {name}" if good else f"not ok {count} - {name}")
    if not good:
        print("".join(f"# {line}\n" for w in why for line in str(w).splitlines()[:8]), end="")


def run(name, words, status, text):
    global heard
    r = subprocess.run([meshgen, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=60)
    said = (r.stderr + r.stdout).decode(errors="replace")
    heard += said
    say(name, r.returncode == status and text in said, f"exit status {r.returncode}, want {status}", "want: " + text, "got: " + said)


# ---- files that are not read: extension, contents, message ----------------------------------------------------------------------------
M2, M4 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
N2 = "$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n"
N4 = "$Nodes\n1 3 1 3\n2 1 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n"
VTK = "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n"
P3 = "POINTS 3 double\n0 0 0 1 0 0 0 1 0\n"
V1 = '<VTKFile type="UnstructuredGrid"{}>\n<UnstructuredGrid><Piece><Points>{}</Points>'
U5 = "    -1\n  2411\n1 1 1 11\n0 0 0\n2 1 1 11\n1 0 0\n3 1 1 11\n0 1 0\n    -1\n"
INP = "*NODE\n1, 0, 0\n2, 1, 0\n3, 0, 1\n"
SU2 = "NDIME= 2\nNELEM= 1\n5 0 1 2\nNPOIN= 3\n0 0\n1 0\n0 1\n"


def array(text, kind="Float64", form="binary", more=""):
    return f'<DataArray type="{kind}" format="{form}"{more}>{text}</DataArray>'


FILES = [
    ("msh", "", "this is no MSH file: neither $MeshFormat nor $NOD"),
    ("msh", N2, "$MeshFormat (or $NOD) expected before $Nodes"),
    ("msh", M2 + M2, "a second $MeshFormat"),
    ("msh", M2 + N2 + N2, "a second section $Nodes"),
    ("msh", "$MeshFormat\n5 0 8\n$EndMeshFormat\n", "MSH version 5 is not read (1, 2, 2.1, 2.2, 4 and 4.1 are)"),
    ("msh", "$MeshFormat\n4.1 0 4\n$EndMeshFormat\n", "data size 4 is not read (8 is)"),
    ("msh", b"$MeshFormat\n4.1 1 8\n\2\0\0\0\n$EndMeshFormat\n", "the byte-order mark is neither 1 nor 1 reversed"),
    ("msh", M2 + "$PhysicalNames\n1\n2 1 name\n$EndPhysicalNames\n", "a name in quotes expected"),
    ("msh", M2 + "$Nodes\n1\n1 0 x 0\n$EndNodes\n", "a coordinate expected, found 'x'"),
    ("msh", M2 + "$Nodes\n1\n1 0                 ", "a coordinate expected, found the end of the file"),
    ("msh", M2 + "$Nodes\n1\n1 0 nan 0\n$EndNodes\n", "a coordinate is not a finite number"),
    ("msh", M2 + "$Nodes\n99\n1 0 0 0\n$EndNodes\n", "99 nodes do not fit in what is left of the file"),
    ("msh", M2 + "$Nodes\n2\n1 0 0 0\n1 1 0 0\n$EndNodes\n", "node 1 is defined twice"),
    ("msh", M2 + "$Nodes\n2\n5 0 0 0\n-1 1 0 0\n$EndNodes\n", "node number out of range"),
    ("msh", M2 + N2 + "$Elements\n1\n1 2 0 1 2 7\n$EndElements\n", "node 7 is not defined"),
    ("msh", M2 + N2 + "$Elements\n1\n1 99 0 1 2 3\n$EndElements\n", "element type 99 is not known here"),
    ("msh", M2 + N2 + "$Elements\n1\n1 999 0 1 2 3\n$EndElements\n", "element type 999 is out of range"),
    ("msh", M2 + N2 + "$Elements\n1\n1 2 2 9999999999 1 1 2 3\n$EndElements\n", "a tag is out of range"),
    ("msh", M2 + N2 + "$Elements\n1\n1 2 4 1 1 1 9999999 1 2 3\n$EndElements\n", "part 9999999: parts are 1 to 1000000"),
    ("msh", M4 + "$PartitionedEntities\n2\n0\n2 0 0 0\n1 0 1 1 1 0 0 0 0\n1 0 1 1 2 0 0 0 0\n$EndPartitionedEntities\n" + N4,
     "entity 1 of dimension 0 is defined twice"),
    ("msh", "$NOD\n1\n1 0 0 0\n$ENDNOD\n$ELM\n1\n1 2 1 1 2 1 1\n$ENDELM\n", "an element of type 2 has 3 nodes"),
    ("msh", M2 + N2 + "$Periodic\n1\n5 1 2\n0\n$EndPeriodic\n", "dimension 5 of a periodic link"),
    ("msh", M2 + "$Nodes\n1\n1 0 0 0\n$EndNode\n", "$EndNodes expected"),
    ("msh", M2 + "$Extra\n1 2 3\n", "section $Extra does not end"),
    ("msh", M4 + "$Nodes\n1 2 1 2\n7 1 0 2\n1\n2\n0 0 0\n1 0 0\n$EndNodes\n", "dimension 7 of a block"),
    ("msh", M4 + "$Nodes\n1 2 1 2\n2 1 0 1\n1\n0 0 0\n$EndNodes\n" + " " * 30, "2 nodes were announced, 1 are there"),
    ("msh", M4 + N4 + "$Elements\n1 2 1 1\n2 1 2 1\n1 1 2 3\n$EndElements\n", "2 elements were announced, 1 are there"),
    ("msh", M4 + N4 + "$Elements\n1 1 1 1\n1 1 2 1\n1 1 2 3\n$EndElements\n", "elements of type 2 in an entity of dimension 1"),
    ("msh", M4 + "$Entities\n2 0 0 0\n1 0 0 0 0\n1 1 0 0 0\n$EndEntities\n" + N4, "entity 1 of dimension 0 is defined twice"),
    ("msh", b"$MeshFormat\n2.2 1 8\n\1\0\0\0\n$EndMeshFormat\n$Nodes\n1\n" + b"\1\0\0\0" + bytes(24) + b"\n$EndNodes\n$Elements\n1\n"
     + struct.pack("<iii", 15, 7, 2) + bytes(40), "an element header of 7 elements with 2 tags"),
    ("msh", b"$MeshFormat\n4.1 1 8\n\1\0\0\0\n$EndMeshFormat\n$Elements\n" + struct.pack("<4Q3iQ", 1, 9, 1, 9, 2, 1, 2, 9) + bytes(80),
     "the file ends within a block of 9 elements"),
    ("msh", b"$MeshFormat\n4.1 1 8\n\1\0\0\0\n$EndMeshFormat\n$Elements\n" + bytes(9), "the file ends within"),
    ("msh", M4 + "$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n",
     "1 elements of dimension 3 are left out"),
    ("msh", M2 + "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 1 1 0\n$EndNodes\n$Elements\n2\n1 2 4 1 1 1 2 1 2 3\n2 2 2 1 1 2 4 3\n$EndElements\n", "not every element is in a part, so the parts are left out"),
    ("vtk", "hello", "this is no legacy VTK file"),
    ("vtk", "# vtk DataFile Version 3.0\nx\nASCII\nPOINTS 1\n", "DATASET expected"),
    ("vtk", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_GRID\n", "data set 'STRUCTURED_GRID' is not read"),
    ("vtk", VTK + "POINTS 1 quaternion\n0 0 0\n", "data type 'quaternion' is not read"),
    ("vtk", VTK + P3 + "HOLES 1\n", "keyword 'HOLES' is not read"),
    ("vtk", VTK + P3 + "CELLS 1 4\n9 0 1 2\n", "cell 0 does not fit in the 4 numbers of CELLS"),
    ("vtk", VTK + P3 + "CELLS 2 3\nOFFSETS vtktypeint64\n0 3\nHELLO vtktypeint64\n0 1 2\n", "CONNECTIVITY expected"),
    ("vtk", VTK + P3 + "CELLS 2 3\nOFFSETS vtktypeint64\n0 9\nCONNECTIVITY vtktypeint64\n0 1 2\nCELL_TYPES 1\n5\n", "cell 0 lies outside of the connectivity"),
    ("vtk", VTK + P3 + "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n9\n", "cell 0: VTK type 9 with 3 points is not read"),
    ("vtk", VTK + P3 + "CELLS 1 4\n3 0 1 2\nCELL_TYPES 2\n5 5\n", "1 cells, but types for 2"),
    ("vtk", VTK + P3 + "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5\nCELL_DATA 2\nSCALARS CellEntityIds int 1\nLOOKUP_TABLE default\n1 1\n", "groups for 2 of 1 cells"),
    ("vtk", VTK + P3 + "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5\nCELL_DATA 2\nSCALARS GeometricalEntityIds int 1\nLOOKUP_TABLE default\n1 1\n", "entities for 2 of 1 cells"),
    ("vtk", VTK + P3 + "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5\nCELL_DATA 2\nSCALARS partition int 1\nLOOKUP_TABLE default\n1 1\n", "parts for 2 of 1 cells"),
    ("vtk", VTK + P3 + "CELL_DATA 1\nFIELD f 1\na 2000 1 int\n", "2000 components"),
    ("vtk", (VTK.replace("ASCII", "BINARY") + "POINTS 1 double\n").encode() + struct.pack(">3d", float("nan"), 0, 0)
     + b"\nCELLS 1 2\n" + struct.pack(">2i", 1, 0) + b"\nCELL_TYPES 1\n" + struct.pack(">i", 1), "point 0 is not finite"),
    ("vtu", "hello", "this is no VTK XML file"),
    ("vtu", '<VTKFile type="PolyData">', "VTK data of type 'PolyData' are not read"),
    ("vtu", '<VTKFile type="UnstructuredGrid" compressor="vtkLZ4DataCompressor">', "compressor 'vtkLZ4DataCompressor' is not read"),
    ("vtu", '<VTKFile type="UnstructuredGrid"><Piece></Piece><Piece>', "a file of several pieces is not read"),
    ("vtu", '<VTKFile type="UnstructuredGrid"></VTKFile>', "the cells' arrays do not agree"),
    ("vtu", V1.format("", array("0", "Complex")), "an array of a type that is not read"),
    ("vtu", V1.format("", array("0", form="paper")), "an array of format 'paper'"),
    ("vtu", V1.format("", array("", form="appended", more=' offset="99"')) + '<AppendedData encoding="raw">_x', "an array at offset 99, which the file does not have"),
    ("vtu", V1.format("", array("AA==")), "an array ends within its header"),
    ("vtu", V1.format("", array("/wAAAAAA")), "an array of 255 bytes is cut off"),
    ("vtu", V1.format("", array("", form="appended", more=' offset="0"')).encode() + b'<AppendedData encoding="raw">_' + struct.pack("<I", 255), "an array of 255 bytes is cut off"),
    ("vtu", V1.format(' compressor="vtkZLibDataCompressor"', array("/////wAAAAAAAAAA")), "4294967295 compressed blocks do not fit in the file"),
    ("vtu", V1.format(' compressor="vtkZLibDataCompressor"', array("AQAAAAAAAAAAAAAA")), "an array ends within its header"),
    ("vtu", V1.format(' compressor="vtkZLibDataCompressor"', array("AQAAAAgAAAAIAAAA/wAAAA==AAAA")), "a compressed block does not fit in the data"),
    ("vtu", V1.format(' compressor="vtkZLibDataCompressor"', array("AQAAAAgAAAAIAAAAAwAAAA==AAAA")), "a compressed block is damaged"),
    ("mesh", "Vertices\n0\n", "this is no Medit file: no MeshVersionFormatted"),
    ("inp", "hello", "this is no Abaqus file: no line begins with a keyword"),
    ("inp", INP + "*ELEMENT, TYPE=DASHPOT\n1, 1, 2, 3\n", "element type 'DASHPOT' is not read"),
    ("inp", INP + "*ELEMENT, TYPE=CPS3\n-1, 1, 2, 3\n", "element number -1"),
    ("inp", INP + "*ELEMENT, TYPE=CPS3\n1, 1, 2, 3\n1, 1, 2, 3\n", "element 1 is defined twice"),
    ("inp", INP + "*ELEMENT, TYPE=CPS3\n1, 1, 2, 3\n*ELSET\n1\n", "*ELSET without ELSET="),
    ("inp", INP + "*ELEMENT, TYPE=CPS3\n1, 1, 2, 3\n*ELSET, ELSET=a, GENERATE\n1, 3, 0\n", "a range from 1 to 3 by 0"),
    ("su2", "NDIME= 3\n", "only meshes of dimension 2 are read"),
    ("su2", "NDIME= 2\n", "no NELEM= in this file"),
    ("su2", "NELEM= x\n", "the number of elements expected"),
    ("su2", SU2.replace("5 0 1 2", "3 0 1"), "a cell of type 3 where dimension 2 is due"),
    ("su2", "MARKER_ELEMS= 1\n3 0 1\n", "MARKER_ELEMS before MARKER_TAG"),
    ("unv", "", "this is no universal file: no data set"),
    ("unv", "hello", "the -1 that begins a data set expected"),
    ("unv", "    -1\n  2411\n", "data set 2411 does not end"),
    ("unv", U5 + "    -1\n  2412\n1 77 1 0 7 3\n1 2 3\n    -1\n", "element type 77 is not read"),
    ("unv", U5 + "    -1\n  2412\n1 41 1 0 7 4\n1 2 3 1\n    -1\n", "an element of type 41 with 4 nodes"),
    ("unv", U5 + "    -1\n  2412\n1 41 1 0 7 3\n1 2 3\n1 41 1 0 7 3\n1 2 3\n    -1\n", "element 1 is defined twice"),
    ("unv", U5 + "    -1\n  2477\n1 0 0 0 0 0 0 0", "the name of a group expected"),
    ("node", "1 3 0 0\n1 0 0\n", "nodes of dimension 3"),
    ("off", "hello", "OFF expected"),
    ("off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n5 0 1 2 0 1\n", "a face of 5 corners (3 and 4 are read)"),
    ("obj", "f 1 2 3\n", "node 1 is not defined"),
    ("obj", "# nothing\n", "no line begins with v"),
    ("obj", "v 0 0 0\nv 1 0 0\nf 1 x\n", "a corner expected"),
    ("obj", "v 0 0 0\nv 1 0 0\nf 1 2 1 2 1\n", "a face of more than 4 corners"),
    ("ply", "hello", "ply expected"),
    ("ply", "ply\nformat ascii 1.0\n", "end_header expected"),
    ("ply", "ply\nelement vertex 1\nproperty quaternion x\nend_header\n", "a property of type 'quaternion'"),
    ("ply", "ply\nelement face 1\nproperty list float int vertex_indices\nend_header\n", "a list counted by 'float'"),
    ("ply", "ply\nelement vertex 1\n" + "property int a\n" * 65 + "end_header\n", "more than 64 properties"),
    ("ply", "ply\nformat ascii 1.0\nelement face 1\nproperty list char int vertex_indices\nend_header\n-1\n", "a list of -1 things"),
    ("ply", b"ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty double x\nend_header\n" + struct.pack("<d", float("inf")), "a coordinate is not finite"),
    ("stl", "solid a\nhello\n", "'hello' is not known"),
    ("stl", "solid a\nfacet normal 0 0 1\nouter loop\nvortex 0 0 0\n", "vertex expected, found 'vortex'"),
    ("stl", bytes(80) + struct.pack("<I12fH", 1, *[float("nan")] * 12, 0), "a coordinate is not finite"),
    ("dat", "\1\2\3", "the format of this file is not known; its extension should tell"),
    ("png", "\1\2\3", "format png can be written, not read"),
    ("geo", "", "is a script, not a mesh: meshgen -2 makes a mesh of it"),
]
for number, (ext, contents, text) in enumerate(FILES):
    path = f"f{number}.{ext}"
    with open(path, "wb") as f:
        f.write(contents if isinstance(contents, bytes) else contents.encode())
    run(f".{ext}: {text}", ["check", path], 0 if "left out" in text else 1, text)

# ---- command lines ----------------------------------------------------------------------------------------------------------------------
SQUARE = ("h=.3; Point(1)={0,0,0,h}; Point(2)={1,0,0,h}; Point(3)={1,1,0,h}; Point(4)={0,1,0,h}; Line(1)={1,2}; Line(2)={2,3}; Line(3)={3,4};"
          "Line(4)={4,1}; Curve Loop(1)={1:4}; Plane Surface(1)={1};\n")
SQUARES = SQUARE + "Translate {1, 0, 0} { Duplicata { Surface{1}; } }\n"


def script(name, text):
    with open(name, "w") as f:
        f.write(text)


script("square.geo", SQUARE)
script("a.geo", SQUARE)
script("empty.geo", "// nothing\n")
subprocess.run([meshgen, "-2", "square.geo", "-v", "1", "-no_report", "-o", "square.msh"], check=True)
for folder in ("d", "e", "out"):
    os.makedirs(folder, exist_ok=True)
script("d/a.geo", SQUARE)
script("points.xyz", "0 0\n1 0\n0 1\n1 0\n")
script("none.xyz", "# nothing\n")
script("huge.xyz", "0 0\n1e308 0\n0 1e308\n-1e308 -1e308\n")
COMMANDS = [
    (2, "-o needs an argument; see meshgen -help", ["-o"]),
    (2, "-setlist a: the number of values must follow the name", ["-setlist", "a", "99", "1"]),
    (2, "-clscale needs a number, not 'x'", ["-clscale", "x"]),
    (2, "unknown 2D algorithm 'x'; it is one of", ["-algo", "x"]),
    (2, "-color takes auto, always or never, not 'x'", ["-color", "x"]),
    (2, "-color_by takes group, partition, gamma, angle, eta, jacobian or kappa1 to kappa5, not 'x'", ["-color_by", "x"]),
    (2, "-cell_data takes a list of gamma, angle, eta, jacobian and kappa1 to kappa5, not 'x'", ["-cell_data", "x"]),
    (2, "-width needs a whole number from 200 to 20000", ["-width", "3"]),
    (2, "-window needs two opposite corners x0,y0,x1,y1, not 'x'", ["-window", "x"]),
    (2, "-time_limit needs a positive number", ["-time_limit", "0"]),
    (2, "unknown switch '-clscal'; did you mean '-clscale'?", ["-clscal", "1"]),
    (2, "unknown option 'Mesh.Algoritm'; did you mean 'Mesh.Algorithm'?", ["-setnumber", "Mesh.Algoritm", "5"]),
    (2, "no completion for 'tcsh'; there is one for bash, zsh and fish", ["-completion", "tcsh"]),
    (2, "All switches: meshgen -help", []),
    (2, "no input file; see meshgen -help", ["-2"]),
    (2, "-delaunay takes one file of points", ["-delaunay", "points.xyz", "none.xyz"]),
    (1, "none.xyz:1: the file ends without a point", ["-delaunay", "none.xyz"]),
    (0, "points.xyz: 1 points are equal to earlier ones and were left out", ["-delaunay", "points.xyz", "-o", "p.vtk"]),
    (1, "huge.xyz: the coordinates are too large for Voronoi cells", ["-delaunay", "-voronoi", "huge.xyz", "-o", "p.vtk"]),
    (2, "-o needs a file name, not an empty word", ["square.geo", "-o", ""]),
    (2, "-o x.vtk is said twice", ["square.geo", "-o", "x.vtk", "-o", "x.vtk"]),
    (2, "with several inputs -o must name an existing folder, not 'x.msh'", ["square.geo", "a.geo", "-o", "x.msh"]),
    (2, "'a.geo' and 'd/a.geo' would be written to the same file", ["a.geo", "d/a.geo", "-o", "out"]),
    (2, "x.foo: the extension names no known format; name one with -format", ["square.geo", "-o", "x.foo"]),
    (2, "unknown format 'foobar'; meshgen -list_formats prints those there are", ["square.geo", "-format", "foobar"]),
    (2, "square.msh would be replaced by its own conversion; say -o square.msh if you mean it", ["square.msh", "-format", "msh"]),
    (2, "square.msh is a mesh: say where to write it (-o file) or use meshgen check", ["square.msh"]),
    (2, "x: format triangle is several files and needs a name for them", ["square.msh", "-format", "triangle", "-o", "/dev/null"]),
    (0, "format stl has no room for the measures of elements (-cell_data)", ["square.msh", "-cell_data", "gamma", "-o", "x.stl"]),
    (1, "the script makes no mesh (as Mesh 2; does)", ["-save", "square.geo"]),
    (1, "elements to be divided: too few for 1000 parts", ["square.geo", "-part", "1000"]),
    (1, "METIS has communication as the objective (Mesh.MetisObjective = 2) in its k-way algorithm only",
     ["square.geo", "-part", "2", "-setnumber", "Mesh.MetisObjective", "2", "-setnumber", "Mesh.MetisAlgorithm", "1"]),
    (1, "-3 is out of range for Mesh.NbPartitions: 0 to 1e+06", ["square.geo", "-part", "-3"]),
    (2, "-part_weight takes line, tri or quad and a number, not 'triangle'", ["square.geo", "-part_weight", "triangle", "1"]),
    (0, "x: format su2 has no room for the parts", ["square.geo", "-part", "2", "-o", "x.su2"]),
    (0, "files of single parts get no measures of elements (-cell_data)",
     ["square.geo", "-part", "2", "-part_split", "-cell_data", "gamma", "-o", "x.msh"]),
    (2, "one file per part (-part_split) needs a name for them, not standard output",
     ["square.geo", "-part", "2", "-part_split", "-o", "-"]),
    (0, "empty.geo: there is nothing to mesh: the mesh is empty", ["empty.geo", "-o", "x.msh"]),
    (2, "-explain_size needs two numbers: x,y", ["square.geo", "-explain_size", "x"]),
    (0, "volumes are not meshed: meshing points, curves and surfaces only", ["-3", "square.geo", "-v", "4", "-o", "x.msh"]),
    (2, 'not a condition such as "min_gamma>0.3" on a figure of the report', ["square.geo", "-require", "x", "-o", "x.msh"]),
    (1, "does not hold: this mesh has no such figure", ["-1", "square.geo", "-require", "min_gamma>0.3", "-o", "x.msh"]),
    (1, "does not hold: min_gamma is", ["square.geo", "-require", "min_gamma>1", "-o", "x.msh"]),
    (2, "usage: meshgen diff a.msh b.msh [-tol t] [-json] [-o picture]", ["diff", "square.msh"]),
    (2, "usage: meshgen check [-json] file.msh ...", ["check"]),
    (2, "usage: meshgen hash [-parts] file.msh ...", ["hash", "-x", "square.msh"]),
    (2, "unknown subcommand 'chek'; did you mean 'meshgen check'?", ["chek", "square.msh"]),
    (2, "'x.msh': differences are painted as .png, .svg or .pdf", ["diff", "square.msh", "square.msh", "-o", "x.msh"]),
]
for status, text, words in COMMANDS:
    run("meshgen " + " ".join(words) + ": " + text.split(";")[0], words, status, text.replace("x: format", "format"))

# ---- scripts --------------------------------------------------------------------------------------------------------------------------
RINGS = ("Point(1)={0,0,0,9}; Point(2)={1,0,0,9}; Point(3)={-1,0,0,9}; Point(4)={.95,0,0,.1}; Point(5)={-.95,0,0,.1}; Circle(1)={2,1,3};"
         "Circle(2)={3,1,2}; Circle(3)={4,1,5}; Circle(4)={5,1,4}; Curve Loop(1)={1,2}; Curve Loop(2)={3,4}; Plane Surface(1)={1,2};"
         "Transfinite Curve{1,2}=3; Mesh.MinimumCircleNodes=4;")
STAR = ("For i In {0:8} a=2*Pi*4*i/9; Point(i+1)={Cos(a),Sin(a),0,9}; EndFor\nFor i In {1:8} Line(i)={i,i+1}; EndFor\nLine(9)={9,1};"
        "Curve Loop(1)={1:9}; Plane Surface(1)={1};")
EMBEDDED = SQUARE + "Point(9)={.2,.5,0,h}; Point(10)={.8,.5,0,h}; Line(9)={9,10}; Curve{9} In Surface{1};\n"
SCRIPTS = [
    (0, "there is no mesh yet, so nothing is done: say Mesh 2; before", SQUARE + "RefineMesh;", []),
    (1, "SetOrder: the order must be 1 to", SQUARE + "Mesh 2; SetOrder 99;", []),
    (1, "PartitionMesh: the number of parts must be 0 or more, not -2", SQUARE + "Mesh 2; PartitionMesh -2;", []),
    (0, "there is no mesh yet, so nothing is done: say Mesh 2; before", SQUARE + "PartitionMesh 2;", []),
    (0, "Save: there is no mesh yet, so nothing is written: say Mesh 2; before", SQUARE + 'Save "y.msh";', []),
    (0, "the command failed: false", SQUARE + 'SystemCall "false";', ["-allow_system"]),
    (0, "order 2: 4 curved edges, 0 elements unfolded", "Point(1)={0,0,0,9}; Point(2)={1,0,0,9}; Point(3)={0,1,0,9}; Point(4)={-1,0,0,9};"
     "Point(5)={0,-1,0,9}; Circle(1)={2,1,3}; Circle(2)={3,1,4}; Circle(3)={4,1,5}; Circle(4)={5,1,2}; Curve Loop(1)={1:4};"
     "Plane Surface(1)={1}; Mesh.MinimumCircleNodes=4; Mesh.MinimumCurveNodes=2;", ["-order", "2", "-v", "4"]),
    (0, "surface elements are dropped on saving: there are physical groups, but no Physical Surface (-save_all saves everything)",
     SQUARE + "Physical Curve(1)={1};", []),
    (0, "surface elements are dropped on saving: face 5 is in no Physical Surface (-save_all saves everything)",
     SQUARES + "Physical Surface(1)={1};", []),
    (0, "algorithm 7 (BAMG) is not available; Frontal-Delaunay is used", SQUARE, ["-algo", "7"]),
    (0, "algorithm 11 (quasi-structured) is not available; Frontal-Delaunay for quads is used", SQUARE, ["-algo", "11"]),
    (0, "embedded point at (5, 5, 0) is outside surface 1: it is left out", SQUARE + "Point(9)={5,5,0,h}; Point{9} In Surface{1};", []),
    (1, "curve 9 is outside surface 1 near", SQUARE + "Point(9)={5,5,0,h}; Point(10)={6,5,0,h}; Line(9)={9,10}; Curve{9} In Surface{1};", []),
    (0, "curves meet: 2 cuts made in them, round 1", SQUARE + "Point(9)={.2,.5,0,h}; Point(10)={.8,.5,0,h}; Point(11)={.5,.2,0,h};"
     "Point(12)={.5,.8,0,h}; Line(9)={9,10}; Line(10)={11,12}; Curve{9,10} In Surface{1};", ["-heal", "-v", "4"]),
    (0, "curve 9, embedded in surface 1, lies outside it and is left out of it",
     SQUARE + "Point(9)={5,5,0,h}; Point(10)={6,5,0,h}; Line(9)={9,10}; Curve{9} In Surface{1};", ["-heal"]),
    (0, "point 9, embedded in surface 1, lies outside it and is left out", SQUARE + "Point(9)={5,5,0,h}; Point{9} In Surface{1};", ["-heal"]),
    (0, "corner 9 of transfinite surface 1 is not on its boundary; the surface is meshed freely",
     SQUARE + "Point(9)={5,5,0,h}; Transfinite Surface{1}={1,2,3,9};", []),
    (0, "no 3 or 4 corners were named", SQUARE.replace("Line(4)={4,1}; Curve Loop(1)={1:4}", "Point(5)={-.3,.5,0,h}; Line(4)={4,5}; Line(5)={5,1};"
     "Curve Loop(1)={1:5}") + "Transfinite Surface{1};", []),
    (0, "surface 1 cannot be transfinite: its opposite sides have", SQUARE + "Transfinite Curve{1}=9; Transfinite Curve{3}=4; Transfinite Surface{1};", []),
    (0, "surface 1 cannot be transfinite: its three sides have", "h=1; Point(1)={0,0,0,h}; Point(2)={1,0,0,h}; Point(3)={0,1,0,h}; Line(1)={1,2};"
     "Line(2)={2,3}; Line(3)={3,1}; Curve Loop(1)={1:3}; Plane Surface(1)={1}; Transfinite Curve{1}=3; Transfinite Curve{2}=5;"
     "Transfinite Curve{3}=8; Transfinite Surface{1};", []),
    (1, "is not the image of its periodic master", SQUARE + "Periodic Curve{3}={1} Translate{0,2,0};", []),
    (1, "the first height at point 1 is -1; it must be positive", SQUARE + "Field[1]=BoundaryLayer; Field[1].CurvesList={1};"
     "Field[1].PointsList={1,2}; Field[1].SizesList={1,-1}; Field[1].Size=.01; BoundaryLayer Field=1;", []),
    (1, "SizesList has 3 numbers; it lists pairs of a point and a height", SQUARE + "Field[1]=BoundaryLayer; Field[1].CurvesList={1};"
     "Field[1].SizesList={1,.1,2}; Field[1].Size=.01; BoundaryLayer Field=1;", []),
    (1, "BoundaryLayer Field: field 7", SQUARE + "BoundaryLayer Field=7;", []),
    (0, "makes no layer: its first height", SQUARE + "Field[1]=BoundaryLayer; Field[1].CurvesList={1}; Field[1].Size=.1;"
     "Field[1].Thickness=.01; BoundaryLayer Field=1;", []),
    (1, "Beta must be above 1 and NbLayers between 1 and", SQUARE + "Field[1]=BoundaryLayer; Field[1].CurvesList={1}; Field[1].BetaLaw=1;"
     "Field[1].Beta=.5; Field[1].Size=.01; BoundaryLayer Field=1;", []),
    (0, "cannot be meshed in the layers of its extrusion", "Point(1)={0,0,0,.3}; Point(2)={1,0,0,.3}; Line(1)={1,2};"
     "out[]=Extrude{0,1,0}{Curve{1}; Layers{3};}; Point(9)={.4,.45,0,.3}; Point{9} In Surface{out[1]};", []),
    (1, "more than 20 triangles (Mesh.MaxElements, -max_elements)", "h=9; Point(1)={0,0,0,h}; Point(2)={1,0,0,h}; Point(3)={1,1,0,h}; Point(4)={0,1,0,h};"
     "Point(5)={-1e-5,.5,0,h}; Point(6)={-1e-5,.50001,0,h}; Line(1)={1,2}; Line(2)={2,3}; Line(3)={3,4}; Line(4)={4,6}; Line(5)={6,5};"
     "Line(6)={5,1}; Curve Loop(1)={1:6}; Plane Surface(1)={1};", ["-min_angle", "30", "-max_elements", "20"]),
    (1, "surface 1 would have more than", SQUARE + "Transfinite Curve{1}=120;", ["-max_elements", "130", "-clscale", "30"]),
    (0, "triangles have an angle below 25 degrees, at input angles under 60 degrees", "h=1; Point(1)={0,0,0,h}; Point(2)={1,0,0,h};"
     "Point(3)={1,.1,0,h}; Line(1)={1,2}; Line(2)={2,3}; Line(3)={3,1}; Curve Loop(1)={1:3}; Plane Surface(1)={1};", ["-min_angle", "25", "-v", "4"]),
    (0, "curves 1 and 3 meet at (0, 0, 0) at 5.711 degrees: triangles there have angles below 25", "h=1; Point(1)={0,0,0,h}; Point(2)={1,0,0,h};"
     "Point(3)={1,.1,0,h}; Line(1)={1,2}; Line(2)={2,3}; Line(3)={3,1}; Curve Loop(1)={1:3}; Plane Surface(1)={1};", ["-min_angle", "25", "-json"]),
    (0, "where boundary edges may not be split any more, the first at", "h=1; Point(1)={0,0,0,h}; Point(2)={1,0,0,h}; Point(3)={1,.01,0,h};"
     "Point(4)={0,.01,0,h}; Line(1)={1,2}; Line(2)={2,3}; Line(3)={3,4}; Line(4)={4,1}; Curve Loop(1)={1:4}; Plane Surface(1)={1};"
     "Transfinite Curve{1,3}=2;", ["-min_angle", "25"]),
    (1, "1 node that coincides with others, the first at (0, 0, 0): of point 1 and of point 9", SQUARE + "Point(9)={0,0,0,h}; Point{9} In Surface{1};", []),
    (1, "passes through a node that is not its own at (0.1, 0, 0)", SQUARE + "Point(9)={.1,0,0,h}; Point{9} In Surface{1};"
     "Transfinite Curve{1}=5;", []),
    (0, "nothing is left of surface 1, others lie on all of it: it goes", SQUARE + "Point(11)={-1,-1,0,h}; Point(12)={2,-1,0,h}; Point(13)={2,2,0,h};"
     "Point(14)={-1,2,0,h}; Line(11)={11,12}; Line(12)={12,13}; Line(13)={13,14}; Line(14)={14,11}; Curve Loop(2)={11:14}; Plane Surface(2)={2};"
     "Point(21)={.5,-2,0,h}; Point(22)={.5,3,0,h}; Line(21)={21,22};", ["-heal", "-v", "4"]),
    (0, "surfaces bounded anew", SQUARE + "Point(11)={.5,0.5,0,h}; Point(12)={1.5,.5,0,h}; Point(13)={1.5,1.5,0,h}; Point(14)={.5,1.5,0,h};"
     "Line(11)={11,12}; Line(12)={12,13}; Line(13)={13,14}; Line(14)={14,11}; Curve Loop(2)={11:14}; Plane Surface(2)={2};", ["-heal", "-v", "4"]),
    (0, "had to be halved nearer to straight lines than their curves", "Point(1)={0,0,0,1}; Point(2)={1,0,0,1}; Point(3)={0,1,0,1}; Point(4)={-1,0,0,1};"
     "Point(5)={0,-1,0,1}; Circle(1)={2,1,3}; Circle(2)={3,1,4}; Circle(3)={4,1,5}; Circle(4)={5,1,2}; Point(11)={-3,-3,0,1}; Point(12)={3,-3,0,1};"
     "Point(13)={0,4,0,1}; Line(11)={11,12}; Line(12)={12,13}; Line(13)={13,11}; Curve Loop(1)={1:4}; Curve Loop(2)={11:13}; Plane Surface(1)={2,1};"
     "Field[1]=BoundaryLayer; Field[1].CurvesList={1:4}; Field[1].Size=.01; Field[1].Thickness=.03; BoundaryLayer Field=1; Mesh 2; RefineMesh;", []),
    (0, "had to be drawn nearer to straight lines than their curves", "Point(1)={0,0,0,9}; Point(2)={1,0,0,9}; Point(3)={0,1,0,9}; Point(4)={-1,0,0,9};"
     "Point(5)={0,-1,0,9}; Circle(1)={2,1,3}; Circle(2)={3,1,4}; Circle(3)={4,1,5}; Circle(4)={5,1,2}; Curve Loop(1)={1:4};"
     "Point(11)={-2,-2,0,9}; Point(12)={2,-2,0,9}; Point(13)={2,2,0,9}; Point(14)={-2,2,0,9}; Line(11)={11,12}; Line(12)={12,13}; Line(13)={13,14};"
     "Line(14)={14,11}; Curve Loop(2)={11:14}; Plane Surface(1)={2,1}; Transfinite Curve{1:4}=2; Point(20)={.7072,.7072,0,9}; Point{20} In Surface{1};", ["-order", "2"]),
    (1, "met while meshing curve 1", SQUARE + 'Field[1]=MathEval; Field[1].F="sqrt(x-2)"; Background Field=1;', []),
    (0, "Periodic Curve: there is no curve 77", SQUARE + "Periodic Curve{3}={77};", []),
    (1, "the curves would get", SQUARE, ["-clmax", "1e-9"]),
    (1, "itself at", "Point(1)={0,0,0,.3}; Point(2)={1,1,0,.3}; Point(3)={1,0,0,.3}; Point(4)={0,1,0,.3}; Spline(1)={1,2,3,4,1}; Curve Loop(1)={1};"
     "Plane Surface(1)={1};", []),
    (1, "and 17 more crossings", STAR, []), (1, "crosses curve 1 at", STAR, []),
    (1, "still cross after 0 rounds of halving (Mesh.MaxRetries)", RINGS, ["-setnumber", "Mesh.MaxRetries", "0"]),
    (0, "of them halved in 2 rounds, none crosses now", RINGS, ["-v", "4"]),
    (0, "the prescribed counts around it add up to an odd number", SQUARE + "Transfinite Curve{1}=4; Transfinite Curve{2:4}=3;"
     "Mesh.RecombineAll=1;", []),
    (1, "fixed by Field[1] (Box, line 2)", SQUARE + "Field[1]=Box; Field[1].VIn=1e-5; Field[1].VOut=.1; Field[1].XMin=.3; Field[1].XMax=.7;"
     "Field[1].YMin=.3; Field[1].YMax=.7; Background Field=1;", ["-max_elements", "1e8"]),
    (1, "sizes come from its boundary, where curve 1 has", SQUARE, ["-clscale", "1e-2", "-max_elements", "1e5"]),
    (1, "by the numbers of edges on its curves", SQUARE + "Transfinite Curve{1:4}=20001; Transfinite Surface{1};", ["-max_elements", "1e8"]),
    (0, "surface 2 cannot be transfinite (it has holes)", SQUARE + "Point(11)={.4,.4,0,h}; Point(12)={.6,.4,0,h}; Point(13)={.6,.6,0,h}; Line(11)={11,12};"
     "Line(12)={12,13}; Line(13)={13,11}; Curve Loop(2)={11:13}; Plane Surface(2)={1,2}; Delete{Surface{1};} Transfinite Surface{2};", []),
    (0, "keeps its boundary edges:", SQUARE + "Transfinite Curve{1,3}=20; Transfinite Curve{2,4}=2; Transfinite Surface{1};", ["-min_angle", "25"]),
    (0, "stays in triangles: a smallest angle is promised for triangles only", SQUARE + "Recombine Surface{1};", ["-min_angle", "25"]),
]
for number, (status, text, geo, words) in enumerate(SCRIPTS):
    script("s.geo", geo)
    run(f"script: {text}", ["-2", "s.geo", "-no_report", "-o", "s.msh", *words], status, text)

# ---- audits ---------------------------------------------------------------------------------------------------------------------------
def two_curves_with_one_line(m):
    m.line.append([1, 2, 7])


def line_from_a_node_to_itself(m):
    m.line.append([7, 7, 7])


def boundary_on_a_wrong_curve(m):
    m.line[0][2] = 3


AUDITS = [
    (broken_meshes.duplicate_node, "nodes 7 and 16 have the same coordinates"), (broken_meshes.orphan_node, "node 16 is in no element"),
    (broken_meshes.inverted_element, "it turns the other way than its face"), (broken_meshes.node_twice, "three corners are collinear"),
    (broken_meshes.third_element_on_an_edge, "has more than two elements, or two that run it the same way"),
    (broken_meshes.element_twice, "has the same corners"), (broken_meshes.hole, "nothing is beyond the edge of nodes"),
    (broken_meshes.lost_edge, "not of"), (broken_meshes.t_junction, "node 16 lies within the edge of nodes"), (broken_meshes.group_without_elements, "has no elements"),
    (broken_meshes.two_groups_of_one_name, "are both named 'left'"), (two_curves_with_one_line, "curve 1 has a line between nodes 1 and 2 too"),
    (line_from_a_node_to_itself, "both ends are node 7"), (boundary_on_a_wrong_curve, "it ends at curve 3, which does not bound it")]
for damage, text in AUDITS:
    m = broken_meshes.Mesh()
    damage(m)
    script("audit.msh", broken_meshes.msh4(m))
    run(f"audit: {text}", ["check", "audit.msh"], 0 if damage.__name__ in ("orphan_node", "group_without_elements", "two_groups_of_one_name") else 1, text)
lost = broken_meshes.Mesh()
broken_meshes.lost_edge(lost)
QUAD = M2 + "$Nodes\n4\n1 0 0 {0}\n2 1 0 0\n3 {1} 0\n4 0 1 0\n$EndNodes\n$Elements\n1\n1 3 2 1 1 1 2 3 4\n$EndElements\n"
for text, contents in [
        ("the quadrangle is not convex", QUAD.format(0, ".1 .1")), ("it is no edge of a surface element: nodes 1 and 3", broken_meshes.msh2(lost)),
        ("its area is 0", M2 + "$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 1 1 1\n5 0 2 0\n6 0 3 0\n$EndNodes\n$Elements\n3\n1 2 2 1 1 1 2 3\n2 2 2 1 1 2 4 3\n"
         "3 2 2 1 1 3 5 6\n$EndElements\n"),
        ("a link from 9 to 8, of which one does not exist", M2 + N2 + "$Elements\n1\n1 2 2 1 1 1 2 3\n$EndElements\n$Periodic\n1\n1 8 9\n0\n$EndPeriodic\n"),
        ("away from the image of node 2", M2 + N2 + "$Elements\n2\n1 15 2 0 1 1\n2 15 2 0 2 2\n$EndElements\n"
         "$Periodic\n1\n0 1 2\nAffine 1 0 0 5 0 1 0 0 0 0 1 0 0 0 0 1\n1\n1 2\n$EndPeriodic\n")]:
    script("audit.msh", contents)
    run(f"audit: {text}", ["check", "audit.msh"], 0 if contents == broken_meshes.msh2(lost) else 1, text)

# ---- all messages of the sources --------------------------------------------------------------------------------------------------------
# What no input provokes. Tests of the library make some of it, tests/unit: meshes that neither readers nor the mesher make. The rest
# is said before by another message, or guards against what has not been seen.
UNREACHED = [
    "too many nodes", "format %s can be read, not written", "no format has this extension", "unknown mesh format '%s'",
    # unit tests of the audit
    "block %u is on entity", "elements of type %d (%s)", "blocks are not in order", "an entity of dimension", "entities are not in order",
    "node %llu is on no entity", "METIS cannot partition this mesh", "node number %u of", "a group of dimension %d with tag", "a pair of nodes %u", "it is in group %d, which",
    "its elements have %zu boundary cycles", "V - E + F", "its elements add up to", "node %llu is on %s",
    # guards
    "the indices of the vertices add up",
    "curve %d is defined here", "a node whose coordinates are not finite", "surface %d has no area", "surface %d has too many nodes",
    "curve %d copies the mesh of curve %d", "go on splitting them for each other",
    "its nodes come in another order", "has no room for its boundary layers", "no pairs are written", "(its corner, point %d, is not on",
]
CALL = re.compile(r"\b(?:diag_error|diag_warning|diag_note|usage_error|scan_error|check__report|log_info)\s*\(")
CONVERSION = re.compile(r"%%|%[-0-9.*]*(?:ll|z|l)?[a-zA-Z]|%|\\n")


def messages(path):
    with open(path) as f:
        source = f.read()
    for call in CALL.finditer(source):
        depth, i, strings = 1, call.end(), []
        while depth and i < len(source):
            if source[i] == '"':
                end = i + 1
                while source[end] != '"':
                    end += 2 if source[end] == "\\" else 1
                glued = strings and source[strings[-1][1]:i].strip() == ""
                strings.append((i + 1, end + 1, (strings.pop()[2] if glued else "") + source[i + 1:end]))
                i = end
            depth += {"(": 1, ")": -1}.get(source[i], 0)
            i += 1
        if strings:
            yield source.count("\n", 0, call.start()) + 1, strings[0][2]


said = ""
for folder, _, names in os.walk(os.path.join(root, "tests")):
    for name in names:
        if name.endswith((".py", ".sh", ".c", ".cc", ".geo", ".h")):
            with open(os.path.join(folder, name), errors="replace") as f:
                said += f.read()
said = re.sub(r'"\s*\n\s*"', "", said)
for folder in ("cli", "out", "mesh"):
    for path in sorted(glob.glob(os.path.join(root, "src", folder, "*.c"))):
        missing = []
        for line, text in messages(path):
            pieces = [p.replace('\\"', '"') for p in CONVERSION.split(text)]
            spoken = re.search(".*?".join(re.escape(p) for p in pieces), heard) and max(map(len, pieces)) > 3
            if not spoken and max(pieces, key=len).strip(" '\":,;()") not in said and not any(u in text for u in UNREACHED):
                missing.append(f"line {line}: {text}")
        say(f"the messages of {os.path.relpath(path, root)} are said by tests", not missing, "\n".join(missing))
