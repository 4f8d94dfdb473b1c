// parse_stmt.c - statements: what each begins with, and the small ones
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "script/parse_int.h"

#include "script/function.h"

static Node *word_node(Parser *p, NodeKind kind, SrcLoc loc, uint32_t word, size_t base)
{
  Node *n = parse__collect(p, kind, loc, base);
  n->word = word;
  return n;
}

static void push(Parser *p, Node *n) { vec_push(&p->stack, n); }

static bool at_definition(const Parser *p) { return parse__at(p, '('); }

static Node *parse_tag(Parser *p)
{
  parse__expect(p, '(', "'('");
  Node *tag = parse__number(p);
  parse__expect(p, ')', "')'");
  return tag;
}

// ---- entities ---------------------------------------------

// definition -> kind "(" tag ")" "=" list ["Plane" vector | "In" "Sphere" list | "Knots" list "Order" number
//              | "Using" number] ";"
static Node *parse_definition(Parser *p, Token kind, uint32_t word, int op)
{
  size_t base = p->stack.len;
  push(p, parse_tag(p));
  parse__expect(p, '=', "'='");
  push(p, word == KW_Point ? parse__expr(p) : parse__list(p));
  if (parse__accept_word(p, KW_Plane)) push(p, parse__expr(p));
  if (parse__accept_word(p, KW_In)) {
    if (!parse__accept_word(p, KW_Sphere)) parse__expected(p, "'Sphere'");
    push(p, parse__list(p));
  }
  if (parse__accept_word(p, KW_Knots)) {
    push(p, parse__list(p));
    if (!parse__accept_word(p, KW_Order)) parse__expected(p, "'Order'");
    push(p, parse__number(p));
  }
  if (parse__accept_word(p, KW_Using)) {
    if (p->tok.kind == TOK_WORD && !keyword_reserved(p->tok.word)) parse__advance(p); // Using Sewing
    push(p, parse__at(p, ';') ? NULL : parse__number(p));
  }
  parse__semicolon(p);
  Node *n = word_node(p, NODE_DEFINE, kind.loc, word, base);
  n->op = (uint16_t)op;
  return n;
}

// kind -> entity | "Circle" | "Ellipse" | "Spline" | "BSpline" | "Bezier" | "Nurbs" | ("Curve" | "Line"
//        | "Surface") "Loop" | "Plane" "Surface" | "Ruled" "Surface" | "Compound" ("Spline" | "BSpline")
//        | "Rectangle" | "Disk"
// embed -> entity list "In" ("Surface" | "Volume") "{" number... "}" ";"
static Node *parse_entity(Parser *p)
{
  int dim = parse__dimension(p);
  Token t = parse__advance(p);
  if (at_definition(p)) return parse_definition(p, t, t.word, 0);
  if (p->tok.kind == TOK_WORD && dim > 0 && parse__peek(p).kind == '(' && !parse__at_word(p, KW_In)) {
    parse__advance(p); // Loop, or any other word
    return parse_definition(p, t, KW_Loop, dim);
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
static Node *parse_physical(Parser *p)
{
  Token t = parse__advance(p);
  int dim = parse__dimension(p);
  if (dim < 0) parse__expected(p, "Point, Curve, Surface or Volume after 'Physical'");
  parse__advance(p);
  size_t base = p->stack.len;
  parse__expect(p, '(', "'(' and the group's number or name");
  push(p, parse__expr(p));
  push(p, parse__accept(p, ',') ? parse__number(p) : NULL);
  parse__expect(p, ')', "')'");
  int op = p->tok.kind;
  if (op != '=' && op != TOK_ADD_TO && op != TOK_SUB_FROM) parse__expected(p, "'=', '+=' or '-='");
  parse__advance(p);
  push(p, parse__list_or_all(p));
  parse__semicolon(p);
  Node *n = parse__collect(p, NODE_PHYSICAL, t.loc, base);
  n->op = (uint16_t)dim;
  n->flags = op == '=' ? 0 : op == TOK_ADD_TO ? 1 : 2;
  return n;
}

static Node *unsupported_statement(Parser *p, Token t, const char *why)
{
  int depth = 0;
  while (p->tok.kind != TOK_END && (depth > 0 || p->tok.kind != ';')) {
    if (p->tok.kind == '{') depth++;
    if (p->tok.kind == '}') depth--;
    parse__advance(p);
  }
  parse__accept(p, ';');
  Node *n = parse__node(p, NODE_UNSUPPORTED, t.loc, 0);
  char text[256];
  snprintf(text, sizeof text, "%.*s %s", (int)MIN(t.len, (size_t)60), t.start, why);
  n->text = arena_strdup(p->arena, text);
  return n;
}

// "Plane" | "Ruled" | "BSpline" | "Bezier" ... "Surface" "(" tag ")" "=" list ";"
static Node *parse_surface_of_kind(Parser *p, Token t)
{
  if (parse__dimension(p) != 2) parse__expected(p, "'Surface'");
  parse__advance(p);
  if (t.word == KW_Plane || t.word == KW_Ruled)
    return parse_definition(p, t, t.word == KW_Plane ? KW_Plane : KW_Surface, 2);
  return unsupported_statement(p, t, "Surface is not supported: only Plane Surface and Surface are");
}

// compound -> "Compound" ("Curve" | "Surface" | "Volume") list ";"
static Node *parse_compound(Parser *p)
{
  Token t = parse__advance(p), kind = p->tok;
  if (kind.kind != TOK_WORD) parse__expected(p, "Curve, Surface, Spline or BSpline");
  if (kind.word == KW_Spline || kind.word == KW_BSpline) {
    parse__advance(p);
    return parse_definition(p, t, kind.word, 1);
  }
  int dim = parse__dimension(p);
  if (dim < 1) parse__expected(p, "Curve, Surface, Spline or BSpline");
  parse__advance(p);
  if (at_definition(p))
    return unsupported_statement(
        p, t, "geometry was removed from the language; write Compound Curve{..}; or Compound Surface{..};");
  Node *n = parse__node1(p, NODE_COMPOUND, t.loc, parse__list_or_all(p));
  n->op = (uint16_t)dim;
  parse__semicolon(p);
  return n;
}

// ---- how to mesh ---------------------------------------------

// transfinite -> "Transfinite" "Curve" list "=" number ["Using" ("Progression" | "Power" | "Bump" | "Beta")
//                 number] ";" | "Transfinite" "Surface" list ["=" list] ["Left" | "Right" | "Alternate"
//               | "AlternateRight" | "AlternateLeft"] ";" | "Transfinite" "Volume" list ["=" list] ";"
static Node *parse_transfinite(Parser *p)
{
  Token t = parse__advance(p);
  int dim = parse__dimension(p);
  if (dim < 1) parse__expected(p, "Curve, Surface or Volume after 'Transfinite'");
  parse__advance(p);
  size_t base = p->stack.len;
  uint32_t word = KW_COUNT;
  push(p, parse__list_or_all(p));
  if (dim == 1) {
    parse__expect(p, '=', "'=' and the number of nodes");
    push(p, parse__number(p));
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
    push(p, coef);
  } else {
    push(p, parse__accept(p, '=') ? parse__list(p) : NULL);
    if (p->tok.kind == TOK_WORD && p->tok.loc.line == p->last_end.line) word = parse__advance(p).word;
  }
  parse__semicolon(p);
  Node *n = word_node(p, NODE_TRANSFINITE, t.loc, word, base);
  n->op = (uint16_t)dim;
  return n;
}

// mesh_set -> ("Recombine" | "Smoother" | "MeshAlgorithm" | "MeshSizeFromBoundary" | "ReverseMesh"
//            | "Reverse" | "RelocateMesh" | "Degenerated") entity list ["=" number] ";"
static Node *parse_mesh_set(Parser *p)
{
  Token t = parse__advance(p);
  int dim = parse__dimension(p);
  if (dim < 0) parse__expected(p, "Curve or Surface");
  parse__advance(p);
  size_t base = p->stack.len;
  push(p, parse__list_or_all(p));
  bool has_value = parse__accept(p, '=');
  bool needs = t.word == KW_Smoother || t.word == KW_MeshAlgorithm || t.word == KW_MeshSizeFromBoundary;
  if (needs && !has_value) parse__expected(p, "'=' and a number");
  push(p, has_value ? parse__number(p) : NULL);
  parse__semicolon(p);
  Node *n = word_node(p, NODE_MESH_SET, t.loc, t.word, base);
  n->op = (uint16_t)dim;
  return n;
}

// mesh_size -> ("MeshSize" | "Characteristic" "Length") ["Point"] list "=" number ";"
static Node *parse_mesh_size(Parser *p)
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
static Node *parse_periodic(Parser *p)
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
  for (int i = 0; i < 5; i++) push(p, kid[i]);
  Node *n = word_node(p, NODE_PERIODIC, t.loc, word, base);
  n->op = (uint16_t)dim;
  return n;
}

// ---- deleting and showing ---------------------------------------------

// delete -> ["Recursive"] "Delete" (shapes | "Field" "[" n "]" ";" | "View" "[" n "]" ";" | "Embedded"
//            shapes | ("Physicals" | "Meshes" | "Model" | "All" | "Variables") ";" | name ";")
static Node *parse_delete(Parser *p, bool recursive)
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
static Node *parse_visibility(Parser *p)
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

// ---- fields, views ---------------------------------------------

// field -> "Field" "[" n "]" ("=" TYPE | "." OPTION ["=" (number | text | list)]) ";"
static Node *parse_field(Parser *p)
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
static Node *parse_plugin(Parser *p)
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
  push(p, parse__expr(p));
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
        push(p, parse__expr(p));
        if (!parse__accept(p, ',') && p->tok.kind != close && p->tok.kind != '}') parse__expected(p, "','");
      }
      parse__advance(p);
      item->kid[part] = parse__collect(p, NODE_LIST, type.loc, from);
      item->kid[part]->flags = NODE_IS_LIST;
    }
    parse__semicolon(p);
    push(p, item);
  }
  parse__advance(p);
  parse__close(p);
  parse__semicolon(p);
  return parse__collect(p, NODE_VIEW, loc, base);
}

// ---- parameters ---------------------------------------------

// After the value: ["," ATTRIBUTE (number | text | "{" .. "}")]... close. Only Name and ReadOnly are kept.
Node *parse__parameter_tail(Parser *p, Node *value, NodeKind kind, Node *target, SrcLoc loc, int close)
{
  Node *name = NULL, *read_only = NULL;
  while (p->tok.kind != close && !(close == ']' && parse__at(p, ')'))) {
    parse__expect(p, ',', close == '}' ? "',' or '}'" : "',' or ']'");
    if (p->tok.kind != TOK_WORD) parse__expected(p, "an attribute such as Name or Min");
    Token key = parse__advance(p);
    if (parse__at(p, '{')) { // Choices{1="one", 2}, GmshOption.. : any balanced text
      int depth = 0;
      do {
        if (p->tok.kind == TOK_END) parse__expected(p, "'}'");
        if (parse__at(p, '{')) depth++;
        if (parse__at(p, '}')) depth--;
        parse__advance(p);
      } while (depth > 0);
      continue;
    }
    Node *v = parse__expr(p);
    if (key.len == 4 && !memcmp(key.start, "Name", 4)) name = v;
    if (key.len == 8 && !memcmp(key.start, "ReadOnly", 8)) read_only = v;
  }
  parse__advance(p);
  size_t base = p->stack.len;
  if (kind == NODE_CONSTANT_ITEM) push(p, target);
  push(p, value);
  push(p, name);
  push(p, read_only);
  return parse__collect(p, kind, loc, base);
}

// constant -> name ["[" "]"] ["=" (expr | "{" expr ["," ATTRIBUTE value]... "}")]
static Node *parse_constant_item(Parser *p)
{
  Token t = p->tok;
  Node *target = parse__name(p), *value = NULL, *n;
  bool list = parse__at(p, '[') || parse__at(p, '(');
  if (list) {
    parse__advance(p);
    if (!parse__accept(p, ']')) parse__expect(p, ')', "']'");
  }
  bool braced = parse__accept(p, '=') && parse__at(p, '{');
  bool nested = braced && parse__peek(p).kind == '{';
  if (braced && (nested || !list)) {
    parse__advance(p);
    parse__open(p);
    Token first = p->tok;
    if (!parse__at(p, '}')) value = parse__expr(p);
    if (!nested && !list && parse__at(p, ',')) { // {1, 2}: a list without attributes, {1, Name ".."}: with
      size_t base = p->stack.len;
      push(p, value);
      while (parse__at(p, ',') && parse__peek(p).kind != TOK_WORD) {
        parse__advance(p);
        push(p, parse__expr(p));
      }
      if (p->stack.len > base + 1) {
        value = parse__collect(p, NODE_LIST, first.loc, base);
        value->flags = NODE_IS_LIST;
      } else {
        p->stack.len = base;
      }
    }
    n = parse__parameter_tail(p, value, NODE_CONSTANT_ITEM, target, t.loc, '}');
    parse__close(p);
  } else {
    if (p->tok.kind != ',' && p->tok.kind != ']' && p->tok.kind != ')' &&
        (braced || p->tok.kind != TOK_WORD || p->last_end.line == p->tok.loc.line))
      value = parse__expr(p);
    size_t base = p->stack.len;
    push(p, target);
    push(p, value);
    push(p, NULL);
    push(p, NULL);
    n = parse__collect(p, NODE_CONSTANT_ITEM, t.loc, base);
  }
  n->op = list;
  return n;
}

// define_constant -> "DefineConstant" "[" constant [","]... "]" ";"
Node *parse__define_constant(Parser *p)
{
  Token t = parse__advance(p);
  if (!parse__accept(p, '[')) parse__expect(p, '(', "'['");
  size_t base = p->stack.len;
  while (!parse__at(p, ']') && !parse__at(p, ')')) {
    push(p, parse_constant_item(p));
    while (parse__accept(p, ',')) continue;
  }
  parse__advance(p);
  parse__semicolon(p);
  return parse__collect(p, NODE_CONSTANTS, t.loc, base);
}

// ---- commands ---------------------------------------------

// print -> ("Printf" | "Error" | "Warning") "(" text ["," list]... ")" [(">" | ">>") text] ";"
static Node *parse_print(Parser *p)
{
  Token t = parse__advance(p);
  if (!parse__accept(p, '(')) parse__expect(p, '[', "'('");
  parse__open(p);
  size_t base = p->stack.len;
  push(p, parse__expr(p));
  push(p, NULL);
  while (parse__accept(p, ',')) push(p, parse__expr(p));
  if (!parse__accept(p, ')')) parse__expect(p, ']', "',' or ')'");
  parse__close(p);
  int op = parse__at(p, '>') || parse__at(p, TOK_SHIFT_RIGHT) ? parse__advance(p).kind : 0;
  if (op) p->stack.data[base + 1] = parse__expr(p);
  parse__semicolon(p);
  Node *n = word_node(p, NODE_PRINT, t.loc, t.word, base);
  n->op = (uint16_t)op;
  return n;
}

// command -> WORD ["("] [expr ("," expr)...] [")"] ";"
static Node *parse_command(Parser *p)
{
  Token t = parse__advance(p);
  size_t base = p->stack.len;
  bool parens = (t.word == KW_SetFactory || t.word == KW_SetNumber || t.word == KW_SetString ||
                 t.word == KW_UndefineConstant) &&
                (parse__accept(p, '(') || parse__accept(p, '['));
  while (p->tok.kind != ';' && p->tok.kind != TOK_END && p->tok.kind != ')' && p->tok.kind != ']') {
    push(p, parse__expr(p));
    if (!parse__accept(p, ',') && !parens) break;
  }
  if (parens && !parse__accept(p, ')')) parse__expect(p, ']', "')'");
  parse__semicolon(p);
  return word_node(p, NODE_COMMAND, t.loc, t.word, base);
}

// macro_call -> "Call" (name | text) ";"
static Node *parse_call(Parser *p)
{
  Token t = parse__advance(p);
  size_t base = p->stack.len;
  push(p, parse__at(p, TOK_STRING) ? parse__expr(p) : parse__name(p));
  parse__semicolon(p);
  return word_node(p, NODE_COMMAND, t.loc, t.word, base);
}

// background -> "Background" "Field" "=" number ";" | "BoundaryLayer" "Field" "=" list ";" | "Background"
//                "Mesh" "View" "[" number "]" ";"
static Node *parse_background(Parser *p)
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

// coherence -> "Coherence" ["Geometry" | "Mesh"] ";"
static Node *parse_coherence(Parser *p)
{
  Token t = parse__advance(p);
  size_t base = p->stack.len;
  uint32_t word = KW_COUNT;
  if (p->tok.kind == TOK_WORD) {
    word = parse__advance(p).word;
    if (!parse__at(p, ';')) push(p, parse__list(p)); // Coherence Point {..}
  }
  parse__semicolon(p);
  return word_node(p, NODE_COHERENCE, t.loc, word, base);
}

// set_max_tag -> "SetMaxTag" entity "(" number ")" ";"
static Node *parse_set_max_tag(Parser *p)
{
  Token t = parse__advance(p);
  int dim = parse__dimension(p);
  if (dim < 0) parse__expected(p, "Point, Curve, Surface or Volume");
  parse__advance(p);
  size_t base = p->stack.len;
  push(p, parse_tag(p));
  parse__semicolon(p);
  Node *n = word_node(p, NODE_COMMAND, t.loc, t.word, base);
  n->op = (uint16_t)dim;
  return n;
}

// ---- assignments ---------------------------------------------

static bool is_assignment(int kind)
{
  return kind == '=' || kind == TOK_ADD_TO || kind == TOK_SUB_FROM || kind == TOK_MUL_BY ||
         kind == TOK_DIV_BY;
}

static NORETURN void unknown_statement(Parser *p, Token t)
{
  if (t.len == 9 && !memcmp(t.start, "Attractor", 9))
    parse__fail(p, t.loc,
                "the short form 'Attractor Point{..} = {..}' was removed long ago; write Field[1] = Distance;"
                " and Field[2] = Threshold;");
  char word[64];
  snprintf(word, sizeof word, "%.*s", (int)MIN(t.len, sizeof word - 1), t.start);
  const char *near = function_nearest(word);
  if (near && strcmp(near, word) != 0)
    parse__fail(p, t.loc, "unknown statement '%s'; did you mean '%s'?", word, near);
  if (parse__at(p, '{') || parse__at(p, TOK_WORD) || parse__at(p, TOK_STRING) || parse__at(p, TOK_NUMBER))
    parse__fail(p, t.loc, "unknown statement '%s'", word);
  parse__expected(p, "'=' or another assignment");
}

// assignment -> target ("=" | "+=" | "-=" | "*=" | "/=") value ";" | target ("++" | "--") ";"
static Node *parse_assignment(Parser *p)
{
  Token first = p->tok;
  Node *target = parse__expr(p), *value = NULL;
  Token op = p->tok;
  if (target->kind == NODE_POSTFIX) {
    op.kind = target->op;
    target = target->kid[0];
  } else if (!is_assignment(op.kind)) {
    unknown_statement(p, first);
  } else {
    parse__advance(p);
    if (target->kind == NODE_OPTION &&
        strstr(target->text, "Color")) { // colours may be names, or lists of lists
      while (p->tok.kind != ';' && p->tok.kind != TOK_END) parse__advance(p);
    } else {
      value = parse__list_value(p);
    }
  }
  switch ((NodeKind)target->kind) {
  case NODE_NAME:
  case NODE_DYNAME:
  case NODE_S2N:
  case NODE_WHOLE:
  case NODE_INDEX:
  case NODE_SUBLIST:
  case NODE_OPTION: break;
  default: parse__fail(p, first.loc, "this cannot be assigned to");
  }
  if (target->kind == NODE_INDEX && value && node_is_list(value)) { // Pont(1) = {0, 0, 0};
    char word[64];
    snprintf(word, sizeof word, "%.*s", (int)MIN(first.len, sizeof word - 1), first.start);
    const char *near = function_nearest(word);
    if (near) parse__fail(p, first.loc, "unknown statement '%s'; did you mean '%s'?", word, near);
    parse__fail(p, value->loc, "one element of a list can only be assigned a number");
  }
  parse__semicolon(p);
  Node *n = parse__node2(p, NODE_ASSIGN, first.loc, target, value);
  n->op = (uint16_t)op.kind;
  return n;
}

static Node *parse_value_statement(Parser *p)
{
  SrcLoc loc = p->tok.loc;
  Node *command = parse__command(p);
  if (!command) {
    parse__advance(p);
    parse__expected(p, "'{' and a list of shapes");
  }
  if (command->kind == NODE_SPLIT || command->kind == NODE_UNSUPPORTED)
    parse__accept(p, ';');
  else
    parse__superfluous_semicolon(p);
  return parse__node1(p, NODE_VALUE, loc, command);
}

// ---- the statement ---------------------------------------------

static Node *parse_soft(Parser *p)
{
  int next = parse__peek(p).kind;
  bool variable = is_assignment(next) || next == '[' || next == '(' || next == '.' || next == TOK_INC ||
                  next == TOK_DEC || next == '~';
  if (variable) return parse_assignment(p);
  Token t = p->tok;
  switch (t.word) {
  case KW_Duplicata: return parse_value_statement(p);
  case KW_Background: return parse_background(p);
  case KW_View: parse__advance(p); return parse__view(p, t.loc);
  case KW_Include:
  case KW_Merge:
  case KW_MergeWithBoundingBox:
  case KW_MergeFile:
  case KW_Open:
  case KW_OpenProject:
  case KW_Save:
  case KW_Print:
  case KW_System:
  case KW_SystemCall:
  case KW_NonBlockingSystemCall:
  case KW_SetName:
  case KW_Mesh:
  case KW_Sleep:
  case KW_Draw:
  case KW_SetChanged:
  case KW_NewModel:
  case KW_BarycentricRefineMesh: return parse_command(p);
  case KW_Combine:
  case KW_Alias:
  case KW_AliasWithOptions:
  case KW_CopyOptions:
  case KW_SplitWindow:
    parse__advance(p);
    return unsupported_statement(p, t, "is post-processing, which this program does not do");
  default: return parse_assignment(p);
  }
}

static Node *parse_keyword(Parser *p)
{
  Token t = p->tok;
  switch (t.word) {
  case KW_For:
  case KW_If: return parse__block_statement(p);
  case KW_Macro:
    if (parse__peek(p).kind == TOK_WORD && parse__peek(p).word == KW_Field)
      parse__fail(
          p, t.loc,
          "'Function Field(..)' was removed long ago; write Field[1] = MathEval; Field[1].F = \"...\";");
    return parse__block_statement(p);
  case KW_EndFor: parse__fail(p, t.loc, "this EndFor has no For");
  case KW_EndIf: parse__fail(p, t.loc, "this EndIf has no If");
  case KW_Else:
  case KW_ElseIf: parse__fail(p, t.loc, "this %.*s has no If", (int)t.len, t.start);
  case KW_Return:
    parse__advance(p);
    parse__accept(p, ';');
    return parse__node(p, NODE_RETURN, t.loc, 0);
  case KW_Point:
  case KW_Line:
  case KW_Surface:
  case KW_Volume: return parse_entity(p);
  case KW_Physical: return parse_physical(p);
  case KW_Circle:
  case KW_Ellipse:
  case KW_Spline:
  case KW_BSpline:
  case KW_Bezier:
  case KW_Nurbs:
    parse__advance(p);
    return parse__dimension(p) == 2 ? parse_surface_of_kind(p, t) : parse_definition(p, t, t.word, 0);
  case KW_Plane:
  case KW_Ruled:
    parse__advance(p);
    if (parse__at_word(p, KW_ThruSections))
      return unsupported_statement(
          p, t, "ThruSections needs the OpenCASCADE kernel, which this program does not have");
    return parse_surface_of_kind(p, t);
  case KW_Rectangle:
  case KW_Disk: parse__advance(p); return parse_definition(p, t, t.word, 2);
  case KW_Parametric:
    parse__advance(p);
    return unsupported_statement(p, t, "Surface is not supported: only Plane Surface and Surface are");
  case KW_Sphere:
  case KW_PolarSphere:
    parse__advance(p);
    return unsupported_statement(
        p, t, "is not supported: the plane of a face is the only geometry of surfaces here");
  case KW_Box:
  case KW_Cylinder:
  case KW_Cone:
  case KW_Torus:
  case KW_Wedge:
  case KW_Wire:
  case KW_ThickSolid:
    parse__advance(p);
    return unsupported_statement(p, t, "needs the OpenCASCADE kernel, which this program does not have");
  case KW_Coordinates:
  case KW_Euclidean:
    parse__advance(p);
    return unsupported_statement(p, t, "is not supported: coordinates are Cartesian here");
  case KW_Levelset: parse__advance(p); return unsupported_statement(p, t, "is not supported");
  case KW_Compound: return parse_compound(p);
  case KW_Transfinite: return parse_transfinite(p);
  case KW_TransfQuadTri: {
    parse__advance(p);
    Node *n = parse__node2(p, NODE_TRANSFINITE, t.loc, parse__list_or_all(p), NULL);
    n->op = 3;
    n->word = KW_COUNT;
    parse__semicolon(p);
    return n;
  }
  case KW_Recombine:
  case KW_Smoother:
  case KW_MeshAlgorithm:
  case KW_MeshSizeFromBoundary:
  case KW_ReverseMesh:
  case KW_RelocateMesh:
  case KW_Degenerated: return parse_mesh_set(p);
  case KW_MeshSize:
  case KW_Characteristic: return parse_mesh_size(p);
  case KW_Periodic: return parse_periodic(p);
  case KW_Delete: return parse_delete(p, false);
  case KW_Recursive:
    parse__advance(p);
    if (parse__at_word(p, KW_Delete)) return parse_delete(p, true);
    if (parse__at_word(p, KW_Show) || parse__at_word(p, KW_Hide) || parse__at_word(p, KW_Color))
      return parse_visibility(p);
    parse__expected(p, "Delete, Show, Hide or Color after 'Recursive'");
  case KW_Show:
  case KW_Hide:
  case KW_Color: return parse_visibility(p);
  case KW_Coherence: return parse_coherence(p);
  case KW_Printf:
  case KW_Error:
  case KW_Warning: return parse_print(p);
  case KW_Field: return parse_field(p);
  case KW_BoundaryLayer: return parse_background(p);
  case KW_Plugin: return parse_plugin(p);
  case KW_DefineConstant: return parse__define_constant(p);
  case KW_StringToName: return parse_assignment(p);
  case KW_Call: return parse_call(p);
  case KW_SetMaxTag: return parse_set_max_tag(p);
  case KW_SetFactory:
  case KW_SetNumber:
  case KW_SetString:
  case KW_UndefineConstant:
  case KW_Exit:
  case KW_Abort:
  case KW_SyncModel:
  case KW_BoundingBox:
  case KW_RefineMesh:
  case KW_RecombineMesh:
  case KW_SetOrder:
  case KW_OptimizeMesh:
  case KW_RenumberMeshNodes:
  case KW_RenumberMeshElements:
  case KW_PartitionMesh:
  case KW_UnsplitWindow: return parse_command(p);
  case KW_DefineStruct:
  case KW_AdaptMesh:
  case KW_TransformMesh:
  case KW_ClassifySurfaces:
  case KW_CreateTopology:
  case KW_CreateGeometry:
  case KW_SetPartition:
  case KW_Homology:
  case KW_Cohomology:
  case KW_Betti:
  case KW_OnelabRun: parse__advance(p); return unsupported_statement(p, t, "is not supported");
  default: break;
  }
  if (t.word == KW_Extrude || t.word == KW_Translate || t.word == KW_Rotate || t.word == KW_Symmetry ||
      t.word == KW_Dilate || t.word == KW_Affine || t.word == KW_Boundary || t.word == KW_CombinedBoundary ||
      t.word == KW_OrientedBoundary || t.word == KW_OrientedCombinedBoundary || t.word == KW_PointsOf ||
      t.word == KW_Split || t.word == KW_Intersect || t.word == KW_BooleanUnion ||
      t.word == KW_BooleanIntersection || t.word == KW_BooleanDifference || t.word == KW_BooleanFragments ||
      t.word == KW_BooleanSection || t.word == KW_ThruSections || t.word == KW_Fillet ||
      t.word == KW_Chamfer || t.word == KW_ShapeFromFile || t.word == KW_HealShapes)
    return parse_value_statement(p);
  if (is_assignment(parse__peek(p).kind))
    parse__fail(p, t.loc, "'%.*s' is a word of the language and cannot be a variable", (int)t.len, t.start);
  parse__expected(p, "a statement");
}

// A line of <<<<<<<, ======= or >>>>>>>; only the first is reported.
static Node *parse_merge_mark(Parser *p)
{
  Token t = p->tok;
  while (p->tok.kind != TOK_END && p->tok.loc.line == t.loc.line) parse__advance(p);
  bool again = p->merge_marks;
  p->merge_marks = true;
  Node *n = parse__node(p, again ? NODE_BLOCK : NODE_UNSUPPORTED, t.loc, 0);
  n->text = "the marks of a merge conflict were left in this file by a version control program";
  return n;
}

// statement -> definition | physical | embed | compound | transfinite | mesh_set | mesh_size | periodic
//             | delete | visibility | coherence | field | background | view | plugin | define_constant
//             | print | command | macro_call | set_max_tag | assignment | transform | extrude | boundary
//             | split ";" | for | if | macro | "Return"
Node *parse__statement(Parser *p)
{
  Token t = p->tok;
  if (t.kind == ';') {
    p->last_end.line = t.loc.line;
    parse__superfluous_semicolon(p);
    return parse__node(p, NODE_BLOCK, t.loc, 0);
  }
  if (t.kind == '}' && p->stray_braces > 0) {
    p->stray_braces--;
    parse__advance(p);
    return parse__node(p, NODE_BLOCK, t.loc, 0);
  }
  p->stray_braces = 0;
  if (t.kind == TOK_SHIFT_LEFT || t.kind == TOK_SHIFT_RIGHT || t.kind == TOK_EQ) return parse_merge_mark(p);
  if (t.kind != TOK_WORD) parse__expected(p, "a statement");
  if (t.word >= KW_COUNT) return parse_assignment(p);
  return keyword_reserved(t.word) ? parse_keyword(p) : parse_soft(p);
}
