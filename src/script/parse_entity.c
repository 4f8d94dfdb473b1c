// parse_entity.c - statements about entities: definitions, groups, deletion
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "script/parse_int.h"

static bool at_definition(const Parser *p) { return parse__at(p, '('); }

// ---- entities ---------------------------------------------

// definition -> kind "(" tag ")" "=" list ["Plane" vector | "In" "Sphere" list | "Knots" list "Order" number
//              | "Using" number] ";"
Node *parse__definition(Parser *p, Token kind, uint32_t word, int op)
{
  size_t base = p->stack.len;
  parse__push(p, parse__tag(p));
  parse__expect(p, '=', "'='");
  parse__push(p, word == KW_Point ? parse__expr(p) : parse__list(p));
  if (parse__accept_word(p, KW_Plane)) parse__push(p, parse__expr(p));
  if (parse__accept_word(p, KW_In)) {
    if (!parse__accept_word(p, KW_Sphere)) parse__expected(p, "'Sphere'");
    parse__push(p, parse__list(p));
  }
  if (parse__accept_word(p, KW_Knots)) {
    parse__push(p, parse__list(p));
    if (!parse__accept_word(p, KW_Order)) parse__expected(p, "'Order'");
    parse__push(p, parse__number(p));
  }
  if (parse__accept_word(p, KW_Using)) {
    if (p->tok.kind == TOK_WORD && !keyword_reserved(p->tok.word)) parse__advance(p); // Using Sewing
    parse__push(p, parse__at(p, ';') ? NULL : parse__number(p));
  }
  parse__semicolon(p);
  Node *n = parse__word_node(p, NODE_DEFINE, kind.loc, word, base);
  n->op = (uint16_t)op;
  return n;
}

// kind -> entity | "Circle" | "Ellipse" | "Spline" | "BSpline" | "Bezier" | "Nurbs" | ("Curve" | "Line"
//        | "Surface") "Loop" | "Plane" "Surface" | "Ruled" "Surface" | "Compound" ("Spline" | "BSpline")
//        | "Rectangle" | "Disk" | "PolarSphere" | "Wire"
// embed -> entity list "In" ("Surface" | "Volume") "{" number... "}" ";"
Node *parse__entity(Parser *p)
{
  int dim = parse__dimension(p);
  Token t = parse__advance(p);
  if (at_definition(p)) return parse__definition(p, t, t.word, 0);
  if (p->tok.kind == TOK_WORD && dim > 0 && parse__peek(p).kind == '(' && !parse__at_word(p, KW_In)) {
    parse__advance(p); // Loop, or any other word
    return parse__definition(p, t, KW_Loop, dim);
  }
  Node *list = parse__list_or_all(p);
  if (!parse__accept_word(p, KW_In)) parse__expected(p, "'In' (to embed) or '(tag) =' (to define)");
  int where = parse__dimension(p);
  if (where < 2) parse__expected(p, "'Surface' or 'Volume'");
  parse__advance(p);
  Node *faces = parse__list(p);
  parse__semicolon(p);
  Node *n = parse__node2(p, NODE_EMBED, t.loc, list, faces);
  n->op = (uint16_t)dim;
  n->word = where == 2 ? KW_Surface : KW_Volume;
  return n;
}

// physical -> "Physical" entity "(" (number | text ["," number]) ")" ("=" | "+=" | "-=") list ";"
Node *parse__physical(Parser *p)
{
  Token t = parse__advance(p);
  int dim = parse__dimension(p);
  if (dim < 0) parse__expected(p, "Point, Curve, Surface or Volume after 'Physical'");
  parse__advance(p);
  size_t base = p->stack.len;
  parse__expect(p, '(', "'(' and the group's number or name");
  parse__push(p, parse__expr(p));
  parse__push(p, parse__accept(p, ',') ? parse__number(p) : NULL);
  parse__expect(p, ')', "')'");
  int op = p->tok.kind;
  if (op != '=' && op != TOK_ADD_TO && op != TOK_SUB_FROM) parse__expected(p, "'=', '+=' or '-='");
  parse__advance(p);
  parse__push(p, parse__list_or_all(p));
  parse__semicolon(p);
  Node *n = parse__collect(p, NODE_PHYSICAL, t.loc, base);
  n->op = (uint16_t)dim;
  n->flags = op == '=' ? 0 : op == TOK_ADD_TO ? 1 : 2;
  return n;
}

// "Plane" | "Ruled" | "BSpline" | "Bezier" ... "Surface" "(" tag ")" "=" list ";"
Node *parse__surface_of_kind(Parser *p, Token t)
{
  if (parse__dimension(p) != 2) parse__expected(p, "'Surface'");
  parse__advance(p);
  if (t.word == KW_Plane || t.word == KW_Ruled)
    return parse__definition(p, t, t.word == KW_Plane ? KW_Plane : KW_Surface, 2);
  return parse__unsupported(p, t, "Surface is not supported: only Plane Surface and Surface are");
}

// compound -> "Compound" ("Curve" | "Surface" | "Volume") list ";"
Node *parse__compound(Parser *p)
{
  Token t = parse__advance(p), kind = p->tok;
  if (kind.kind != TOK_WORD) parse__expected(p, "Curve, Surface, Spline or BSpline");
  if (kind.word == KW_Spline || kind.word == KW_BSpline) {
    parse__advance(p);
    return parse__definition(p, t, kind.word, 1);
  }
  int dim = parse__dimension(p);
  if (dim < 1) parse__expected(p, "Curve, Surface, Spline or BSpline");
  parse__advance(p);
  if (at_definition(p))
    return parse__unsupported(
        p, t, "geometry was removed from the language; write Compound Curve{..}; or Compound Surface{..};");
  Node *n = parse__node1(p, NODE_COMPOUND, t.loc, parse__list_or_all(p));
  n->op = (uint16_t)dim;
  parse__semicolon(p);
  return n;
}

// ---- deleting and showing ---------------------------------------------

// delete -> ["Recursive"] "Delete" (shapes | "Field" "[" n "]" ";" | "View" "[" n "]" ";" | "Embedded"
//            shapes | ("Physicals" | "Meshes" | "Model" | "All" | "Variables") ";" | name ";")
Node *parse__delete(Parser *p, bool recursive)
{
  Token t = parse__advance(p);
  Node *what = NULL;
  uint32_t word = KW_COUNT;
  if (parse__at(p, '{')) {
    what = parse__shapes(p);
    parse__superfluous_semicolon(p);
  } else {
    Token name = p->tok;
    if (name.kind != TOK_WORD) parse__expected(p, "shapes in braces, or what to delete");
    word = name.word;
    if (word == KW_Field || (word == KW_View && parse__peek(p).kind == '[')) {
      parse__advance(p);
      parse__expect(p, '[', "'['");
      what = parse__number(p);
      parse__expect(p, ']', "']'");
    } else if (word == KW_Embedded) {
      parse__advance(p);
      what = parse__shapes(p);
      parse__accept(p, ';');
    } else if (keyword_reserved(word)) {
      parse__expected(p, "shapes in braces, or what to delete");
    } else {
      what = parse__name(p);
      if (parse__accept(p, '[')) parse__expect(p, ']', "']'");
      if (p->tok.kind == TOK_WORD) parse__advance(p); // Delete Empty Views, Delete Physicals all
    }
    if (word != KW_Embedded) parse__semicolon(p);
  }
  Node *n = parse__node1(p, NODE_DELETE, t.loc, what);
  n->word = word;
  n->op = recursive;
  return n;
}

// visibility -> ["Recursive"] (("Show" | "Hide") (shapes | list) | "Color" (NAME | list) shapes)
Node *parse__visibility(Parser *p)
{
  Token t = parse__advance(p);
  Node *what = NULL;
  if (t.word == KW_Color) { // a name, or {r,g,b[,a]}
    if (!parse__accept(p, '{')) {
      parse__advance(p);
    } else {
      while (p->tok.kind != '}' && p->tok.kind != TOK_END) parse__advance(p);
      parse__expect(p, '}', "'}'");
    }
    what = parse__shapes(p);
  } else if (parse__at(p, TOK_STRING)) {
    what = parse__list_or_all(p);
    parse__semicolon(p);
  } else if (parse__at(p, '{') && parse__peek(p).kind == TOK_RANGE) {
    what = parse__list_or_all(p);
    parse__accept(p, ';');
  } else {
    what = parse__shapes(p);
  }
  parse__accept(p, ';');
  Node *n = parse__node1(p, NODE_VISIBILITY, t.loc, what);
  n->word = t.word;
  return n;
}

// coherence -> "Coherence" ["Geometry" | "Mesh" | "Point" list] ";"
Node *parse__coherence(Parser *p)
{
  Token t = parse__advance(p);
  size_t base = p->stack.len;
  uint32_t word = KW_COUNT;
  if (p->tok.kind == TOK_WORD) {
    word = parse__advance(p).word;
    if (word == KW_Point) parse__push(p, parse__list(p));
  }
  parse__semicolon(p);
  return parse__word_node(p, NODE_COHERENCE, t.loc, word, base);
}

// set_max_tag -> "SetMaxTag" entity "(" number ")" ";"
Node *parse__set_max_tag(Parser *p)
{
  Token t = parse__advance(p);
  int dim = parse__dimension(p);
  if (dim < 0) parse__expected(p, "Point, Curve, Surface or Volume");
  parse__advance(p);
  size_t base = p->stack.len;
  parse__push(p, parse__tag(p));
  parse__semicolon(p);
  Node *n = parse__word_node(p, NODE_COMMAND, t.loc, t.word, base);
  n->op = (uint16_t)dim;
  return n;
}
