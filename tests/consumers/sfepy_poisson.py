"""Solve -div grad u = 1 with u = 0 on the line y = 0 in SfePy: sfepy_poisson.py MESH. Prints RESULT, the integral of u, nodes,
area."""
import sys

import numpy as np
from sfepy.base.base import output
from sfepy.discrete import Equation, Equations, FieldVariable, Integral, Material, Problem
from sfepy.discrete.conditions import Conditions, EssentialBC
from sfepy.discrete.fem import FEDomain, Field, Mesh
from sfepy.solvers.ls import ScipyDirect
from sfepy.solvers.nls import Newton
from sfepy.terms import Term

output.set_output(quiet=True)
mesh = Mesh.from_file(sys.argv[1], omit_facets=True)
domain = FEDomain("d", mesh)
omega = domain.create_region("Omega", "all")
foot = domain.create_region("Foot", "vertices in (y < 1e-9)", "vertex")
field = Field.from_args("f", np.float64, "scalar", omega, approx_order=1)
u, v = FieldVariable("u", "unknown", field), FieldVariable("v", "test", field, primary_var_name="u")
one, integral = Material("m", v=1.0), Integral("i", order=2)
lhs = Term.new("dw_laplace(v, u)", integral, omega, u=u, v=v)
rhs = Term.new("dw_volume_lvf(m.v, v)", integral, omega, m=one, v=v)
problem = Problem("p", equations=Equations([Equation("e", lhs - rhs)]))
problem.set_bcs(ebcs=Conditions([EssentialBC("zero", foot, {"u.0": 0.0})]))
problem.set_solver(Newton({}, lin_solver=ScipyDirect({})))
problem.solve()
print("RESULT %.10g %d %.10g" % (problem.evaluate("ev_integrate.2.Omega(u)"), mesh.n_nod, problem.evaluate("ev_volume.2.Omega(u)")))
