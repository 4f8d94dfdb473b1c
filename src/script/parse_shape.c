// parse_shape.c - commands on shapes: transformations, extrusions, boundaries
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "script/parse_int.h"

static Node *as_list(Node *n)
{
  n->flags |= NODE_IS_LIST;
  return n;
}

// A three-dimensional or OpenCASCADE construct: past its balanced brackets, leaving its end (';', ',', '}')
// to the caller.
static Node *parse_unsupported(Parser *p, const char *text)
{
  Token begin = parse__advance(p);
  int depth = 0;
  while (p->tok.kind != TOK_END) {
    int k = p->tok.kind;
    if (!depth && (k == ';' || k == ',' || k == '}' || k == ')' || k == ']')) break;
    if (k == '{' || k == '(' || k == '[') depth++;
    if (k == '}' || k == ')' || k == ']') depth--;
    parse__advance(p);
    bool goes_on = p->tok.kind == '{' || (p->tok.kind == TOK_WORD && p->tok.loc.line == begin.loc.line);
    if (!depth && k == '}' && !goes_on) break;
  }
  Node *n = parse__node(p, NODE_UNSUPPORTED, begin.loc, 0);
  char *message = arena_alloc(p->arena, begin.len + strlen(text) + 4);
  snprintf(message, begin.len + strlen(text) + 4, "%.*s %s", (int)begin.len, begin.start, text);
  n->text = message;
  return as_list(n);
}

// ---- lists of shapes ---------------------------------------------

// layers -> "Layers" "{" counts ["," [tags ","] heights] "}" ";"
static Node *parse_layers(Parser *p)
{
  Token begin = parse__advance(p);
  parse__expect(p, '{', "'{'");
  parse__open(p);
  Node *list[3] = {NULL};
  int n = 0;
  do {
    if (n == 3) parse__expected(p, "'}'");
    list[n++] = parse__expr(p);
  } while (parse__accept(p, ','));
  parse__close(p);
  parse__expect(p, '}', "'}' after the layers");
  parse__semicolon(p);
  return parse__node2(p, NODE_LAYERS, begin.loc, list[0], n == 3 ? list[2] : list[1]);
}

typedef struct {
  Node *layers, *recombine;
  bool *drop; // of a Boolean operation: Delete; may be said, and nothing else
} ExtrudeParameters;

// parameter -> layers | "Recombine" [number] ";" | "Using" NAME "[" number "]" ";" | "ScaleLastLayer" ";"
//             | ("QuadTriAddVerts" | "QuadTriNoNewVerts" | "QuadTriSngl" | "QuadTriDbl") ["RecombLaterals"]
//               ";" | "Hole" "(" number ")" "=" list "Using" number ";"
static bool parse_extrude_parameter(Parser *p, ExtrudeParameters *out)
{
  if (p->tok.kind != TOK_WORD) return false;
  Token t = p->tok;
  if (out->drop) {
    if (!parse__accept_word(p, KW_Delete)) return false;
    *out->drop = true;
    parse__semicolon(p);
    return true;
  }
  switch (t.word) {
  case KW_Layers: out->layers = parse_layers(p); return true;
  case KW_Recombine:
    parse__advance(p);
    if (parse__at(p, ';')) {
      out->recombine = parse__node(p, NODE_NUMBER, t.loc, 0);
      out->recombine->number = 1;
    } else {
      out->recombine = parse__number(p);
    }
    parse__semicolon(p);
    return true;
  case KW_Using: // Using Index[..], View[..]: boundary layers
    parse__advance(p);
    while (p->tok.kind != ';' && p->tok.kind != TOK_END) parse__advance(p);
    parse__semicolon(p);
    return true;
  case KW_QuadTriAddVerts:
  case KW_QuadTriNoNewVerts:
  case KW_QuadTriDbl:
  case KW_QuadTriSngl:
    diag_warning(p->diag, t.loc, "'%s' is left out: it fits volumes of hexahedra to tetrahedra, and the surfaces keep their quadrangles",
                 words_text(p->words, t.word));
    // fall through
  case KW_ScaleLastLayer: // shapes the volumes only
    parse__advance(p);
    parse__accept_word(p, KW_RecombLaterals);
    parse__semicolon(p);
    return true;
  case KW_Hole: // Hole(n) = {..} Using n;
    while (p->tok.kind != ';' && p->tok.kind != TOK_END) parse__advance(p);
    parse__semicolon(p);
    return true;
  default: return false;
  }
}

// shapes -> "{" [shape]... "}"
// shape -> ["Physical"] entity list ";" | entity "In" "BoundingBox" "{" items "}" ";" | transform | extrude
//         | boundary | boolean
static Node *parse_shapes(Parser *p, ExtrudeParameters *parameters)
{
  Token open = parse__expect(p, '{', "'{' and a list of shapes such as Surface{1};");
  parse__open(p);
  size_t base = p->stack.len;
  while (!parse__at(p, '}')) {
    if (parameters && parse_extrude_parameter(p, parameters)) continue;
    SrcLoc loc = p->tok.loc;
    if (parse__at(p, ';')) {
      p->last_end.line = loc.line;
      parse__superfluous_semicolon(p);
      continue;
    }
    parse__accept_word(p, KW_Parent);
    bool physical = parse__accept_word(p, KW_Physical);
    int dim = parse__dimension(p);
    if (dim < 0 && !physical) {
      Node *command = parse__command(p);
      if (!command) parse__expected(p, "a shape such as Surface{1}; or '}'");
      vec_push(&p->stack, command);
      continue;
    }
    if (dim < 0) parse__expected(p, "Point, Curve, Surface or Volume");
    parse__advance(p);
    Node *shape;
    if (parse__accept_word(p, KW_In)) { // Curve In BoundingBox {..}
      if (!parse__accept_word(p, KW_BoundingBox)) parse__expected(p, "'BoundingBox'");
      Node *box = parse__node1(p, NODE_IN_BOX, loc, parse__braced_numbers(p, "'{'"));
      box->op = (uint16_t)dim;
      shape = parse__node1(p, NODE_SHAPE, loc, as_list(box));
    } else {
      shape = parse__node1(p, NODE_SHAPE, loc, parse__list_or_all(p));
    }
    shape->op = (uint16_t)dim;
    shape->flags = physical ? LIST_PHYSICAL : 0;
    vec_push(&p->stack, shape);
    if (parse__at(p, '}')) {
      diag_error(p->diag, p->last_end, "expected ';' after this shape");
      continue;
    }
    parse__semicolon(p);
  }
  parse__advance(p);
  parse__close(p);
  return parse__collect(p, NODE_SHAPES, open.loc, base);
}

Node *parse__shapes(Parser *p) { return parse_shapes(p, NULL); }

// ---- transformations ---------------------------------------------

// transform -> "Translate" vector shapes | "Rotate" "{" vector "," vector "," number "}" shapes
//             | "Symmetry" "{" a "," b "," c "," d "}" shapes | "Dilate" "{" vector "," (number | vector)
//               "}" shapes | "Affine" list shapes | "Duplicata" shapes
static Node *parse_transform(Parser *p)
{
  Token t = parse__advance(p);
  size_t base = p->stack.len;
  Node *kid[3] = {NULL};
  if (t.word == KW_Rotate || t.word == KW_Dilate) {
    parse__expect(p, '{', "'{'");
    parse__open(p);
    kid[0] = parse__expr(p);
    parse__expect(p, ',', "','");
    kid[1] = parse__expr(p);
    if (t.word == KW_Rotate) {
      parse__expect(p, ',', "',' and the angle");
      kid[2] = parse__number(p);
    }
    parse__close(p);
    parse__expect(p, '}', "'}'");
  } else if (t.word != KW_Duplicata) {
    kid[0] = parse__expr(p);
  }
  for (int i = 0; i < 3; i++) vec_push(&p->stack, kid[i]);
  Node *shapes = parse__shapes(p);
  vec_push(&p->stack, shapes);
  Node *n = parse__collect(p, NODE_TRANSFORM, t.loc, base);
  n->word = t.word;
  return as_list(n);
}

// The old form, Extrude Surface {tag, vector...} [{parameters}]: as if written with a list of shapes.
static Node *parse_old_extrude(Parser *p, Token begin, Node **kid, int *op)
{
  Token t = p->tok;
  int dim = parse__dimension(p);
  parse__advance(p);
  parse__expect(p, '{', "'{'");
  Node *tag = parse__number(p), *part[4] = {NULL};
  int n = 0;
  while (parse__accept(p, ',')) {
    if (n == 4) parse__expected(p, "'}'");
    part[n++] = parse__expr(p);
  }
  parse__expect(p, '}', "'}'");
  if (n == 0 || n == 2)
    parse__fail(p, begin.loc, "Extrude needs a translation {dx,dy,dz}, or an axis, a point and an angle");
  *op = n == 1 ? 1 : n == 3 ? 2 : 3;
  kid[0] = n == 3 ? NULL : part[0];
  for (int i = 0; i < 3 && n > 1; i++) kid[1 + i] = part[n - 3 + i];
  Node *shape = parse__node1(p, NODE_SHAPE, t.loc, tag);
  shape->op = (uint16_t)dim;
  return parse__node1(p, NODE_SHAPES, t.loc, shape);
}

// extrude -> "Extrude" [vector | "{" [vector ","] vector "," vector "," number "}"] "{" (shape
//           | parameter)... "}"
static Node *parse_extrude(Parser *p)
{
  Token begin = parse__advance(p);
  Node *kid[7] = {NULL};
  ExtrudeParameters parameters = {.drop = NULL};
  int op = 0;
  if (parse__dimension(p) >= 0) {
    kid[4] = parse_old_extrude(p, begin, kid, &op);
    if (parse__accept(p, '{')) {
      parse__open(p);
      while (parse_extrude_parameter(p, &parameters)) continue;
      parse__close(p);
      parse__expect(p, '}', "'}'");
    }
    parse__semicolon(p);
  } else {
    Token next = parse__at(p, '{') ? parse__peek(p) : p->tok;
    bool shapes = next.kind == TOK_WORD &&
                  (next.word == KW_Point || next.word == KW_Line || next.word == KW_Surface ||
                   next.word == KW_Volume || next.word == KW_Physical || next.word == KW_Layers);
    if (next.kind == '{') {
      parse__advance(p);
      parse__open(p);
      Node *part[4] = {NULL};
      int n = 0;
      do {
        if (n == 4) parse__expected(p, "'}'");
        part[n++] = parse__expr(p);
      } while (parse__accept(p, ','));
      parse__close(p);
      parse__expect(p, '}', "'}'");
      if (n < 3) parse__fail(p, begin.loc, "Extrude by rotation needs an axis, a point and an angle");
      op = n == 3 ? 2 : 3;
      if (n == 4) kid[0] = part[0];
      for (int i = 0; i < 3; i++) kid[1 + i] = part[n - 3 + i];
    } else if (!shapes) {
      op = 1;
      kid[0] = parse__expr(p);
    }
    kid[4] = parse_shapes(p, &parameters);
    if (parse__at_word(p, KW_Using))
      return parse_unsupported(p, "Wire (extrusion along a curve) needs OpenCASCADE");
  }
  kid[5] = parameters.layers;
  kid[6] = parameters.recombine;
  size_t base = p->stack.len;
  for (int i = 0; i < 7; i++) vec_push(&p->stack, kid[i]);
  Node *n = parse__collect(p, NODE_EXTRUDE, begin.loc, base);
  n->op = (uint16_t)op;
  return as_list(n);
}

// split -> "Split" "Curve" (list | "(" number ")") ["Point"] list
static Node *parse_split(Parser *p)
{
  Token begin = parse__advance(p);
  if (parse__dimension(p) != 1) parse__expected(p, "'Curve'");
  parse__advance(p);
  Node *curve = parse__at(p, '(') ? parse__number(p) : parse__list(p);
  parse__accept_word(p, KW_Point);
  Node *points = parse__list(p);
  return as_list(parse__node2(p, NODE_SPLIT, begin.loc, curve, points));
}

// boolean -> ("BooleanUnion" | "BooleanIntersection" | "BooleanDifference" | "BooleanFragments")
//            ["(" tag ")" "="] operands operands
// operands -> "{" (shape | "Delete" ";")... "}"
static Node *parse_boolean(Parser *p)
{
  Token t = parse__advance(p);
  bool drop[2] = {false, false};
  size_t base = p->stack.len;
  Node *tag = NULL;
  if (parse__at(p, '(')) {
    tag = parse__tag(p);
    parse__expect(p, '=', "'='");
  }
  vec_push(&p->stack, tag);
  for (int i = 0; i < 2; i++) {
    ExtrudeParameters parameters = {.drop = &drop[i]};
    Node *shapes = parse_shapes(p, &parameters);
    vec_push(&p->stack, shapes);
  }
  if (tag) parse__semicolon(p);
  Node *n = parse__collect(p, NODE_BOOLEAN, t.loc, base);
  n->word = t.word;
  n->op = (uint16_t)((drop[0] ? 1 : 0) | (drop[1] ? 2 : 0));
  return as_list(n);
}

// boundary -> ("Boundary" | "CombinedBoundary" | "OrientedBoundary" | "OrientedCombinedBoundary"
//            | "PointsOf") shapes
Node *parse__command(Parser *p)
{
  if (p->tok.kind != TOK_WORD) return NULL;
  Token t = p->tok;
  const char *occ = "needs the OpenCASCADE kernel, which this program does not have";
  switch (t.word) {
  case KW_Duplicata:
    if (parse__peek(p).kind != '{') return NULL;
    return parse_transform(p);
  case KW_Translate:
  case KW_Rotate:
  case KW_Symmetry:
  case KW_Dilate:
  case KW_Affine: return parse_transform(p);
  case KW_Extrude: return parse_extrude(p);
  case KW_Boundary:
  case KW_CombinedBoundary:
  case KW_OrientedBoundary:
  case KW_OrientedCombinedBoundary:
  case KW_PointsOf: {
    parse__advance(p);
    Node *n = parse__node1(p, NODE_BOUNDARY, t.loc, parse__shapes(p));
    n->word = t.word;
    return as_list(n);
  }
  case KW_Split: return parse_split(p);
  case KW_BooleanUnion:
  case KW_BooleanIntersection:
  case KW_BooleanDifference:
  case KW_BooleanFragments: return parse_boolean(p);
  case KW_BooleanSection:
  case KW_ThruSections:
  case KW_Fillet:
  case KW_Chamfer:
  case KW_ShapeFromFile:
  case KW_HealShapes:
  case KW_Closest:
  case KW_Normal: return parse_unsupported(p, occ);
  case KW_Intersect: return parse_unsupported(p, "Curve is not supported: give the intersection as a point");
  default: return NULL;
  }
}
