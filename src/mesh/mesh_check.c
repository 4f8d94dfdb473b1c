// mesh_check.c - the audit: indices, nodes, groups, classification, periodic links; the report
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/mesh_check.h"

#include <stdarg.h>

#include "mesh/mesh_check_int.h"

static const char *const rule_names[RULE_COUNT] = {
    "index", "coordinate", "orientation", "degenerate", "duplicate-node", "orphan-node", "duplicate-element", "edge",
    "t-junction", "hole", "lost-edge", "classification", "group", "euler", "index-sum", "area", "periodic",
};

const char *mesh_rule_name(MeshRule rule) { return rule_names[rule]; }

void mesh_report_free(MeshReport *r) { vec_free(&r->finding); }

void mesh_finding_print(const MeshFinding *f, char *to, size_t cap)
{
  static const char *const kind[] = {"point", "curve", "face"};
  char entity[40] = "", element[40] = "";
  if (f->tag) snprintf(entity, sizeof entity, ": %s %d", kind[f->dim], f->tag);
  if (f->element) snprintf(element, sizeof element, "%s element %llu", f->tag ? "," : ":", (unsigned long long)f->element);
  if (isnan(f->at.x))
    snprintf(to, cap, "%s%s%s: %s", rule_names[f->rule], entity, element, f->text);
  else
    snprintf(to, cap, "%s%s%s, at (%.9g, %.9g, %.9g): %s", rule_names[f->rule], entity, element, f->at.x, f->at.y, f->at.z,
             f->text);
}

void check__report(Check *c, MeshRule rule, bool warning, Place where, const char *fmt, ...)
{
  if (warning)
    c->r->warnings++;
  else
    c->r->errors++;
  if (c->r->count[rule]++ >= MESH_CHECK_MAX) return;
  MeshFinding f = {.rule = rule, .warning = warning, .node = where.node, .at = where.at};
  if (where.entity < c->m->nentity) {
    f.dim = c->m->entity[where.entity].dim;
    f.tag = c->m->entity[where.entity].tag;
  }
  if (where.block != NONE) f.element = c->number[where.block] + where.element + 1;
  va_list ap;
  va_start(ap, fmt);
  vsnprintf(f.text, sizeof f.text, fmt, ap);
  va_end(ap);
  vec_push(&c->r->finding, f);
}

static const Vec3 nowhere = {NAN, NAN, NAN};

// ---- indices -------------------------------------------------------------------------------------------------------------
static void check_block(Check *c, uint32_t b)
{
  const Mesh *m = c->m;
  const MeshBlock *k = &m->block[b];
  int nodes = elem_nodes(k->type);
  if (k->entity >= m->nentity) {
    check__report(c, RULE_INDEX, false, check__on(NONE), "block %u is on entity number %u of %zu", b,
                  k->entity, m->nentity);
    return;
  }
  if (!nodes || elem_dim(k->type) != m->entity[k->entity].dim)
    check__report(c, RULE_INDEX, false, check__on(k->entity), "elements of type %d (%s)", (int)k->type,
                  elem_name(k->type));
  if (b && (m->block[b - 1].entity > k->entity || (m->block[b - 1].entity == k->entity && m->block[b - 1].type >= k->type)))
    check__report(c, RULE_INDEX, false, check__on(k->entity), "blocks are not in order");
  for (size_t i = 0; i < k->n * (size_t)nodes; i++)
    if (UNLIKELY(k->node[i] >= m->nnode))
      check__report(c, RULE_INDEX, false, (Place){k->entity, b, i / (size_t)nodes, NONE, nowhere},
                    "node number %u of %zu", k->node[i], m->nnode);
    else
      c->used[k->node[i]] = 1;
}

static void check_indices(Check *c)
{
  const Mesh *m = c->m;
  for (size_t e = 0; e < m->nentity; e++) {
    const MeshEntity *a = &m->entity[e];
    if (a->dim < 0 || a->dim > 2)
      check__report(c, RULE_INDEX, false, check__on(NONE), "an entity of dimension %d", a->dim);
    if (e && (a[-1].dim > a->dim || (a[-1].dim == a->dim && a[-1].tag >= a->tag)))
      check__report(c, RULE_INDEX, false, check__on(NONE), "entities are not in order");
  }
  for (uint32_t b = 0; b < m->nblock; b++) check_block(c, b);
}

// ---- nodes ----------------------------------------------------------------------------------------------------------------
static void check_nodes(Check *c)
{
  const Mesh *m = c->m;
  for (size_t i = 0; i < m->nnode; i++) {
    if (UNLIKELY(m->node_entity[i] >= m->nentity))
      check__report(c, RULE_INDEX, false, (Place){NONE, NONE, 0, (uint32_t)i, nowhere},
                    "node %llu is on no entity", number_of(c, (uint32_t)i));
    if (UNLIKELY(!isfinite(m->xyz[3 * i] + m->xyz[3 * i + 1] + m->xyz[3 * i + 2])))
      check__report(c, RULE_COORDINATE, false, (Place){NONE, NONE, 0, (uint32_t)i, nowhere}, "node %llu",
                    number_of(c, (uint32_t)i));
    if (UNLIKELY(!c->used[i]))
      check__report(c, RULE_ORPHAN_NODE, !c->strict,
                    (Place){m->node_entity[i], NONE, 0, (uint32_t)i, mesh_xyz(m, (uint32_t)i)},
                    "node %llu is in no element", number_of(c, (uint32_t)i));
  }
}

static uint64_t hash_point(const double *x)
{
  uint64_t b[3], h = 0;
  double y[3] = {x[0] + 0.0, x[1] + 0.0, x[2] + 0.0};
  memcpy(b, y, sizeof b);
  for (int i = 0; i < 3; i++) h = (h ^ b[i] ^ b[i] >> 32) * 0x9e3779b97f4a7c15u;
  return h;
}

typedef struct {
  uint32_t first, second; // nodes
  bool meet;              // both are nodes of surface elements of one face
} Twins;
typedef Vec(Twins) TwinsVec;

// A node, and above it 32 bits of the hash of its place.
typedef uint64_t Placed;

static int twins_order(const void *x, const void *y)
{
  const Twins *a = x, *b = y;
  return a->second < b->second ? -1 : a->second > b->second;
}

// Pairs among the n nodes of a bucket, by open addressing. slot[] has room for a power of two of at least 2 n.
static void find_twins_in(const Mesh *m, const Placed *node, size_t n, uint32_t *slot, TwinsVec *out)
{
  int bits = 1;
  while ((size_t)1 << bits < 2 * n) bits++;
  size_t mask = ((size_t)1 << bits) - 1;
  memset(slot, 0xff, (mask + 1) * sizeof *slot);
  for (size_t k = 0; k < n; k++) {
    uint32_t i = (uint32_t)node[k], h = (uint32_t)(node[k] >> 32);
    const double *x = m->xyz + 3 * (size_t)i;
    size_t s = (size_t)((uint64_t)h << bits >> 32);
    for (; slot[s] != NONE; s = (s + 1) & mask) {
      if (LIKELY(node[slot[s]] >> 32 != h)) continue;
      const double *y = m->xyz + 3 * (size_t)(uint32_t)node[slot[s]];
      if (x[0] == y[0] && x[1] == y[1] && x[2] == y[2]) break;
    }
    if (slot[s] == NONE)
      slot[s] = (uint32_t)k;
    else
      vec_push(out, ((Twins){(uint32_t)node[slot[s]], i, false}));
  }
}

// Pairs of nodes at one place, the later one ascending. Nodes go into buckets by the upper bits of their hash first, so small that what is
// visited at random stays in the nearest memory.
static void find_twins(const Check *c, TwinsVec *out)
{
  enum { BUCKET = 2048 };
  const Mesh *m = c->m;
  int bits = 1;
  while (bits < 20 && m->nnode >> bits > BUCKET) bits++;
  size_t buckets = (size_t)1 << bits, most = 0;
  uint32_t *start = mem_zalloc((buckets + 2) * sizeof *start);
  for (size_t i = 0; i < m->nnode; i++) start[(hash_point(m->xyz + 3 * i) >> (64 - bits)) + 2]++;
  for (size_t b = 0; b < buckets; b++) {
    most = MAX(most, start[b + 2]);
    start[b + 2] += start[b + 1];
  }
  Placed *node = mem_alloc(m->nnode * sizeof *node);
  for (size_t i = 0; i < m->nnode; i++) {
    uint64_t h = hash_point(m->xyz + 3 * i);
    node[start[(h >> (64 - bits)) + 1]++] = h << bits >> 32 << 32 | i;
  }
  uint32_t *slot = mem_alloc(4 * (most + 1) * sizeof *slot);
  for (size_t b = 0; b < buckets; b++) find_twins_in(m, node + start[b], start[b + 1] - start[b], slot, out);
  if (out->len) qsort(out->data, out->len, sizeof *out->data, twins_order);
  free(slot);
  free(node);
  free(start);
}

void check__stamp_faces(const Check *c, void (*body)(void *ctx, uint32_t face, const uint32_t *stamp), void *ctx)
{
  const Mesh *m = c->m;
  uint32_t *stamp = mem_alloc(m->nnode * sizeof *stamp);
  memset(stamp, 0xff, m->nnode * sizeof *stamp);
  for (uint32_t b = 0; b < m->nblock; b++) {
    const MeshBlock *k = &m->block[b];
    if (elem_dim(k->type) != 2) continue;
    for (size_t i = 0; i < k->n * (size_t)elem_nodes(k->type); i++) stamp[k->node[i]] = k->entity;
    if (b + 1 == m->nblock || m->block[b + 1].entity != k->entity) body(ctx, k->entity, stamp);
  }
  free(stamp);
}

// Which pairs meet in the face.
static void find_meetings(void *ctx, uint32_t face, const uint32_t *stamp)
{
  TwinsVec *twins = ctx;
  for (size_t i = 0; i < twins->len; i++) {
    Twins *t = &twins->data[i];
    t->meet = t->meet || (stamp[t->first] == face && stamp[t->second] == face);
  }
}

// Two nodes of one face at one place make it wrong. Otherwise they may be meant: points of the geometry that coincide, faces that
// are not joined.
static void check_duplicate_nodes(Check *c)
{
  const Mesh *m = c->m;
  TwinsVec twins = {0};
  find_twins(c, &twins);
  if (twins.len) check__stamp_faces(c, find_meetings, &twins);
  for (size_t i = 0; i < twins.len; i++) {
    uint32_t a = twins.data[i].first, b = twins.data[i].second;
    check__report(c, RULE_DUPLICATE_NODE, !twins.data[i].meet,
                  (Place){m->node_entity[b], NONE, 0, b, mesh_xyz(m, b)},
                  "nodes %llu and %llu have the same coordinates", number_of(c, a), number_of(c, b));
  }
  vec_free(&twins);
}

// ---- classification -------------------------------------------------------------------------------------------------------
// Mark with `stamp` the entities that nodes of entity e's elements may be on: itself, its boundary and the boundary of that.
static void mark_closure(const Mesh *m, uint32_t e, uint32_t *mark, uint32_t stamp)
{
  const MeshEntity *a = &m->entity[e];
  mark[e] = stamp;
  for (int embedded = 0; embedded < 2; embedded++) {
    const IntVec *v = embedded ? &a->embedded : &a->boundary;
    for (size_t i = 0; i < v->len; i++) {
      uint32_t k = mesh_find_entity(m, a->dim - 1, abs(v->data[i]));
      if (k != NONE && a->dim > 0) mark_closure(m, k, mark, stamp);
    }
  }
}

static void check_classification(Check *c)
{
  const Mesh *m = c->m;
  uint32_t *mark = mem_alloc(m->nentity * sizeof *mark);
  memset(mark, 0xff, m->nentity * sizeof *mark);
  for (uint32_t b = 0; b < m->nblock; b++) {
    const MeshBlock *k = &m->block[b];
    int nodes = elem_nodes(k->type), dim = m->entity[k->entity].dim;
    mark_closure(m, k->entity, mark, b);
    for (size_t i = 0; i < k->n * (size_t)nodes; i++) {
      uint32_t on = m->node_entity[k->node[i]];
      // Points embedded in a face are in no list, so any point is good for a face.
      if (LIKELY(on == k->entity) || mark[on] == b || (dim == 2 && m->entity[on].dim == 0)) continue;
      check__report(c, RULE_CLASSIFICATION, false,
                    (Place){k->entity, b, i / (size_t)nodes, k->node[i], mesh_xyz(m, k->node[i])},
                    "node %llu is on %s %d", number_of(c, k->node[i]),
                    m->entity[on].dim == 0   ? "point"
                    : m->entity[on].dim == 1 ? "curve"
                                             : "face",
                    m->entity[on].tag);
    }
  }
  free(mark);
}

// ---- groups, periodic links -------------------------------------------------------------------------------------------------
static void check_groups(Check *c)
{
  const Mesh *m = c->m;
  Map known = {0}, filled = {0};
  Names names[4] = {{0}, {0}, {0}, {0}};
  for (size_t g = 0; g < m->ngroup; g++) {
    const MeshGroup *a = &m->group[g];
    bool fine = a->dim >= 0 && a->dim <= 3 && a->tag >= 0;
    if (!fine) {
      check__report(c, RULE_GROUP, false, check__on(NONE), "a group of dimension %d with tag %d", a->dim,
                    a->tag);
      continue;
    }
    map_set(&known, (uint64_t)a->dim << 32 | (uint32_t)a->tag, 1);
    if (!a->name) continue;
    uint32_t other = names_get(&names[a->dim], a->name);
    if (other != NONE)
      check__report(c, RULE_GROUP, true, check__on(NONE),
                    "groups %u and %d of dimension %d are both named '%.60s'", other, a->tag, a->dim,
                    a->name);
    names_set(&names[a->dim], a->name, (uint32_t)a->tag);
  }
  for (size_t b = 0; b < m->nblock; b++)
    for (size_t i = 0; m->block[b].n && i < m->entity[m->block[b].entity].physical.len; i++) {
      const MeshEntity *e = &m->entity[m->block[b].entity];
      map_set(&filled, (uint64_t)e->dim << 32 | (uint32_t)abs(e->physical.data[i]), 1);
    }
  for (uint32_t e = 0; e < m->nentity; e++)
    for (size_t i = 0; i < m->entity[e].physical.len; i++)
      if (map_get(&known, (uint64_t)m->entity[e].dim << 32 | (uint32_t)abs(m->entity[e].physical.data[i])) == NONE)
        check__report(c, RULE_GROUP, false, check__on(e), "it is in group %d, which does not exist",
                      abs(m->entity[e].physical.data[i]));
  for (size_t g = 0; g < m->ngroup; g++)
    if (m->group[g].dim < 3 && map_get(&filled, (uint64_t)m->group[g].dim << 32 | (uint32_t)m->group[g].tag) == NONE)
      check__report(c, RULE_GROUP, true, check__on(NONE), "group %d%s%.60s%s of dimension %d has no elements",
                    m->group[g].tag, m->group[g].name ? " '" : "", m->group[g].name ? m->group[g].name : "",
                    m->group[g].name ? "'" : "", m->group[g].dim);
  for (int d = 0; d < 4; d++) names_free(&names[d]);
  map_free(&known);
  map_free(&filled);
}

// Images within 1e-8 of the entities' size: maps are products of rounded sines, and meshes are read from other programs.
static void check_periodic(Check *c)
{
  const Mesh *m = c->m;
  for (size_t i = 0; i < m->nperiodic; i++) {
    const MeshPeriodic *p = &m->periodic[i];
    uint32_t e = mesh_find_entity(m, p->dim, p->tag), f = mesh_find_entity(m, p->dim, p->master);
    if (e == NONE || f == NONE) {
      check__report(c, RULE_PERIODIC, false, check__on(e),
                    "a link from %d to %d, of which one does not exist", p->master, p->tag);
      continue;
    }
    double size = 1e-8 * (vec3_distance(m->entity[e].lo, m->entity[e].hi) + vec3_length(m->entity[e].hi));
    for (size_t k = 0; k < p->slave_node.len; k++) {
      uint32_t a = p->slave_node.data[k], b = p->master_node.data[k];
      if (a >= m->nnode || b >= m->nnode) {
        check__report(c, RULE_PERIODIC, false, check__on(e), "a pair of nodes %u and %u", a, b);
        continue;
      }
      if (!p->has_affine) continue;
      const double *t = p->affine;
      Vec3 x = mesh_xyz(m, b), y = {t[0] * x.x + t[1] * x.y + t[2] * x.z + t[3], t[4] * x.x + t[5] * x.y + t[6] * x.z + t[7],
                                    t[8] * x.x + t[9] * x.y + t[10] * x.z + t[11]};
      double off = vec3_distance(y, mesh_xyz(m, a));
      if (off > size)
        check__report(c, RULE_PERIODIC, false, (Place){e, NONE, 0, a, mesh_xyz(m, a)},
                      "node %llu is %.3g away from the image of node %llu", number_of(c, a), off,
                      number_of(c, b));
    }
  }
}

static int finding_order(const void *x, const void *y)
{
  const MeshFinding *a = x, *b = y;
  return (a->rule > b->rule) - (a->rule < b->rule);
}

// By rule; insertion keeps the order within (there are few).
static void sort_findings(MeshReport *r)
{
  for (size_t i = 1; i < r->finding.len; i++) {
    MeshFinding f = r->finding.data[i];
    size_t j = i;
    for (; j > 0 && finding_order(&r->finding.data[j - 1], &f) > 0; j--) r->finding.data[j] = r->finding.data[j - 1];
    r->finding.data[j] = f;
  }
}

bool mesh_check(const Mesh *m, bool strict, MeshReport *report)
{
  *report = (MeshReport){0};
  Check c = {.m = m, .strict = strict, .r = report};
  c.number = mem_alloc((m->nblock + 1) * sizeof *c.number);
  c.used = mem_zalloc(m->nnode);
  c.number[0] = 0;
  for (size_t b = 0; b < m->nblock; b++) c.number[b + 1] = c.number[b] + m->block[b].n;
  check_indices(&c);
  check_nodes(&c);
  if (!report->count[RULE_INDEX]) { // else nothing more can be looked at safely
    check_duplicate_nodes(&c);
    if (strict) check_classification(&c);
    check_groups(&c);
    check_periodic(&c);
    mesh_edges_make(&c.edges, m);
    if (!report->count[RULE_COORDINATE]) check__faces(&c);
    check__conformity(&c);
    mesh_edges_free(&c.edges);
  }
  sort_findings(report);
  free(c.number);
  free(c.used);
  return report->errors == 0;
}
