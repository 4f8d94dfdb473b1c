"""Solve -div grad u = 1 with u = 0 on the facets of one label in DOLFIN: dolfin_poisson.py NAME LABEL, on NAME.xml and
NAME_facet_region.xml of dolfin-convert. Prints RESULT, the integral of u, nodes, area."""
import sys

from dolfin import (Constant, DirichletBC, Function, FunctionSpace, LogLevel, Mesh, MeshFunction, TestFunction, TrialFunction,
                    assemble, dx, grad, inner, set_log_level, solve)

set_log_level(LogLevel.ERROR)
mesh = Mesh(sys.argv[1] + ".xml")
facets = MeshFunction("size_t", mesh, sys.argv[1] + "_facet_region.xml")
space = FunctionSpace(mesh, "P", 1)
u, v, w = TrialFunction(space), TestFunction(space), Function(space)
solve(inner(grad(u), grad(v)) * dx == v * dx, w, DirichletBC(space, Constant(0), facets, int(sys.argv[2])))
print("RESULT %.10g %d %.10g" % (assemble(w * dx), mesh.num_vertices(), assemble(Constant(1) * dx(domain=mesh))))
