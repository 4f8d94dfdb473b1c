// test_boundary_layer.c - heights, room, symmetry of boundary layers; random faces with corners, gaps and holes
// SPDX-License-Identifier: MIT
#include "unit.h"

#include <math.h>
#include <string.h>

#include "base/rng.h"
#include "geom/predicates.h"
#include "mesh/mesh2d.h"
#include "model/model_edit.h"

#define PI 3.14159265358979323846

// A model under construction and all that meshing it needs.
typedef struct {
  Model *m;
  FieldSet *fields;
  Options opt;
  Diag *diag;
  SizeField *size;
  Mesh1d *curves;
  BoundaryLayers *layers;
  EdgeNodes en;
  FaceMesh *face;
} World;

static void world_init(World *w)
{
  *w = (World){.m = model_new(), .fields = fields_new(), .diag = diag_new(false)};
  options_init(&w->opt);
  field_create(w->fields, 1, "BoundaryLayer", NO_LOC, w->diag);
}

static void world_free(World *w)
{
  if (w->face) {
    for (size_t k = 0; k < model_faces(w->m); k++) face_mesh_free(&w->face[k]);
    edge_nodes_free(&w->en);
  }
  free(w->face);
  boundary_layers_free(w->layers);
  mesh1d_free(w->curves);
  size_free(w->size);
  fields_free(w->fields);
  options_free(&w->opt);
  model_free(w->m);
  diag_free(w->diag);
}

static void number(World *w, const char *key, double v) { assert_true(field_set_number(w->fields, 1, key, v, NO_LOC, w->diag)); }
static void list(World *w, const char *key, const double *v, size_t n)
{
  assert_true(field_set_list(w->fields, 1, key, v, n, NO_LOC, w->diag));
}

// First height, ratio and thickness of the layers.
static void growth(World *w, double size, double ratio, double thickness)
{
  number(w, "Size", size);
  number(w, "Ratio", ratio);
  number(w, "Thickness", thickness);
}

// A closed polygon of lines; tags of its first curve and of its loop. Curves and points are numbered on.
static int polygon(World *w, const Vec2 *p, int n, double lc, int *loop)
{
  int first_point = model_max_tag(w->m, KIND_POINT) + 1, first = model_max_tag(w->m, KIND_CURVE) + 1;
  for (int i = 0; i < n; i++) model_add_point(w->m, first_point + i, (Vec3){p[i].x, p[i].y, 0}, lc, NO_LOC, w->diag);
  IntVec curve = {0};
  for (int i = 0; i < n; i++) {
    const int ends[2] = {first_point + i, first_point + (i + 1) % n};
    model_add_curve(w->m, CURVE_LINE, first + i, ends, 2, NULL, NULL, 0, NO_LOC, w->diag);
    vec_push(&curve, first + i);
  }
  *loop = model_max_tag(w->m, KIND_LOOP) + 1;
  model_add_loop(w->m, *loop, curve.data, curve.len, NO_LOC, w->diag);
  vec_free(&curve);
  return first;
}

static size_t mesh_it(World *w)
{
  const double one = 1;
  fields_set_boundary_layers(w->fields, &one, 1, NO_LOC);
  assert_true(model_prepare(w->m, 1e-8, w->diag));
  w->size = size_new(w->m, &w->opt, w->fields, w->diag);
  assert_non_null(w->size);
  w->curves = mesh1d_new(w->m, &w->opt, w->size, w->diag);
  assert_non_null(w->curves);
  w->layers = boundary_layers_new(w->m, w->fields, &w->opt, w->curves, w->diag);
  edge_nodes_init(&w->en, w->m, w->curves);
  w->face = mem_zalloc(model_faces(w->m) * sizeof *w->face);
  Mesh2dInput in = {.model = w->m, .options = &w->opt, .size = w->size, .curves = w->curves, .layers = w->layers,
                    .diag = w->diag, .threads = 1};
  return mesh2d_run(&in, &w->en, w->face);
}

static Vec3 node(const World *w, uint32_t id) { return id < w->en.n ? w->en.xyz[id] : w->face[0].own[id - w->en.n]; }

// Sum of the areas of the first face's elements; counts those that are not positive (quadrangles at any corner).
static double area_of(const World *w, int *bad)
{
  const FaceMesh *f = &w->face[0];
  double sum = 0;
  for (size_t k = 0; k < f->ntri + f->nquad; k++) {
    int n = k < f->ntri ? 3 : 4;
    const uint32_t *v = n == 3 ? f->tri + 3 * k : f->quad + 4 * (k - f->ntri);
    for (int i = 0; i < (n == 4 ? 4 : 1); i++) {
      Vec3 a = node(w, v[i]), b = node(w, v[(i + 1) % n]), c = node(w, v[(i + 2) % n]);
      const double x[2] = {a.x, a.y}, y[2] = {b.x, b.y}, z[2] = {c.x, c.y};
      *bad += orient2d(x, y, z) <= 0;
    }
    for (int i = 1; i + 1 < n; i++) {
      Vec3 a = node(w, v[0]), b = node(w, v[i]), c = node(w, v[i + 1]);
      sum += 0.5 * vec3_cross(vec3_sub(b, a), vec3_sub(c, a)).z;
    }
  }
  return sum;
}

static double polygon_area(const Vec2 *p, int n)
{
  double sum = 0;
  for (int i = 0; i < n; i++) sum += 0.5 * vec2_cross(p[i], p[(i + 1) % n]);
  return sum;
}

static void heights_follow_the_laws(void **state)
{
  (void)state;
  double h[64];
  assert_int_equal(layer_heights(0.1, 1, 0.5, h, 64), 5);
  assert_true(fabs(h[4] - 0.5) < 1e-15);
  assert_int_equal(layer_heights(1, 2, 7, h, 64), 3); // 1, 3, 7
  assert_true(h[2] == 7);
  assert_int_equal(layer_heights(1, 2, 6.9, h, 64), 2);
  assert_int_equal(layer_heights(1, 2, 0.5, h, 64), 0);
  layer_heights_beta(2, 1.1, 10, h);
  for (int k = 1; k < 10; k++) assert_true(h[k] > h[k - 1] && (k < 2 || h[k] - h[k - 1] > h[k - 1] - h[k - 2]));
  assert_true(h[9] == 2 && h[0] > 0);
}

// A unit square with layers on its lower side: at 10 columns the heights asked for, on both sides too, and the top is straight.
static void a_wall_has_the_heights_asked_for(void **state)
{
  (void)state;
  World w;
  world_init(&w);
  const Vec2 p[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  int loop;
  const double curve = polygon(&w, p, 4, 0.1, &loop);
  model_add_face(w.m, FACE_PLANE, 1, &loop, 1, NO_LOC, w.diag);
  list(&w, "CurvesList", &curve, 1);
  growth(&w, 0.01, 1.2, 0.1);
  number(&w, "Quads", 1);
  assert_int_equal(mesh_it(&w), 0);
  double h[64];
  size_t n = layer_heights(0.01, 1.2, 0.1, h, 64);
  assert_int_equal(w.face[0].nquad, 10 * n);
  int bad = 0;
  assert_true(fabs(area_of(&w, &bad) - 1) < 1e-12);
  assert_int_equal(bad, 0);
  for (size_t k = 0; k < w.face[0].nquad; k++) {
    const uint32_t *v = w.face[0].quad + 4 * k;
    for (int i = 0; i < 4; i++) {
      double y = node(&w, v[i]).y, want = i < 2 ? (k % n ? h[k % n - 1] : 0) : h[k % n];
      assert_true(fabs(y - want) < 1e-12);
    }
  }
  const CurveMesh *side = mesh1d_curve(w.curves, (int)curve + 1); // has the layers' nodes
  for (size_t k = 0; k < n; k++) assert_true(fabs(side->p[k + 1].y - h[k]) < 1e-12);
  world_free(&w);
}

// Whether the image of each corner of a quadrangle is one as well.
static bool is_symmetric(const World *w, Vec3 (*image)(Vec3))
{
  const FaceMesh *f = &w->face[0];
  for (size_t k = 0; k < 4 * f->nquad; k++) {
    Vec3 q = image(node(w, f->quad[k]));
    double best = INFINITY;
    for (size_t l = 0; l < 4 * f->nquad; l++) best = fmin(best, vec3_distance(node(w, f->quad[l]), q));
    if (best >= 1e-12) return false;
  }
  return true;
}

static Vec3 quarter_turn(Vec3 p) { return (Vec3){-p.y, p.x, 0}; }
static Vec3 mirrored(Vec3 p) { return (Vec3){p.x, -p.y, 0}; }

// Inside of a square with layers all round: symmetric by quarter turns, and shortened in the corners.
static void symmetric_faces_get_symmetric_layers(void **state)
{
  (void)state;
  World w;
  world_init(&w);
  const Vec2 p[4] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  int loop, first = polygon(&w, p, 4, 0.1, &loop);
  model_add_face(w.m, FACE_PLANE, 1, &loop, 1, NO_LOC, w.diag);
  const double curves[4] = {first, first + 1, first + 2, first + 3};
  list(&w, "CurvesList", curves, 4);
  growth(&w, 0.02, 1.3, 0.25);
  number(&w, "Quads", 1);
  assert_int_equal(mesh_it(&w), 0);
  int bad = 0;
  assert_true(fabs(area_of(&w, &bad) - 4) < 1e-11);
  assert_int_equal(bad, 0);
  assert_true(w.face[0].nquad > 300);
  assert_true(is_symmetric(&w, quarter_turn));
  world_free(&w);
}

// A wedge with a notch in its back, in a box: mirrored by y -> -y, in the corner of the notch too, where columns lean on each other.
static void a_notch_is_symmetric(void **state)
{
  (void)state;
  World w;
  world_init(&w);
  const Vec2 box[4] = {{-2, -2}, {4, -2}, {4, 2}, {-2, 2}}, wedge[4] = {{0, 0.3}, {0.3, 0}, {0, -0.3}, {2, 0}};
  int loop[2], first;
  polygon(&w, box, 4, 0.3, &loop[0]);
  first = polygon(&w, wedge, 4, 0.08, &loop[1]);
  model_add_face(w.m, FACE_PLANE, 1, loop, 2, NO_LOC, w.diag);
  const double curves[4] = {first, first + 1, first + 2, first + 3}, fans[3] = {5, 7, 8};
  list(&w, "CurvesList", curves, 4);
  list(&w, "FanPointsList", fans, 3);
  growth(&w, 0.01, 1.2, 0.2);
  number(&w, "Quads", 1);
  assert_int_equal(mesh_it(&w), 0);
  int bad = 0;
  (void)area_of(&w, &bad);
  assert_int_equal(bad, 0);
  assert_true(w.face[0].nquad > 400);
  assert_true(is_symmetric(&w, mirrored));
  world_free(&w);
}

// Around a square hole with fans at its corners: columns all round the corner, of full height.
static void fans_turn_round_corners(void **state)
{
  (void)state;
  World w;
  world_init(&w);
  const Vec2 outer[4] = {{-3, -3}, {3, -3}, {3, 3}, {-3, 3}}, hole[4] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  int loop[2];
  polygon(&w, outer, 4, 0.5, &loop[0]);
  int first = polygon(&w, hole, 4, 0.2, &loop[1]);
  model_add_face(w.m, FACE_PLANE, 1, loop, 2, NO_LOC, w.diag);
  const double curves[4] = {first, first + 1, first + 2, first + 3}, fans[4] = {5, 6, 7, 8}, cells[4] = {4, 4, 4, 4};
  list(&w, "CurvesList", curves, 4);
  list(&w, "FanPointsList", fans, 4);
  list(&w, "FanPointsSizesList", cells, 4);
  growth(&w, 0.05, 1.2, 0.4);
  number(&w, "Quads", 1);
  assert_int_equal(mesh_it(&w), 0);
  double h[64];
  size_t n = layer_heights(0.05, 1.2, 0.4, h, 64), around = 4 * 10 + 4 * 4;
  assert_int_equal(w.face[0].nquad, around * n - 16); // the first cells of the fans are triangles
  int bad = 0;
  assert_true(fabs(area_of(&w, &bad) - 32) < 1e-11);
  assert_int_equal(bad, 0);
  for (size_t k = 0; k < 4 * w.face[0].nquad; k++) {
    Vec3 q = node(&w, w.face[0].quad[k]);
    double dx = fmax(fabs(q.x) - 1, 0), dy = fmax(fabs(q.y) - 1, 0), d = sqrt(dx * dx + dy * dy), best = d;
    for (size_t l = 0; l < n; l++) best = fmin(best, fabs(d - h[l]));
    assert_true(best < 1e-12);
  }
  world_free(&w);
}

// Star-shaped about the origin, radii between lo and hi.
static int random_star(Rng *r, Vec2 *p, double lo, double hi)
{
  int n = 4 + (int)rng_below(r, 12);
  for (int i = 0; i < n; i++) {
    double a = 2 * PI * (i + 0.6 * (rng_double(r) - 0.5)) / n, d = lo + (hi - lo) * rng_double(r);
    p[i] = (Vec2){d * cos(a), d * sin(a)};
  }
  return n;
}

static double distance_to_segment(Vec2 p, Vec2 a, Vec2 b)
{
  Vec2 e = vec2_sub(b, a), d = vec2_sub(p, a);
  double t = fmin(fmax(vec2_dot(d, e) / vec2_dot(e, e), 0), 1);
  return vec2_length(vec2_sub(d, vec2_scale(t, e)));
}

static bool has_node_near(const World *w, Vec2 q, double tolerance)
{
  for (size_t i = 0; i < w->face[0].nown; i++) {
    Vec3 p = w->face[0].own[i];
    if (fabs(p.x - q.x) < tolerance && fabs(p.y - q.y) < tolerance) return true;
  }
  return false;
}

typedef struct {
  const Vec2 *p;
  int n, first; // corners, tag of the first side
} Ring;

// At nodes of straight walls that are farther than three thicknesses from every other wall and from the wall's own ends, the first and
// the last layer are as high as asked for, within one percent. Returns how many nodes that were.
static int check_heights(const World *w, const Ring *ring, int nring, const double *curves, int ncurve, const double *h, size_t n, int side)
{
  int seen = 0;
  for (int l = 0; l < nring; l++)
    for (int i = 0; i < ring[l].n; i++) {
      bool layered = false;
      for (int k = 0; k < ncurve; k++) layered = layered || (int)curves[k] == ring[l].first + i;
      Vec2 a = ring[l].p[i], b = ring[l].p[(i + 1) % ring[l].n], e = vec2_sub(b, a);
      Vec2 normal = vec2_scale((l ? -side : side) / vec2_length(e), (Vec2){-e.y, e.x});
      const CurveMesh *cm = layered ? mesh1d_curve(w->curves, ring[l].first + i) : NULL;
      for (uint32_t v = 1; cm && v + 1 < cm->n; v++) {
        Vec2 q = {cm->p[v].x, cm->p[v].y};
        double room = fmin(vec2_length(vec2_sub(q, a)), vec2_length(vec2_sub(q, b)));
        for (int m = 0; m < nring; m++)
          for (int k = 0; k < ring[m].n; k++)
            if (m != l || k != i) room = fmin(room, distance_to_segment(q, ring[m].p[k], ring[m].p[(k + 1) % ring[m].n]));
        if (room < 3 * h[n - 1]) continue;
        seen++;
        assert_true(has_node_near(w, vec2_add(q, vec2_scale(h[0], normal)), 0.01 * h[0]));
        assert_true(has_node_near(w, vec2_add(q, vec2_scale(h[n - 1], normal)), 0.01 * h[n - 1]));
      }
    }
  return seen;
}

static int random_face(Rng *r, int trial)
{
  World w;
  world_init(&w);
  Vec2 outer[16], hole[16];
  double narrow = trial % 3 == 0 ? 0.02 : 0.3; // a gap between hole and outer boundary
  int n = random_star(r, outer, trial % 2 ? 2 : 1, 2.5), m = random_star(r, hole, 0.3, 0.8), loops = 1 + (int)rng_below(r, 2);
  double least = INFINITY; // distance of the outer polygon from the origin
  for (int i = 0; i < n; i++) {
    Vec2 e = vec2_sub(outer[(i + 1) % n], outer[i]);
    least = fmin(least, fabs(vec2_cross(e, outer[i])) / vec2_length(e));
  }
  for (int i = 0; i < m; i++) hole[i] = vec2_scale(fmin(1, (1 - narrow) * least / vec2_length(hole[i])), hole[i]);
  double lc = 0.05 + 0.3 * rng_double(r), curves[32], fans[32];
  int loop[2], first = polygon(&w, outer, n, lc, &loop[0]), ncurve = 0, nfan = 0;
  if (loops == 2) polygon(&w, hole, m, 0.5 * lc, &loop[1]);
  model_add_face(w.m, FACE_PLANE, 1, loop, (size_t)loops, NO_LOC, w.diag);
  int all = loops == 2 ? n + m : n;
  for (int i = 0; i < all; i++) {
    if (rng_below(r, 4)) curves[ncurve++] = first + i;
    if (rng_below(r, 2)) fans[nfan++] = 1 + i;
  }
  list(&w, "CurvesList", curves, (size_t)ncurve);
  list(&w, "FanPointsList", fans, (size_t)nfan);
  double height[512], size = 0.002 + 0.02 * rng_double(r), ratio = 1 + 0.4 * rng_double(r);
  double thickness = 0.03 + 0.4 * rng_double(r) * rng_double(r);
  growth(&w, size, ratio, thickness);
  number(&w, "Quads", rng_below(r, 2));
  size_t failed = mesh_it(&w);
  if (failed) fprintf(stderr, "trial %d: %s\n", trial, diag_count(w.diag) ? diag_get(w.diag, 0)->text : "");
  assert_int_equal(failed, 0);
  for (size_t i = 0; i < diag_count(w.diag); i++) assert_null(strstr(diag_get(w.diag, i)->text, "no room"));
  int bad = 0;
  double area = area_of(&w, &bad), want = polygon_area(outer, n) - (loops == 2 ? polygon_area(hole, m) : 0);
  if (bad || fabs(area - want) > 1e-10) fprintf(stderr, "trial %d: %d bad, area %.15g, want %.15g\n", trial, bad, area, want);
  assert_int_equal(bad, 0);
  assert_true(fabs(area - want) < 1e-10);
  const Ring ring[2] = {{outer, n, first}, {hole, m, first + n}};
  int seen = check_heights(&w, ring, loops, curves, ncurve, height, layer_heights(size, ratio, thickness, height, 512), 1);
  world_free(&w);
  return seen;
}

// In a corner with room every layer goes round at its height: the column stands on the bisector, as long as that takes.
static void corners_with_room_are_mitred(void **state)
{
  (void)state;
  World w;
  world_init(&w);
  const Vec2 p[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  int loop, first = polygon(&w, p, 4, 0.2, &loop);
  model_add_face(w.m, FACE_PLANE, 1, &loop, 1, NO_LOC, w.diag);
  const double curves[4] = {first, first + 1, first + 2, first + 3};
  list(&w, "CurvesList", curves, 4);
  growth(&w, 0.01, 1.2, 0.1);
  number(&w, "Quads", 1);
  assert_int_equal(mesh_it(&w), 0);
  double h[64];
  size_t n = layer_heights(0.01, 1.2, 0.1, h, 64);
  assert_int_equal(w.face[0].nquad, 20 * n);
  for (size_t k = 0; k < n; k++) {
    assert_true(has_node_near(&w, (Vec2){h[k], h[k]}, 1e-9));
    assert_true(has_node_near(&w, (Vec2){1 - h[k], h[k]}, 1e-9));
    assert_true(has_node_near(&w, (Vec2){0.2, h[k]}, 1e-9));
  }
  world_free(&w);
}

// Between two walls too near for the thickness the layers are fewer in height, not in number: the first keeps its height.
static void narrow_gaps_keep_the_first_height(void **state)
{
  (void)state;
  World w;
  world_init(&w);
  const Vec2 p[4] = {{0, 0}, {4, 0}, {4, 0.5}, {0, 0.5}};
  int loop, first = polygon(&w, p, 4, 0.1, &loop);
  model_add_face(w.m, FACE_PLANE, 1, &loop, 1, NO_LOC, w.diag);
  const double curves[2] = {first, first + 2}, sizes[4] = {1, 0.01, 2, 0.02};
  list(&w, "CurvesList", curves, 2);
  list(&w, "SizesList", sizes, 4);
  growth(&w, 0.01, 1.3, 0.4);
  assert_int_equal(mesh_it(&w), 0);
  int bad = 0;
  assert_true(fabs(area_of(&w, &bad) - 2) < 1e-11);
  assert_int_equal(bad, 0);
  for (int i = 1; i < 40; i++) { // 0.01 at the left end to 0.02 at the right one below, 0.01 everywhere above
    assert_true(has_node_near(&w, (Vec2){i * 0.1, 0.01 + 0.01 * i / 40}, 1e-9));
    assert_true(has_node_near(&w, (Vec2){i * 0.1, 0.49}, 1e-9));
  }
  world_free(&w);
}

static void random_faces_never_overlap(void **state)
{
  (void)state;
  Rng r = {5};
  int seen = 0;
  for (int trial = 0; trial < 300; trial++) seen += random_face(&r, trial);
  printf("# heights seen at %d nodes\n", seen);
  assert_true(seen > 1000);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(heights_follow_the_laws),
      cmocka_unit_test(a_wall_has_the_heights_asked_for),
      cmocka_unit_test(symmetric_faces_get_symmetric_layers),
      cmocka_unit_test(a_notch_is_symmetric),
      cmocka_unit_test(fans_turn_round_corners),
      cmocka_unit_test(narrow_gaps_keep_the_first_height),
      cmocka_unit_test(corners_with_room_are_mitred),
      cmocka_unit_test(random_faces_never_overlap),
  };
  return unit_run(tests);
}
