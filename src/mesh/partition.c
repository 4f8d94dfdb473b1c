// partition.c - a mesh divided in parts: METIS on the dual graph, then what it leaves undone
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/partition.h"

#include <metis.h>
#include <pthread.h>

#include "mesh/partition_int.h"

_Static_assert(sizeof(idx_t) == sizeof(uint32_t), "METIS is built with 32-bit indices");

static void unpartition(Mesh *m)
{
  for (size_t b = 0; b < m->nblock; b++) {
    free(m->block[b].part);
    m->block[b].part = NULL;
  }
  m->nparts = 0;
}

static int weight_of(ElemType t, const Options *o)
{
  int w = elem_dim(t) == 1       ? o->Mesh_PartitionLineWeight
          : elem_corners(t) == 3 ? o->Mesh_PartitionTriWeight
          : elem_corners(t) == 4 ? o->Mesh_PartitionQuadWeight
                                 : 1;
  return w < 0 ? 1 : w;
}

// Weights of the cells; NULL if all are equal. The caller frees.
static int32_t *weigh(const Mesh *m, const ElemIds *ids, const CellGraph *g, const Options *o)
{
  int32_t *w = mem_alloc(g->n * sizeof *w);
  bool equal = true;
  for (size_t c = 0; c < g->n; c++) {
    w[c] = weight_of(m->block[elem_ids_block(ids, m, g->elem[c])].type, o);
    equal = equal && w[c] == w[0];
  }
  if (!equal) return w;
  free(w);
  return NULL;
}

static bool is_connected(const CellGraph *g)
{
  uint32_t *component = mem_alloc(g->n * sizeof *component), n = cell_graph_components(g, NULL, component);
  free(component);
  return n == 1;
}

// K-way partitioning is faster and cuts less where there are many parts.
static bool is_kway(uint32_t parts, const Options *o)
{
  enum { FEW = 8 };
  if (o->Mesh_MetisAlgorithm == 0) return parts > FEW || o->Mesh_MetisObjective == 2;
  return o->Mesh_MetisAlgorithm == 2;
}

static void set_options(idx_t to[METIS_NOPTIONS], const CellGraph *g, bool kway, const Options *o)
{
  METIS_SetDefaultOptions(to);
  to[METIS_OPTION_NUMBERING] = 0;
  to[METIS_OPTION_SEED] = -1; // its own, which is fixed
  to[METIS_OPTION_CTYPE] = o->Mesh_MetisEdgeMatching == 1 ? METIS_CTYPE_RM : METIS_CTYPE_SHEM;
  to[METIS_OPTION_OBJTYPE] = o->Mesh_MetisObjective == 2 ? METIS_OBJTYPE_VOL : METIS_OBJTYPE_CUT;
  if (o->Mesh_MetisMaxLoadImbalance >= 0) to[METIS_OPTION_UFACTOR] = MAX(o->Mesh_MetisMaxLoadImbalance, 1);
  if (kway && o->Mesh_MetisMinConn >= 0) to[METIS_OPTION_MINCONN] = o->Mesh_MetisMinConn;
  if (kway) to[METIS_OPTION_CONTIG] = is_connected(g); // METIS stops at graphs that are not
}

// METIS draws from the C library's one generator, which it seeds, and takes over signal handlers: one call at
// a time.
static pthread_mutex_t metis_lock = PTHREAD_MUTEX_INITIALIZER;

static bool run_metis(Parts *p, const Options *o, Diag *d)
{
  const CellGraph *g = p->g;
  idx_t options[METIS_NOPTIONS], vertices = (idx_t)g->n, constraints = 1, parts = (idx_t)p->n, cut;
  bool kway = is_kway(p->n, o);
  set_options(options, g, kway, o);
  // METIS does not change its input, though it does not say so.
  idx_t *start = (idx_t *)g->start, *next = (idx_t *)g->next, *weight = (idx_t *)(uintptr_t)p->weight;
  pthread_mutex_lock(&metis_lock);
  int status = (kway ? METIS_PartGraphKway : METIS_PartGraphRecursive)(&vertices, &constraints, start, next,
                                                                       weight, NULL, NULL, &parts, NULL, NULL,
                                                                       options, &cut, (idx_t *)p->part);
  pthread_mutex_unlock(&metis_lock);
  if (status == METIS_OK) return true;
  diag_error(d, NO_LOC, "METIS cannot partition this mesh in %u parts%s", p->n,
             status == METIS_ERROR_MEMORY ? ": out of memory" : "");
  return false;
}

static bool divide(Parts *p, const Options *o, Diag *d)
{
  if (p->n == p->g->n) {
    for (uint32_t c = 0; c < p->n; c++) p->part[c] = c;
    return true;
  }
  if (!run_metis(p, o, d)) return false;
  parts__fill_empty(p);
  uint64_t total = 0, *weight = parts__weights(p);
  for (uint32_t k = 0; k < p->n; k++) total += weight[k];
  free(weight);
  double slack = o->Mesh_MetisMaxLoadImbalance >= 0 ? o->Mesh_MetisMaxLoadImbalance / 1000. : 0.03;
  parts__join_pieces(p, (1 + slack) * (double)total / p->n);
  return true;
}

static void store(Mesh *m, const ElemIds *ids, const Parts *p)
{
  unpartition(m);
  m->nparts = p->n;
  for (size_t b = 0; b < m->nblock; b++) {
    MeshBlock *k = &m->block[b];
    k->part = mem_alloc(k->n * sizeof *k->part);
    for (size_t i = 0; i < k->n; i++) k->part[i] = 1 + p->part[p->g->cell[ids->base[b] + i]];
  }
}

bool mesh_partition(Mesh *m, int n, const Options *o, Diag *d)
{
  if (n <= 1) {
    unpartition(m);
    return true;
  }
  if (o->Mesh_MetisObjective == 2 && o->Mesh_MetisAlgorithm == 1) {
    diag_error(
        d, NO_LOC,
        "METIS has communication as the objective (Mesh.MetisObjective = 2) in its k-way algorithm only: set "
        "Mesh.MetisAlgorithm = 2");
    return false;
  }
  ElemIds ids;
  CellGraph g;
  cell_graph_of_mesh(&g, &ids, m);
  bool good = (size_t)n <= g.n;
  if (!good) {
    diag_error(d, NO_LOC, "the mesh has %zu elements to be divided: too few for %d parts", g.n, n);
  } else {
    int32_t *weight = weigh(m, &ids, &g, o);
    Parts p = {&g, (uint32_t)n, mem_alloc(g.n * sizeof *p.part), weight};
    good = divide(&p, o, d);
    if (good) store(m, &ids, &p);
    free(p.part);
    free(weight);
  }
  cell_graph_free(&g);
  elem_ids_free(&ids);
  return good;
}

static bool is_complete(const Mesh *m, int least_dim)
{
  bool complete = true;
  for (size_t b = 0; b < m->nblock; b++)
    for (size_t i = 0; elem_dim(m->block[b].type) >= least_dim && i < m->block[b].n; i++)
      complete = complete && m->block[b].part[i];
  return complete;
}

static bool complete_by_cells(Mesh *m)
{
  ElemIds ids;
  CellGraph g;
  cell_graph_of_mesh(&g, &ids, m);
  bool good = true;
  for (size_t b = 0; b < m->nblock; b++)
    for (size_t i = 0; i < m->block[b].n; i++) {
      uint32_t *part = &m->block[b].part[i], cell = g.elem[g.cell[ids.base[b] + i]];
      if (*part) continue;
      uint32_t home = elem_ids_block(&ids, m, cell);
      *part = m->block[home].part[cell - ids.base[home]];
      good = good && *part;
    }
  cell_graph_free(&g);
  elem_ids_free(&ids);
  return good;
}

bool mesh_complete_parts(Mesh *m)
{
  if (is_complete(m, 0)) return true;
  if (is_complete(m, 2) && complete_by_cells(m)) return true;
  unpartition(m);
  return false;
}
