// mesh_assemble.c - points, curve meshes and face meshes put together into one Mesh
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "base/map.h"
#include "mesh/mesh2d.h"
#include "model/model_edit.h"

static void set_box(MeshEntity *e, Box3 b)
{
  e->lo = b.lo;
  e->hi = b.hi;
}

static Box3 box_union(Box3 a, Vec3 lo, Vec3 hi) { return box3_with(box3_with(a, lo), hi); }

// A curve that bounds the face too, as Coherence may make of an embedded one, is no more than that.
static void add_embedded(MeshEntity *e, const Face *f)
{
  if (!f->embedded_curves.len) return;
  Map bounds = {0};
  for (size_t i = 0; i < e->boundary.len; i++) map_set(&bounds, (uint64_t)abs(e->boundary.data[i]), 1);
  for (size_t i = 0; i < f->embedded_curves.len; i++)
    if (map_get(&bounds, (uint64_t)abs(f->embedded_curves.data[i])) == NONE) vec_push(&e->embedded, f->embedded_curves.data[i]);
  map_free(&bounds);
}

static void add_entities(Mesh *mesh, const Model *m)
{
  for (size_t k = 0; k < model_points(m); k++) {
    const Point *p = model_point_at(m, k);
    uint32_t e = mesh_add_entity(mesh, 0, p->tag);
    set_box(&mesh->entity[e], box3_with(box3_empty(), p->xyz));
  }
  for (size_t k = 0; k < model_curves(m); k++) {
    const Curve *c = model_curve_at(m, k);
    uint32_t id = mesh_add_entity(mesh, 1, c->tag);
    MeshEntity *e = &mesh->entity[id];
    set_box(e, curve_bounds(m, c));
    vec_push(&e->boundary, c->begin);
    vec_push(&e->boundary, -c->end);
  }
  for (size_t k = 0; k < model_faces(m); k++) {
    const Face *f = model_face_at(m, k);
    uint32_t id = mesh_add_entity(mesh, 2, f->tag);
    IntVec curve = {0}, start = {0};
    if (f->united && f->united == f->tag) face_boundary_united(m, f, &curve);
    else face_boundary(m, f, &curve, &start);
    Box3 box = box3_empty();
    for (size_t i = 0; i < curve.len; i++) {
      uint32_t c = mesh_find_entity(mesh, 1, abs(curve.data[i]));
      if (c != NONE) box = box_union(box, mesh->entity[c].lo, mesh->entity[c].hi);
    }
    MeshEntity *e = &mesh->entity[id];
    set_box(e, box);
    e->boundary = curve;
    add_embedded(e, f);
    for (size_t i = 0; f->united == f->tag && f->united && i < model_faces(m); i++)
      if (i != k && model_face_at(m, i)->united == f->tag) add_embedded(e, model_face_at(m, i));
    vec_free(&start);
  }
}

static void add_groups(Mesh *mesh, const Model *m, bool oriented)
{
  for (size_t k = 0; k < model_groups(m); k++) {
    const Group *g = model_group_at(m, k);
    mesh_add_group(mesh, g->dim, g->tag, g->name);
    for (size_t i = 0; g->dim == 3 && i < g->entity.len; i++)
      mesh->volumes_grouped |= model_has(m, 3, abs(g->entity.data[i]));
    if (g->dim == 3) continue;
    for (size_t i = 0; i < g->entity.len; i++) {
      int tag = g->entity.data[i];
      uint32_t e = mesh_find_entity(mesh, g->dim, abs(tag));
      if (e != NONE) vec_push(&mesh->entity[e].physical, tag < 0 && oriented ? -g->tag : g->tag);
    }
  }
}

static void add_points(Mesh *mesh, const Model *m)
{
  for (size_t k = 0; k < model_points(m); k++) {
    mesh_add_node(mesh, model_point_at(m, k)->xyz, (uint32_t)k, NAN);
    uint32_t b = mesh_add_block(mesh, (uint32_t)k, ELEM_POINT, 1);
    mesh->block[b].node[0] = (uint32_t)k;
  }
}

static void add_curves(Mesh *mesh, const Model *m, const Mesh1d *curves, const EdgeNodes *en)
{
  size_t np = model_points(m);
  for (size_t k = 0; k < model_curves(m); k++) {
    const CurveMesh *cm = &curves->curve[k];
    uint32_t entity = (uint32_t)(np + k);
    for (size_t i = 1; i + 1 < cm->n; i++) mesh_add_node(mesh, cm->p[i], entity, cm->u[i]);
    if (cm->n < 2) continue;
    uint32_t b = mesh_add_block(mesh, entity, ELEM_LINE2, cm->n - 1);
    uint32_t *node = mesh->block[b].node;
    bool reverse = model_curve_at(m, k)->reverse_mesh;
    for (size_t i = 0; i + 1 < cm->n; i++) {
      node[2 * i + reverse] = edge_nodes_at(en, m, curves, k, i);
      node[2 * i + 1 - reverse] = edge_nodes_at(en, m, curves, k, i + 1);
    }
  }
}

// Elements of a face, mirrored if it is to be seen from the other side. Their array becomes the mesh's.
static void take_elements(Mesh *mesh, uint32_t entity, ElemType type, uint32_t **from, size_t n, uint32_t edge_nodes, uint32_t first_own,
                          bool mirror)
{
  if (!n) return;
  uint32_t *v = *from, shift = first_own - edge_nodes;
  size_t k = (size_t)elem_nodes(type);
  *from = NULL;
  for (size_t i = 0; i < k * n; i++) v[i] += v[i] < edge_nodes ? 0 : shift;
  for (size_t i = 0; i < n && mirror; i++) {
    uint32_t second = v[k * i + 1];
    v[k * i + 1] = v[k * i + k - 1];
    v[k * i + k - 1] = second;
  }
  mesh_take_block(mesh, entity, type, n, v);
}

static void add_faces(Mesh *mesh, const Model *m, const EdgeNodes *en, FaceMesh *face, bool keep_orientation)
{
  size_t before = model_points(m) + model_curves(m);
  for (size_t k = 0; k < model_faces(m); k++) {
    const Face *f = model_face_at(m, k);
    FaceMesh *fm = &face[k];
    uint32_t entity = (uint32_t)(before + k), first = (uint32_t)mesh->nnode, base = (uint32_t)en->n;
    mesh_add_nodes(mesh, fm->own, fm->nown, entity);
    bool from_below = f->planar && f->normal.x == 0 && f->normal.y == 0 && f->normal.z < 0;
    bool mirror = (from_below && !keep_orientation) != f->reverse_mesh;
    take_elements(mesh, entity, ELEM_TRI3, &fm->tri, fm->ntri, base, first, mirror);
    take_elements(mesh, entity, ELEM_QUAD4, &fm->quad, fm->nquad, base, first, mirror);
  }
}

Mesh *mesh_assemble(const Model *m, const Mesh1d *curves, const EdgeNodes *en, FaceMesh *face, const Options *o)
{
  Mesh *mesh = mesh_new();
  add_entities(mesh, m);
  add_groups(mesh, m, o->Geometry_OrientedPhysicals);
  add_points(mesh, m);
  if (curves) add_curves(mesh, m, curves, en);
  if (curves && face) add_faces(mesh, m, en, face, o->Mesh_KeepOrientation);
  return mesh;
}

double *mesh_assemble_sizes(const Model *m, const Mesh1d *curves, const EdgeNodes *en, const FaceMesh *face)
{
  size_t n = en->n, at = en->n;
  for (size_t k = 0; k < model_faces(m); k++) n += face[k].nown;
  double *h = mem_alloc(n * sizeof *h);
  for (size_t i = 0; i < n; i++) h[i] = NAN;
  for (size_t k = 0; k < model_curves(m); k++)
    for (size_t i = 0; i < curves->curve[k].n; i++) {
      double *to = &h[edge_nodes_at(en, m, curves, k, i)], size = curves->curve[k].h[i];
      if (!(*to <= size)) *to = size; // the smallest at points
    }
  for (size_t k = 0; k < model_faces(m); k++) {
    if (face[k].size) memcpy(&h[at], face[k].size, face[k].nown * sizeof *h);
    at += face[k].nown;
  }
  return h;
}
