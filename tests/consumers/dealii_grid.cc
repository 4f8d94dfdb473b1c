// dealii_grid.cc - read meshes of meshgen with deal.II's GridIn and print what it has of each: RESULT name cells vertices area,
// then counts of material and of boundary numbers
// SPDX-License-Identifier: MIT
#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/tria.h>
#include <fstream>
#include <iostream>
#include <map>
using namespace dealii;
int main(int argc, char **argv)
{
  for (int i = 1; i < argc; i++) {
    Triangulation<2> t;
    GridIn<2> in(t);
    std::ifstream f(argv[i]);
    std::string name = argv[i];
    try {
      in.read_msh(f);
    } catch (std::exception &e) { std::cout << name << " FAILS " << e.what() << "\n"; continue; }
    double area = 0;
    std::map<unsigned, unsigned> bid, mid;
    for (const auto &c : t.active_cell_iterators()) {
      area += c->measure();
      mid[c->material_id()]++;
      for (unsigned k = 0; k < c->n_faces(); k++) if (c->face(k)->at_boundary()) bid[c->face(k)->boundary_id()]++;
    }
    std::cout.precision(12);
    std::cout << "RESULT " << name << " " << t.n_active_cells() << " " << t.n_used_vertices() << " " << area;
    for (auto &m : mid) std::cout << " material " << m.first << ":" << m.second;
    bid.erase(0); // of no group
    for (auto &m : bid) std::cout << " boundary " << m.first << ":" << m.second;
    std::cout << std::endl;
  }
}
