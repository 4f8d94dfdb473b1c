// job_mesh.c - the mesh of a job: made from its model, and changed afterwards
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "cli/job_mesh.h"

#include "mesh/boundary_layer.h"
#include "mesh/high_order.h"
#include "mesh/mesh2d.h"
#include "mesh/mesh2d_estimate.h"
#include "mesh/mesh2d_joint.h"
#include "mesh/partition.h"
#include "mesh/periodic.h"
#include "model/model_edit.h"

void job_mesh_drop(Job *j)
{
  mesh_free(j->mesh);
  j->mesh = NULL;
  free(j->node_size);
  j->node_size = NULL;
  mesh1d_free(j->curves);
  j->curves = NULL;
  j->mesh_dim = -1;
}

bool job_mesh_partition(Job *j, int n)
{
  stage_begin(&j->stats, "partition");
  bool good = mesh_partition(j->mesh, n, &j->options, j->diag);
  stage_end(&j->stats);
  return good;
}

// The mesh of the job becomes another one, in as many parts; sizes at its nodes are no longer known.
static void replace_mesh(Job *j, Mesh *mesh)
{
  uint32_t parts = j->mesh->nparts;
  mesh_free(j->mesh);
  j->mesh = mesh;
  free(j->node_size);
  j->node_size = NULL;
  if (parts && !mesh->nparts) job_mesh_partition(j, (int)parts);
}

// Curves must be there to place nodes on them.
static void make_curves_ready(Job *j)
{
  if (model_needs_prepare(j->model)) model_prepare(j->model, j->options.Geometry_Tolerance, j->diag);
}

void job_mesh_set_order(Job *j, int order)
{
  make_curves_ready(j);
  HighOrder how = {.order = order, .incomplete = j->options.Mesh_SecondOrderIncomplete, .linear = j->options.Mesh_SecondOrderLinear};
  HighOrderReport r;
  stage_begin(&j->stats, "high order");
  replace_mesh(j, mesh_set_order(j->mesh, &how, j->model, &r, j->diag));
  stage_end(&j->stats);
  if (order > 1)
    log_info(j->diag, "order %d: %zu curved edges, %zu elements unfolded, least Jacobian %.3g", order, r.curved, r.folded,
             r.min_jacobian);
}

static void subdivide(Job *j, Subdivision how)
{
  make_curves_ready(j);
  stage_begin(&j->stats, "subdivide");
  replace_mesh(j, mesh_subdivide(j->mesh, how, j->options.Mesh_SecondOrderLinear ? NULL : j->model, j->diag));
  stage_end(&j->stats);
}

// What follows the meshing of the faces: pairs of periodic nodes, subdivision, order.
static void finish_mesh(Job *j, int dim)
{
  if (dim >= 1) periodic_add(j->mesh, j->model, j->diag);
  if (dim >= 2 && j->options.Mesh_SubdivisionAlgorithm == 1) subdivide(j, SUBDIVIDE_QUADS);
  if (dim >= 2 && j->options.Mesh_SubdivisionAlgorithm == 3) subdivide(j, SUBDIVIDE_BARYCENTRIC);
  if (dim >= 1 && j->options.Mesh_ElementOrder > 1) job_mesh_set_order(j, j->options.Mesh_ElementOrder);
}

// The estimate before meshing knows nothing of what is refined for angles.
static bool few_enough(const Job *j, const FaceMesh *face, size_t n)
{
  double total = 0;
  for (size_t k = 0; k < n; k++) total += (double)(face[k].ntri + face[k].nquad);
  if (total <= j->options.Mesh_MaxElements || j->cli->keep_going) return true;
  diag_error(j->diag, NO_LOC, "the surfaces have %.0f elements, more than Mesh.MaxElements = %g (-max_elements)", total,
             j->options.Mesh_MaxElements);
  return false;
}

// With -keep_going faces grow until they meet the limit, each on its own.
static void mesh_faces(Job *j, const SizeField *size, EdgeNodes *en, const BoundaryLayers *layers)
{
  size_t n = model_faces(j->model);
  FaceMesh *face = mem_zalloc(n * sizeof *face);
  Mesh2dInput in = {.model = j->model, .options = &j->options, .size = size, .curves = j->curves, .layers = layers,
                    .diag = j->diag, .threads = j->threads};
  stage_begin(&j->stats, "estimate");
  bool affordable = j->cli->keep_going || mesh2d_is_affordable(&in);
  stage_end(&j->stats);
  if (!affordable) {
    free(face);
    return;
  }
  bool joint = j->options.Mesh_MinimumAngle > 0 || j->options.Mesh_ConformingDelaunay;
  stage_begin(&j->stats, "mesh 2D");
  j->failed_faces = joint ? mesh2d_joint_run(&in, j->curves, en, face) : mesh2d_run(&in, en, face);
  stage_end(&j->stats);
  for (size_t k = 0; k < n; k++) j->matching_seconds += face[k].matching_seconds;
  if ((!j->failed_faces || j->cli->keep_going) && few_enough(j, face, n)) {
    stage_begin(&j->stats, "assemble");
    j->mesh = mesh_assemble(j->model, j->curves, en, face, &j->options);
    j->node_size = mesh_assemble_sizes(j->model, j->curves, en, face);
    stage_end(&j->stats);
  }
  for (size_t k = 0; k < n; k++) face_mesh_free(&face[k]);
  free(face);
}

bool job_mesh_generate(Job *j, int dim)
{
  job_mesh_drop(j);
  j->reshaped = false;
  stage_begin(&j->stats, "model");
  if (j->options.Mesh_Heal) model_coherence(j->model, j->diag); // duplicates of points leave loops open otherwise
  bool good = model_prepare(j->model, j->options.Geometry_Tolerance, j->diag);
  stage_end(&j->stats);
  if (!good) return false;
  if (dim == 3) log_info(j->diag, "volumes are not meshed: meshing points, curves and surfaces only");
  SizeField *size;
  stage_begin(&j->stats, "mesh 1D");
  j->curves = mesh1d_heal(j->model, &j->options, j->fields, &size, j->diag);
  if (j->curves && dim >= 2) mesh1d_limit_faces(j->curves, size);
  stage_end(&j->stats);
  if (j->curves && j->curves->rounds)
    log_info(j->diag, "edges on curves crossed: %u of them halved in %u rounds, none crosses now", j->curves->nsplit, j->curves->rounds);
  if (j->curves) {
    EdgeNodes en;
    BoundaryLayers *layers = dim >= 2 ? boundary_layers_new(j->model, j->fields, &j->options, j->curves, j->diag) : NULL;
    edge_nodes_init(&en, j->model, j->curves);
    if (dim >= 2)
      mesh_faces(j, size, &en, layers);
    else
      j->mesh = mesh_assemble(j->model, dim >= 1 ? j->curves : NULL, &en, NULL, &j->options);
    edge_nodes_free(&en);
    boundary_layers_free(layers);
  }
  size_free(size);
  if (j->mesh) j->mesh_dim = MIN(dim, 2);
  if (j->mesh) finish_mesh(j, dim);
  return j->mesh != NULL;
}

void job_mesh_split(Job *j, Subdivision how)
{
  int order = 1;
  for (size_t i = 0; i < j->mesh->nblock; i++) order = MAX(order, elem_order(j->mesh->block[i].type));
  if (order > 1) job_mesh_set_order(j, 1);
  subdivide(j, how);
  if (order > 1) job_mesh_set_order(j, order);
}

bool job_mesh_recombine(Job *j)
{
  int all = j->options.Mesh_RecombineAll;
  j->options.Mesh_RecombineAll = 1;
  bool good = job_mesh_generate(j, j->mesh_dim);
  j->options.Mesh_RecombineAll = all;
  j->reshaped = true;
  return good;
}
