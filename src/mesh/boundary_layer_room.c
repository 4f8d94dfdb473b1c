// boundary_layer_room.c - how high the columns of boundary layers may be: never overlapping, never turned over
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/boundary_layer_int.h"

#include "base/map.h"
#include "geom/predicates.h"

// The share of the way to the medial axis that layers may take up; what is left between two layers is a fifth of a gap.
#define SHARE 0.8
// Least length of the top of a cell against its base.
#define TOP_SHARE 0.25
// Most that the height may change from column to column, against the length of the base.
#define SLOPE 0.7

// ---- walls near a place: a uniform grid over them -----------------------------------------------------------------------
typedef struct {
  Vec2 lo;
  double cell;
  uint32_t nx, ny;
  uint32_t *start, *item;
} WallGrid;

static uint32_t clamp_cell(double x, uint32_t n) { return x < 0 ? 0 : x >= n ? n - 1 : (uint32_t)x; }

typedef struct {
  uint32_t x0, x1, y0, y1;
} CellRange;

static CellRange range_of(const WallGrid *g, Vec2 lo, Vec2 hi)
{
  return (CellRange){clamp_cell((lo.x - g->lo.x) / g->cell, g->nx), clamp_cell((hi.x - g->lo.x) / g->cell, g->nx),
                     clamp_cell((lo.y - g->lo.y) / g->cell, g->ny), clamp_cell((hi.y - g->lo.y) / g->cell, g->ny)};
}

static CellRange range_of_segment(const WallGrid *g, Vec2 a, Vec2 b)
{
  return range_of(g, (Vec2){fmin(a.x, b.x), fmin(a.y, b.y)}, (Vec2){fmax(a.x, b.x), fmax(a.y, b.y)});
}

static void grid_make(WallGrid *g, const Vec2 *ends, size_t n)
{
  Vec2 lo = {INFINITY, INFINITY}, hi = {-INFINITY, -INFINITY};
  double sum = 0;
  for (size_t i = 0; i < 2 * n; i++) {
    lo = (Vec2){fmin(lo.x, ends[i].x), fmin(lo.y, ends[i].y)};
    hi = (Vec2){fmax(hi.x, ends[i].x), fmax(hi.y, ends[i].y)};
    if (i % 2) sum += vec2_length(vec2_sub(ends[i], ends[i - 1]));
  }
  double w = hi.x - lo.x, h = hi.y - lo.y, size = fmax(sum / (double)n, sqrt(w * h / (double)n));
  size = fmax(size, fmax(w, h) / 4000);
  *g = (WallGrid){.lo = lo, .cell = size > 0 ? size : 1};
  g->nx = (uint32_t)(w / g->cell) + 1;
  g->ny = (uint32_t)(h / g->cell) + 1;
  g->start = mem_zalloc(((size_t)g->nx * g->ny + 2) * sizeof *g->start);
  for (int pass = 0; pass < 2; pass++) {
    for (size_t i = 0; i < n; i++) {
      CellRange r = range_of_segment(g, ends[2 * i], ends[2 * i + 1]);
      for (uint32_t y = r.y0; y <= r.y1; y++)
        for (uint32_t x = r.x0; x <= r.x1; x++) {
          size_t c = (size_t)y * g->nx + x;
          if (pass == 0)
            g->start[c + 2]++;
          else
            g->item[g->start[c + 1]++] = (uint32_t)i;
        }
    }
    if (pass) break;
    for (size_t c = 0; c < (size_t)g->nx * g->ny; c++) g->start[c + 2] += g->start[c + 1];
    g->item = mem_alloc(g->start[(size_t)g->nx * g->ny + 1] * sizeof *g->item);
  }
}

static void grid_free(WallGrid *g)
{
  free(g->start);
  free(g->item);
}

// ---- room: the largest ball that touches its own wall and holds no other wall ---------------------------------------------------
// Its centre is on the line b + t n, its radius `lift` times t: 1 if it touches the wall at the base b, less in a corner, where it touches the
// walls on either side. What these functions return is the largest t. Balls that the walls' own continuations touch are no closer than that.
#define TOUCH 1e-9

static double ball_to_point(Vec2 b, Vec2 n, double lift, Vec2 q)
{
  Vec2 d = vec2_sub(q, b);
  double ahead = vec2_dot(d, n), k = 1 - lift * lift;
  if (!(ahead > 0)) return INFINITY;
  double disc = ahead * ahead - k * vec2_dot(d, d);
  return disc > TOUCH * ahead * ahead ? vec2_dot(d, d) / (ahead + sqrt(disc)) : INFINITY;
}

static double ball_to_wall(Vec2 b, Vec2 n, double lift, const Wall *w)
{
  double r = fmin(ball_to_point(b, n, lift, w->a), ball_to_point(b, n, lift, w->b));
  Vec2 e = vec2_sub(w->b, w->a);
  double len = vec2_length(e);
  if (!(len > 0)) return r;
  Vec2 normal = {-e.y / len, e.x / len};
  double away = vec2_dot(vec2_sub(b, w->a), normal), rate = vec2_dot(n, normal);
  if (away < 0) {
    away = -away;
    rate = -rate;
  }
  if (!(lift - rate > TOUCH) || !(away > 0)) return r;
  double t = away / (lift - rate); // tangent to the line of the wall ...
  double along = vec2_dot(vec2_sub(vec2_add(b, vec2_scale(t, n)), w->a), e) / (len * len);
  return along > 0 && along < 1 ? fmin(r, t) : r; // ... at a point of the wall itself
}

// Walls that say nothing about a column: those on its base, and the straight curves that ends of its chain lie on (the columns
// there lean along them).
static bool beside(const Chain *c, const Column *k, const Wall *w)
{
  if ((w->a.x == k->base.x && w->a.y == k->base.y) || (w->b.x == k->base.x && w->b.y == k->base.y)) return true;
  if (c->closed || w->layered) return false;
  const Column *first = &c->col.data[0], *last = &vec_last(&c->col);
  return (first->on != NONE && w->curve == first->on) || (last->on != NONE && w->curve == last->on);
}

// Does the i-th column lean towards both of its neighbours? Then it stands in a corner of less than 180 degrees.
static bool in_corner(const Chain *c, size_t i)
{
  size_t n = c->col.len;
  if (!c->closed && (i == 0 || i + 1 == n)) return false;
  const Column *k = &c->col.data[i], *before = &c->col.data[(i + n - 1) % n], *after = &c->col.data[(i + 1) % n];
  return vec2_dot(k->dir, vec2_sub(before->base, k->base)) > 0 && vec2_dot(k->dir, vec2_sub(after->base, k->base)) > 0;
}

static void room_of_column(const FaceLayers *f, const WallGrid *g, const Chain *c, size_t i)
{
  Column *k = &c->col.data[i];
  double len = vec2_length(k->dir), want = chain__thickness(c) * len, reach = want / SHARE, lift = in_corner(c, i) ? 1 / len : 1;
  Vec2 n = vec2_scale(1 / len, k->dir), centre = vec2_add(k->base, vec2_scale(reach, n));
  CellRange r = range_of(g, (Vec2){centre.x - reach, centre.y - reach}, (Vec2){centre.x + reach, centre.y + reach});
  double room = INFINITY;
  for (uint32_t y = r.y0; y <= r.y1; y++)
    for (uint32_t x = r.x0; x <= r.x1; x++) {
      size_t cell = (size_t)y * g->nx + x;
      for (uint32_t j = g->start[cell]; j < g->start[cell + 1]; j++) {
        const Wall *w = &f->wall.data[g->item[j]];
        if (!beside(c, k, w)) room = fmin(room, ball_to_wall(k->base, n, lift, w));
      }
    }
  k->s = fmin(k->s, SHARE * room / want);
}

// Neighbours that lean towards each other must leave a top: what is over half of the room gives way, down to half or to what the other
// leaves. All look at the factors as they were, so that the order of the cells does not matter.
static void limit_lean(Chain *c)
{
  double h = chain__thickness(c), *was = mem_alloc(c->col.len * sizeof *was);
  for (size_t i = 0; i < c->col.len; i++) was[i] = c->col.data[i].s;
  for (size_t i = 0; i < chain__cells(c); i++) {
    Column *a = &c->col.data[i], *b = chain__next(c, i);
    Vec2 e = vec2_sub(b->base, a->base);
    double fa = fmax(0, h * vec2_dot(a->dir, e)), fb = fmax(0, -h * vec2_dot(b->dir, e)), room = (1 - TOP_SHARE) * vec2_dot(e, e);
    double la = was[i] * fa, lb = was[b - c->col.data] * fb;
    if (!(room > 0) || !(la + lb > room)) continue;
    if (la > room / 2) a->s = fmin(a->s, fmax(room / 2, room - lb) / fa);
    if (lb > room / 2) b->s = fmin(b->s, fmax(room / 2, room - la) / fb);
  }
  free(was);
}

static void limit_slope(Chain *c)
{
  double h = chain__thickness(c);
  size_t n = chain__cells(c), laps = c->closed ? 2 * n : n;
  for (size_t k = 0; k < laps; k++) {
    Column *a = &c->col.data[k % c->col.len], *b = chain__next(c, k % c->col.len);
    b->s = fmin(b->s, a->s + SLOPE * vec2_length(vec2_sub(b->base, a->base)) / h);
  }
  for (size_t k = laps; k-- > 0;) {
    Column *a = &c->col.data[k % c->col.len], *b = chain__next(c, k % c->col.len);
    a->s = fmin(a->s, b->s + SLOPE * vec2_length(vec2_sub(b->base, a->base)) / h);
  }
}

void layers__find_room(FaceLayers *f)
{
  Vec2 *ends = mem_alloc(2 * f->wall.len * sizeof *ends);
  for (size_t i = 0; i < f->wall.len; i++) {
    ends[2 * i] = f->wall.data[i].a;
    ends[2 * i + 1] = f->wall.data[i].b;
  }
  WallGrid g;
  grid_make(&g, ends, f->wall.len);
  free(ends);
  for (size_t j = 0; j < f->chain.len; j++) {
    Chain *c = &f->chain.data[j];
    for (size_t i = 0; i < c->col.len; i++)
      if (!c->col.data[i].collapsed) room_of_column(f, &g, c, i);
  }
  grid_free(&g);
}

// ---- exact checks ------------------------------------------------------------------------------------------------------
// A piece of the outline of the layers: a top between columns, or the open side of an end. Ends are known by places: two pieces
// that share one may touch there.
typedef struct {
  Vec2 a, b;
  Column *p, *q;  // whose factors make it; NULL for walls
  uint32_t curve; // of walls
} Piece;
typedef Vec(Piece) PieceVec;

static bool same(Vec2 a, Vec2 b) { return a.x == b.x && a.y == b.y; }

static int turn(Vec2 a, Vec2 b, Vec2 c)
{
  const double x[2] = {a.x, a.y}, y[2] = {b.x, b.y}, z[2] = {c.x, c.y};
  return orient2d(x, y, z);
}

static bool cell_good(const Chain *c, const Column *a, const Column *b)
{
  Vec2 v[4] = {a->base, b->base, column__top(c, b), column__top(c, a)}, p[4];
  int n = 0;
  for (int i = 0; i < 4; i++)
    if (!same(v[i], v[(i + 1) % 4])) p[n++] = v[i];
  if (n < 3) return true;
  for (int i = 0; i < n; i++)
    if (turn(p[i], p[(i + 1) % n], p[(i + 2) % n]) <= 0) return false;
  return true;
}

static PieceVec outline(FaceLayers *f)
{
  PieceVec piece = {0};
  for (size_t j = 0; j < f->chain.len; j++) {
    Chain *c = &f->chain.data[j];
    if (c->dropped) continue;
    for (size_t i = 0; i < chain__cells(c); i++) {
      Column *a = &c->col.data[i], *b = chain__next(c, i);
      Vec2 p = column__top(c, a), q = column__top(c, b);
      if (!same(p, q)) vec_push(&piece, ((Piece){p, q, a, b, NONE}));
    }
    for (size_t i = 0; i < c->col.len; i++) {
      Column *k = &c->col.data[i];
      if (k->open) vec_push(&piece, ((Piece){k->base, column__top(c, k), k, k, NONE}));
    }
  }
  for (size_t i = 0; i < f->wall.len; i++) {
    const Wall *w = &f->wall.data[i];
    if (!same(w->a, w->b)) vec_push(&piece, ((Piece){w->a, w->b, NULL, NULL, w->curve}));
  }
  return piece;
}

// Does the piece x of the layers meet y anywhere but in a common end? The top of a column may lie on the curve that the column
// lies on.
static bool clash(const Piece *x, const Piece *y)
{
  if (y->curve != NONE && (x->p->on == y->curve || x->q->on == y->curve)) return false;
  const double a[2] = {x->a.x, x->a.y}, b[2] = {x->b.x, x->b.y}, c[2] = {y->a.x, y->a.y}, d[2] = {y->b.x, y->b.y};
  switch (segments_meet(a, b, c, d)) {
  case SEG_DISJOINT:
  case SEG_SHARE: return false;
  case SEG_CROSS:
  case SEG_TOUCH:
  case SEG_OVERLAP: return true;
  }
  UNREACHABLE();
}

static void shrink(Column *k) { k->s *= 0.75; }

// An embedded point inside a cell.
static bool point_in_cell(const Chain *c, const Column *a, const Column *b, Vec2 p)
{
  Vec2 ta = column__top(c, a), tb = column__top(c, b);
  return turn(a->base, b->base, p) >= 0 && turn(tb, ta, p) >= 0 && turn(b->base, tb, p) >= 0 && turn(ta, a->base, p) >= 0;
}

// Mark what is wrong and shrink it; the number of faults.
static size_t check_cells(FaceLayers *f)
{
  size_t faults = 0;
  Vec(Vec2) point = {0};
  for (size_t w = 0; w < f->wall.len; w++)
    if (same(f->wall.data[w].a, f->wall.data[w].b)) vec_push(&point, f->wall.data[w].a);
  for (size_t j = 0; j < f->chain.len; j++) {
    Chain *c = &f->chain.data[j];
    if (c->dropped) continue;
    for (size_t i = 0; i < chain__cells(c); i++) {
      Column *a = &c->col.data[i], *b = chain__next(c, i);
      bool bad = !cell_good(c, a, b);
      for (size_t w = 0; w < point.len && !bad; w++) bad = point_in_cell(c, a, b, point.data[w]);
      if (!bad) continue;
      shrink(a);
      shrink(b);
      faults++;
    }
  }
  vec_free(&point);
  return faults;
}

static size_t check_outline(FaceLayers *f)
{
  PieceVec piece = outline(f);
  Vec2 *ends = mem_alloc(2 * piece.len * sizeof *ends);
  for (size_t i = 0; i < piece.len; i++) {
    ends[2 * i] = piece.data[i].a;
    ends[2 * i + 1] = piece.data[i].b;
  }
  WallGrid g;
  grid_make(&g, ends, piece.len);
  free(ends);
  bool *bad = mem_zalloc(piece.len);
  size_t faults = 0;
  for (size_t i = 0; i < piece.len; i++) {
    const Piece *x = &piece.data[i];
    if (!x->p) continue;
    CellRange r = range_of_segment(&g, x->a, x->b);
    for (uint32_t cy = r.y0; cy <= r.y1; cy++)
      for (uint32_t cx = r.x0; cx <= r.x1; cx++) {
        size_t cell = (size_t)cy * g.nx + cx;
        for (uint32_t k = g.start[cell]; k < g.start[cell + 1]; k++) {
          size_t other = g.item[k];
          if (other == i || !clash(x, &piece.data[other])) continue;
          bad[i] = true;
          bad[other] = true;
        }
      }
  }
  for (size_t i = 0; i < piece.len; i++) {
    if (!bad[i] || !piece.data[i].p) continue;
    shrink(piece.data[i].p);
    if (piece.data[i].q != piece.data[i].p) shrink(piece.data[i].q);
    faults++;
  }
  free(bad);
  grid_free(&g);
  vec_free(&piece);
  return faults;
}

enum { MAX_ROUNDS = 80 };

void layers__settle(FaceLayers *f)
{
  for (int round = 0; round < MAX_ROUNDS; round++) {
    for (size_t j = 0; j < f->chain.len; j++) {
      limit_lean(&f->chain.data[j]);
      limit_slope(&f->chain.data[j]);
    }
    if (check_cells(f) + check_outline(f) == 0) return;
  }
  for (size_t j = 0; j < f->chain.len; j++) f->chain.data[j].dropped = true;
}
