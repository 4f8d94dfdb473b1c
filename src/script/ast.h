// ast.h - the syntax tree: nodes, what their kids are, and who makes and prints them
// SPDX-License-Identifier: MIT
#ifndef SCRIPT_AST_H
#define SCRIPT_AST_H

#include "base/base.h"
#include "base/diag.h"
#include "base/str.h"
#include "script/token.h"

// Kids in order after each kind; [x] may be NULL, x... repeats. `word` and `op` are keywords unless said otherwise.
#define NODE_KINDS(X)                                                                           \
  /* values */                                                                                  \
  X(NUMBER)      /* number */                                                                   \
  X(STRING)      /* text */                                                                     \
  X(NAME)        /* word: any identifier */                                                     \
  X(DYNAME)      /* name~{expr}: NAME expr... */                                                \
  X(S2N)         /* StringToName[text]: text */                                                 \
  X(SCOPED)      /* space::name; word = space; op = 1 DimNameSpace, 2 NameStruct: [expr] */     \
  X(MEMBER)      /* S.a where S is not plain, text = member; S.a itself is an OPTION: name */   \
  X(WHOLE)       /* x[]: name */                                                                \
  X(INDEX)       /* x[i]: name expr */                                                          \
  X(SUBLIST)     /* x[{i,j}]: name list */                                                      \
  X(LENGTH)      /* #x[]: name */                                                               \
  X(OPTION)      /* text = "Category.Key": [index] */                                     \
  X(FIELD_OPTION)/* Field[n].Key, text = key: n */                                              \
  X(PLUGIN_OPTION)/* Plugin(Name).Key, text = "Name.Key" */                                     \
  X(POSTFIX)     /* x++, op = token: target */                                                  \
  X(UNARY)       /* op = '-' '!': expr */                                                       \
  X(BINARY)      /* op = token: left right */                                                   \
  X(TERNARY)     /* condition yes no */                                                         \
  X(LIST)        /* item... */                                                                  \
  X(RANGE)       /* from to [step] */                                                           \
  X(ALL)         /* {:} and "*" */                                                              \
  X(CALL)        /* word = function, op = its function_index: argument... (a NAME for Exists) */                         \
  X(CONSTANT)    /* word = newp, Cpu, ... */                                                    \
  X(PARAMETER)   /* DefineNumber, DefineString: value [name] [read-only] */                     \
  X(ENTITIES)    /* Point{..}; op = dimension, LIST_PHYSICAL: list */                           \
  X(IN_BOX)      /* Point In BoundingBox{..}; op = dimension: list of 6 */                      \
  X(BOX_OF)      /* BoundingBox Surface{..}; op = dimension: list */                            \
  X(SHAPES)      /* { Point{..}; .. }: SHAPE or command... */                                   \
  X(SHAPE)       /* op = dimension, LIST_PHYSICAL: list */                                      \
  X(TRANSFORM)   /* word = Translate Rotate Symmetry Dilate Affine Duplicata: [a] [b] [c] SHAPES */ \
  X(EXTRUDE)     /* op = 1 translation, 2 rotation, 3 both, 0 layer: [t] [axis] [point] [angle] SHAPES [LAYERS] [recombine] */ \
  X(LAYERS)      /* counts [heights] */                                                         \
  X(BOUNDARY)    /* word = Boundary, CombinedBoundary, ..., PointsOf: SHAPES */                 \
  X(BOOLEAN)     /* word = BooleanUnion ...; op = 1 drop objects, 2 tools: [tag] SHAPES SHAPES */ \
  X(SPLIT)       /* Split Curve c Point {p}: c points */                                        \
  /* statements */                                                                              \
  X(ASSIGN)      /* op = token of =, +=, ..., ++: target [value] */                             \
  X(VALUE)       /* a command as statement: TRANSFORM EXTRUDE BOUNDARY BOOLEAN SPLIT */            \
  X(DEFINE)      /* entity; word = its kind: tag value [a] [b] */                               \
  X(PHYSICAL)    /* op = dimension, flags = token of =, += or -= less 256: [name] [tag] list */ \
  X(EMBED)       /* op = dimension: list faces; word = where */                                 \
  X(MESH_SIZE)   /* list expr */                                                                \
  X(TRANSFINITE) /* op = dimension, word = law or arrangement: list [count or corners] [coef] */\
  X(MESH_SET)    /* word = Recombine Smoother MeshAlgorithm ...; op = dimension: list [expr] */ \
  X(PERIODIC)    /* op = dimension: slaves masters [a] [b] [c]; word = transform or 0 */        \
  X(COMPOUND)    /* op = dimension: list */                                                     \
  X(DELETE)      /* word = what (0: shapes); op = 1 recursive: [SHAPES or expr] */              \
  X(VISIBILITY)  /* word = Show Hide Color: [SHAPES or list] */                                 \
  X(COHERENCE)   /* word of the argument or 0 */                                                \
  X(PRINT)       /* word = Printf Error Warning; op = '>', >> or 0: format [file] argument... */\
  X(FIELD)       /* Field[n] = Type; text = type: n */                                          \
  X(FIELD_USE)   /* word = Background, BoundaryLayer: expr */                                   \
  X(BACKGROUND_VIEW) /* index */                                                                \
  X(VIEW)        /* name VIEW_ITEM... */                                                        \
  X(VIEW_ITEM)   /* text = ST, SL, ...: coordinates values */                                   \
  X(CONSTANTS)   /* DefineConstant: CONSTANT_ITEM... */                                         \
  X(CONSTANT_ITEM)/* op = 1 for l[]: target [value] [name] [read-only] */                       \
  X(STRUCT)      /* also a value, its number; op = STRUCT_ flags: name STRUCT_ITEM... */        \
  X(STRUCT_ITEM) /* text = member: [value] */                                                   \
  X(COMMAND)     /* word = Save Merge Include Mesh ...: argument... */                          \
  X(BLOCK)       /* statement... */                                                             \
  X(FOR)         /* [name] from to [step] BLOCK */                                              \
  X(IF)          /* (condition BLOCK)... [BLOCK] */                                             \
  X(MACRO)       /* name BLOCK */                                                               \
  X(RETURN)                                                                                     \
  X(UNSUPPORTED) /* text = the message */                                                       \
  X(FAULT)       /* a syntax error inside a block, reported when it is reached; text */

typedef enum {
#define X(kind) NODE_##kind,
  NODE_KINDS(X)
#undef X
} NodeKind;

enum { NODE_IS_LIST = 1, LIST_PHYSICAL = 2, FAULT_REPORTED = 4 };
enum { STRUCT_APPEND = 1, STRUCT_ENUM = 2 };

typedef struct Node Node;
struct Node {
  uint8_t kind, flags;
  uint16_t op;
  uint32_t height : 16, unused : 16;
  uint32_t n; // kids
  SrcLoc loc;
  union {
    double number;
    const char *text; // NUL-terminated, in the tree's arena
    uint32_t word;
  };
  Node *kid[];
};

static inline bool node_is_list(const Node *n) { return n->flags & NODE_IS_LIST; }
const char *node_kind_name(NodeKind kind); // as node_print writes it
// Append the tree as one S-expression.
void node_print(const Node *n, const Words *words, Str *out);

#endif
