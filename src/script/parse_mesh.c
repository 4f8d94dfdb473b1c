// parse_mesh.c - statements about meshing: attributes, fields, views
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "script/parse_int.h"

// ---- how to mesh ---------------------------------------------

// transfinite -> "Transfinite" "Curve" list "=" number ["Using" ("Progression" | "Power" | "Bump" | "Beta")
//                 number] ";" | "Transfinite" "Surface" list ["=" list] ["Left" | "Right" | "Alternate"
//               | "AlternateRight" | "AlternateLeft"] ";" | "Transfinite" "Volume" list ["=" list] ";"
Node *parse__transfinite(Parser *p)
{
  Token t = parse__advance(p);
  int dim = parse__dimension(p);
  if (dim < 1) parse__expected(p, "Curve, Surface or Volume after 'Transfinite'");
  parse__advance(p);
  size_t base = p->stack.len;
  uint32_t word = KW_COUNT;
  parse__push(p, parse__list_or_all(p));
  if (dim == 1) {
    parse__expect(p, '=', "'=' and the number of nodes");
    parse__push(p, parse__number(p));
    Node *coef = NULL;
    if (parse__accept_word(p, KW_Using)) {
      if (p->tok.kind != TOK_WORD) parse__expected(p, "Progression, Bump or Beta");
      Token law = parse__advance(p);
      word = law.word;
      if (word != KW_Progression && word != KW_Power && word != KW_Bump && word != KW_Beta &&
          word != KW_Progression_HWall && word != KW_Bump_HWall && word != KW_Beta_HWall)
        parse__fail(p, law.loc, "unknown law '%.*s': Progression, Bump or Beta",
                    (int)MIN(law.len, (size_t)60), law.start);
      coef = parse__number(p);
    }
    parse__push(p, coef);
  } else {
    parse__push(p, parse__accept(p, '=') ? parse__list(p) : NULL);
    if (p->tok.kind == TOK_WORD && p->tok.loc.line == p->last_end.line) word = parse__advance(p).word;
  }
  parse__semicolon(p);
  Node *n = parse__word_node(p, NODE_TRANSFINITE, t.loc, word, base);
  n->op = (uint16_t)dim;
  return n;
}

// mesh_set -> ("Recombine" | "Smoother" | "MeshAlgorithm" | "MeshSizeFromBoundary" | "ReverseMesh"
//            | "Reverse" | "ReorientMesh" | "RelocateMesh" | "Degenerated") entity list ["=" number] ";"
Node *parse__mesh_set(Parser *p)
{
  Token t = parse__advance(p);
  int dim = parse__dimension(p);
  if (dim < 0) parse__expected(p, "Curve or Surface");
  parse__advance(p);
  size_t base = p->stack.len;
  parse__push(p, parse__list_or_all(p));
  bool has_value = parse__accept(p, '=');
  bool needs = t.word == KW_Smoother || t.word == KW_MeshAlgorithm || t.word == KW_MeshSizeFromBoundary;
  if (needs && !has_value) parse__expected(p, "'=' and a number");
  parse__push(p, has_value ? parse__number(p) : NULL);
  parse__semicolon(p);
  Node *n = parse__word_node(p, NODE_MESH_SET, t.loc, t.word, base);
  n->op = (uint16_t)dim;
  return n;
}

// mesh_size -> ("MeshSize" | "Characteristic" "Length") ["Point"] list "=" number ";"
Node *parse__mesh_size(Parser *p)
{
  Token t = parse__advance(p);
  if (t.word == KW_Characteristic && !parse__accept_word(p, KW_Length)) parse__expected(p, "'Length'");
  if (parse__at_word(p, KW_Field))
    parse__fail(p, t.loc, "'Characteristic Length Field' was removed long ago; write Background Field = n;");
  parse__accept_word(p, KW_Point); // Characteristic Length Point{..} is met too
  Node *list = parse__list_or_all(p);
  parse__expect(p, '=', "'=' and the mesh size");
  Node *value = parse__number(p);
  parse__semicolon(p);
  return parse__node2(p, NODE_MESH_SIZE, t.loc, list, value);
}

// periodic -> "Periodic" ("Curve" | "Surface") list [list] "=" list [list] ["Translate" vector | "Rotate"
//              "{" vector "," vector "," number "}" | "Affine" list] ";"
Node *parse__periodic(Parser *p)
{
  Token t = parse__advance(p);
  int dim = parse__dimension(p);
  if (dim < 1) parse__expected(p, "Curve or Surface after 'Periodic'");
  parse__advance(p);
  size_t base = p->stack.len;
  Node *kid[5] = {NULL};
  uint32_t word = KW_COUNT;
  kid[0] = parse__list(p);
  if (dim == 2 && parse__at(p, '{')) kid[2] = parse__list(p);
  parse__expect(p, '=', "'='");
  kid[1] = parse__list(p);
  if (dim == 2 && parse__at(p, '{')) kid[3] = parse__list(p);
  if (parse__at_word(p, KW_Translate) || parse__at_word(p, KW_Rotate) || parse__at_word(p, KW_Affine)) {
    word = parse__advance(p).word;
    if (word == KW_Rotate) {
      parse__expect(p, '{', "'{'");
      for (int i = 2; i < 5; i++) {
        kid[i] = i < 4 ? parse__expr(p) : parse__number(p);
        if (i < 4) parse__expect(p, ',', "','");
      }
      parse__expect(p, '}', "'}'");
    } else {
      kid[2] = parse__expr(p);
      kid[3] = NULL;
    }
  }
  parse__semicolon(p);
  for (int i = 0; i < 5; i++) parse__push(p, kid[i]);
  Node *n = parse__word_node(p, NODE_PERIODIC, t.loc, word, base);
  n->op = (uint16_t)dim;
  return n;
}

// ---- fields, views ---------------------------------------------

// field -> "Field" "[" n "]" ("=" TYPE | "." OPTION ["=" (number | text | list)]) ";"
Node *parse__field(Parser *p)
{
  Token t = parse__advance(p);
  if (!parse__accept(p, '[')) parse__expect(p, '(', "'[' and the field's number");
  Node *id = parse__number(p);
  if (!parse__accept(p, ']')) parse__expect(p, ')', "']'");
  if (parse__accept(p, '=')) {
    if (p->tok.kind != TOK_WORD) parse__expected(p, "the type of the field");
    Token type = parse__advance(p);
    Node *n = parse__node1(p, NODE_FIELD, t.loc, id);
    n->text = parse__text(p, type);
    parse__semicolon(p);
    return n;
  }
  parse__expect(p, '.', "'=' and a type, or '.' and an option");
  if (p->tok.kind != TOK_WORD) parse__expected(p, "the name of a field's option");
  Token key = parse__advance(p);
  Node *target = parse__node1(p, NODE_FIELD_OPTION, key.loc, id), *value = NULL;
  target->text = parse__text(p, key);
  if (parse__accept(p, '=')) value = parse__expr(p);
  parse__semicolon(p);
  Node *n = parse__node2(p, NODE_ASSIGN, t.loc, target, value);
  n->op = '=';
  return n;
}

// plugin -> "Plugin" "(" NAME ")" "." (OPTION "=" expr | "Run") ";"
Node *parse__plugin(Parser *p)
{
  Token t = parse__advance(p);
  parse__expect(p, '(', "'('");
  if (p->tok.kind != TOK_WORD) parse__expected(p, "the name of a plugin");
  Token name = parse__advance(p);
  parse__expect(p, ')', "')'");
  parse__expect(p, '.', "'.'");
  if (p->tok.kind != TOK_WORD) parse__expected(p, "an option of the plugin, or Run");
  Token key = parse__advance(p);
  Node *target = parse__node(p, NODE_PLUGIN_OPTION, t.loc, 0), *value = NULL;
  char *text = arena_alloc(p->arena, name.len + key.len + 2);
  snprintf(text, name.len + key.len + 2, "%.*s.%.*s", (int)name.len, name.start, (int)key.len, key.start);
  target->text = text;
  if (parse__accept(p, '=')) value = parse__expr(p);
  parse__semicolon(p);
  Node *n = parse__node2(p, NODE_ASSIGN, t.loc, target, value);
  n->op = '=';
  return n;
}

// view -> "View" text "{" (TYPE "(" number... ")" "{" number... "}" ";")... "}" ";"
Node *parse__view(Parser *p, SrcLoc loc)
{
  size_t base = p->stack.len;
  parse__push(p, parse__expr(p));
  parse__expect(p, '{', "'{'");
  parse__open(p);
  while (!parse__at(p, '}')) {
    if (p->tok.kind != TOK_WORD) parse__expected(p, "an element of the view such as ST(..){..};, or '}'");
    Token type = parse__advance(p);
    Node *item = parse__node(p, NODE_VIEW_ITEM, type.loc, 2);
    item->text = parse__text(p, type);
    for (int part = 0; part < 2; part++) {
      int close = part ? '}' : ')';
      if (!part && !parse__at(p, '(')) continue; // INTERPOLATION_SCHEME {..}, TIME {..}
      parse__expect(p, part ? '{' : '(', part ? "'{'" : "'('");
      size_t from = p->stack.len;
      while (p->tok.kind != close) {
        if (parse__accept(p, '{') || parse__accept(p, '}')) continue;
        parse__push(p, parse__expr(p));
        if (!parse__accept(p, ',') && p->tok.kind != close && p->tok.kind != '}') parse__expected(p, "','");
      }
      parse__advance(p);
      item->kid[part] = parse__collect(p, NODE_LIST, type.loc, from);
      item->kid[part]->flags = NODE_IS_LIST;
    }
    parse__semicolon(p);
    parse__push(p, item);
  }
  parse__advance(p);
  parse__close(p);
  parse__semicolon(p);
  return parse__collect(p, NODE_VIEW, loc, base);
}

// background -> "Background" "Field" "=" number ";" | "BoundaryLayer" "Field" "=" list ";" | "Background"
//                "Mesh" "View" "[" number "]" ";"
Node *parse__background(Parser *p)
{
  Token t = parse__advance(p);
  if (t.word == KW_BoundaryLayer || parse__at_word(p, KW_Field)) {
    if (!parse__accept_word(p, KW_Field)) parse__expected(p, "'Field'");
    parse__expect(p, '=', "'='");
    Node *n = parse__node1(p, NODE_FIELD_USE, t.loc, parse__list(p));
    n->word = t.word;
    parse__semicolon(p);
    return n;
  }
  if (!parse__accept_word(p, KW_Mesh)) parse__expected(p, "'Field' or 'Mesh View[..]'");
  if (!parse__accept_word(p, KW_View)) parse__expected(p, "'View'");
  parse__expect(p, '[', "'['");
  Node *n = parse__node1(p, NODE_BACKGROUND_VIEW, t.loc, parse__number(p));
  parse__expect(p, ']', "']'");
  parse__semicolon(p);
  return n;
}
