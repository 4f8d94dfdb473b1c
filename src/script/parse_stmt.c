// parse_stmt.c - statements: what each begins with, assignments, commands
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "script/parse_int.h"

#include "script/function.h"

Node *parse__word_node(Parser *p, NodeKind kind, SrcLoc loc, uint32_t word, size_t base)
{
  Node *n = parse__collect(p, kind, loc, base);
  n->word = word;
  return n;
}

void parse__push(Parser *p, Node *n) { vec_push(&p->stack, n); }

Node *parse__tag(Parser *p)
{
  parse__expect(p, '(', "'('");
  Node *tag = parse__number(p);
  parse__expect(p, ')', "')'");
  return tag;
}

Node *parse__unsupported(Parser *p, Token t, const char *why)
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

// ---- commands ---------------------------------------------

// print -> ("Printf" | "Error" | "Warning") "(" text ["," list]... ")" [(">" | ">>") text] ";"
static Node *parse_print(Parser *p)
{
  Token t = parse__advance(p);
  if (!parse__accept(p, '(')) parse__expect(p, '[', "'('");
  parse__open(p);
  size_t base = p->stack.len;
  parse__push(p, parse__expr(p));
  parse__push(p, NULL);
  while (parse__accept(p, ',')) parse__push(p, parse__expr(p));
  if (!parse__accept(p, ')')) parse__expect(p, ']', "',' or ')'");
  parse__close(p);
  int op = parse__at(p, '>') || parse__at(p, TOK_SHIFT_RIGHT) ? parse__advance(p).kind : 0;
  if (op) p->stack.data[base + 1] = parse__expr(p);
  parse__semicolon(p);
  Node *n = parse__word_node(p, NODE_PRINT, t.loc, t.word, base);
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
    parse__push(p, parse__expr(p));
    if (!parse__accept(p, ',') && !parens) break;
  }
  if (parens && !parse__accept(p, ')')) parse__expect(p, ']', "')'");
  parse__semicolon(p);
  return parse__word_node(p, NODE_COMMAND, t.loc, t.word, base);
}

// macro_call -> "Call" (name | text) ";"
static Node *parse_call(Parser *p)
{
  Token t = parse__advance(p);
  size_t base = p->stack.len;
  parse__push(p, parse__at(p, TOK_STRING) ? parse__expr(p) : parse__name(p));
  parse__semicolon(p);
  return parse__word_node(p, NODE_COMMAND, t.loc, t.word, base);
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
  if (command->kind == NODE_BOOLEAN && command->kid[0]) return parse__node1(p, NODE_VALUE, loc, command); // a definition
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
  case KW_Background: return parse__background(p);
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
    return parse__unsupported(p, t, "is post-processing, which this program does not do");
  default: return parse_assignment(p);
  }
}

// Why a statement that begins with the word is not carried out; NULL if it is no such word.
static const char *refusal(uint32_t word)
{
  switch (word) {
  case KW_Parametric: return "Surface is not supported: only Plane Surface and Surface are";
  case KW_Sphere: return "is not supported: the plane of a face is the only geometry of surfaces here";
  case KW_Box:
  case KW_Cylinder:
  case KW_Cone:
  case KW_Torus:
  case KW_Wedge:
  case KW_ThickSolid: return "needs the OpenCASCADE kernel, which this program does not have";
  case KW_Coordinates:
  case KW_Euclidean: return "is not supported: coordinates are Cartesian here";
  case KW_Levelset:
  case KW_AdaptMesh:
  case KW_TransformMesh:
  case KW_ClassifySurfaces:
  case KW_CreateTopology:
  case KW_CreateGeometry:
  case KW_SetPartition:
  case KW_OnelabRun: return "is not supported";
  case KW_Homology:
  case KW_Cohomology:
  case KW_Betti: return "is left out: no chains are computed here";
  default: return NULL;
  }
}

// A statement that cannot be carried out, or nothing that begins one.
static Node *parse_refused(Parser *p)
{
  Token t = p->tok;
  const char *why = refusal(t.word);
  if (why) {
    parse__advance(p);
    Node *n = parse__unsupported(p, t, why);
    n->op = t.word == KW_Homology || t.word == KW_Cohomology || t.word == KW_Betti; // the mesh is good without it
    return n;
  }
  if (is_assignment(parse__peek(p).kind))
    parse__fail(p, t.loc, "'%.*s' is a word of the language and cannot be a variable", (int)t.len, t.start);
  parse__expected(p, "a statement");
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
  case KW_Volume: return parse__entity(p);
  case KW_Physical: return parse__physical(p);
  case KW_Circle:
  case KW_Ellipse:
  case KW_Spline:
  case KW_BSpline:
  case KW_Bezier:
  case KW_Nurbs:
    parse__advance(p);
    return parse__dimension(p) == 2 ? parse__surface_of_kind(p, t) : parse__definition(p, t, t.word, 0);
  case KW_Plane:
  case KW_Ruled:
    parse__advance(p);
    if (parse__at_word(p, KW_ThruSections))
      return parse__unsupported(
          p, t, "ThruSections needs the OpenCASCADE kernel, which this program does not have");
    return parse__surface_of_kind(p, t);
  case KW_Wire: parse__advance(p); return parse__definition(p, t, t.word, 1);
  case KW_Rectangle:
  case KW_Disk: parse__advance(p); return parse__definition(p, t, t.word, 2);
  case KW_PolarSphere: parse__advance(p); return parse__definition(p, t, KW_PolarSphere, 0);
  case KW_Compound: return parse__compound(p);
  case KW_Transfinite: return parse__transfinite(p);
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
  case KW_ReorientMesh:
  case KW_ReverseMesh:
  case KW_RelocateMesh:
  case KW_Degenerated: return parse__mesh_set(p);
  case KW_MeshSize:
  case KW_Characteristic: return parse__mesh_size(p);
  case KW_Periodic: return parse__periodic(p);
  case KW_Delete: return parse__delete(p, false);
  case KW_Recursive:
    parse__advance(p);
    if (parse__at_word(p, KW_Delete)) return parse__delete(p, true);
    if (parse__at_word(p, KW_Show) || parse__at_word(p, KW_Hide) || parse__at_word(p, KW_Color))
      return parse__visibility(p);
    parse__expected(p, "Delete, Show, Hide or Color after 'Recursive'");
  case KW_Show:
  case KW_Hide:
  case KW_Color: return parse__visibility(p);
  case KW_Coherence: return parse__coherence(p);
  case KW_Printf:
  case KW_Error:
  case KW_Warning: return parse_print(p);
  case KW_Field: return parse__field(p);
  case KW_BoundaryLayer: return parse__background(p);
  case KW_Plugin: return parse__plugin(p);
  case KW_DefineConstant: return parse__define_constant(p);
  case KW_Struct: {
    Node *n = parse__struct(p);
    parse__semicolon(p);
    return n;
  }
  case KW_StringToName: return parse_assignment(p);
  case KW_Call: return parse_call(p);
  case KW_SetMaxTag: return parse__set_max_tag(p);
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
  case KW_Extrude:
  case KW_Translate:
  case KW_Rotate:
  case KW_Symmetry:
  case KW_Dilate:
  case KW_Affine:
  case KW_Boundary:
  case KW_CombinedBoundary:
  case KW_OrientedBoundary:
  case KW_OrientedCombinedBoundary:
  case KW_PointsOf:
  case KW_Split:
  case KW_Intersect:
  case KW_BooleanUnion:
  case KW_BooleanIntersection:
  case KW_BooleanDifference:
  case KW_BooleanFragments:
  case KW_BooleanSection:
  case KW_ThruSections:
  case KW_Fillet:
  case KW_Chamfer:
  case KW_ShapeFromFile:
  case KW_HealShapes: return parse_value_statement(p);
  default: return parse_refused(p);
  }
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
//             | delete | visibility | coherence | field | background | view | plugin | define_constant | struct ";"
//             | print | command | macro_call | set_max_tag | assignment | transform | extrude | boundary
//             | boolean | split ";" | for | if | macro | "Return"
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
