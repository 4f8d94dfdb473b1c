# limits.py - scripts that would not end, or would take all memory: one file each into the current folder.
# Prints a line for each: name, exit status, a part of the message (each separated by a tab).
SPLIT = "Point(1)={0,0,0};Point(2)={1,0,0};Line(1)={1,2};"
ENDS = "does not come to an end"
DEEP = "nested too deeply"


def loop(body, head="For i In {1:1e7}"):
    return "%s\n%s\nEndFor\n" % (head, body)


CASES = [
    # loops
    ("step_0", "For i In {1:2:0} EndFor", 1, "step"),
    ("step_unknown", "a = 0;\n" + loop("x = 1;", "For i In {1:2:a}"), 1, "step"),
    ("long_loop", loop("x = i;", "For i In {1:1e12}"), 1, "would run 1000000000000 times"),
    ("endless_bound", loop("x = i;", "For i In {1:1e400}"), 1, ""),
    ("tiny_step", loop("x = i;", "For i In {0:1:1e-18}"), 1, "would run"),
    ("loops_in_loops", loop(loop(loop("x = i;", "For k In {1:10000}"), "For j In {1:10000}"), "For i In {1:10000}"), 1, ENDS),
    ("variable_set_back", loop("i = 1;", "For i In {1:2}"), 1, ENDS),
    ("macro_of_itself", "Macro f\nCall f;\nReturn\nCall f;", 1, "call one another too deeply"),
    ("macros_of_one_another", "Macro f\nCall g;\nReturn\nMacro g\nCall f;\nReturn\nCall f;", 1, "call one another too deeply"),
    ("loop_of_macros", "Macro f\n" + loop("x = i;") + "Return\n" + loop("Call f;", "For k In {1:1e7}"), 1, ENDS),
    ("file_of_itself", 'Include "file_of_itself.geo";', 1, "include one another too deeply"),
    ("file_without_end", 'Include "/dev/zero";', 1, "too large"),
    # lists and texts
    ("range_without_end", "l[] = {1:1e308};", 1, "members"),
    ("range_of_tiny_steps", "l[] = {0:1:1e-320};", 1, "members"),
    ("linspace", "l[] = LinSpace[0, 1, 1e9];", 1, "the limit is"),
    ("logspace", "l[] = LogSpace[0, 1, 1e308];", 1, "the limit is"),
    ("list_that_doubles", "l[] = {1:100};\n" + loop("l[] += l[];"), 1, "the limit is"),
    ("list_of_lists", "l[] = {1:100};\n" + loop("l[] = {l[], l[]};"), 1, "the limit is"),
    ("far_index", "l[] = {}; l[2e9] = 1;", 1, "out of range"),
    ("many_lists", loop("v~{i}[] = {1:1e4};"), 1, "need more than"),
    ("many_variables", loop("v~{i} = i;"), 1, ""),
    ("text_that_doubles", 's = "x";\n' + loop("s = StrCat(s, s);"), 1, "bytes"),
    ("text_that_grows", 's = "aaaa";\n' + loop('s = StrReplace(s, "a", "aaaaaaaaaaaaaaaa");'), 1, "bytes"),
    ("texts_in_a_list", 's[] = Str("a", "b");\n' + loop('s[] += Str("c");'), 1, ""),
    ("sorted_again", "l[] = {1:300000};\n" + loop("l[] = Unique(l[]);"), 1, ENDS),
    ("list_less_itself", "l[] = {1:1000000}; k[] = {1000000:1}; l[] -= k[]; Printf('%g left', #l[]);", 0, ""),
    ("long_name", "x" * 2000000 + " = 1;", 1, "too long"),
    ("name_of_names", "x" + "~{1}" * 200000 + " = 1;", 1, "too long"),
    ("wide_number", 's = Sprintf("%2000000000g", 1);', 1, ""),
    # brackets in brackets
    ("parentheses", "x = " + "(" * 200000 + "1" + ")" * 200000 + ";", 1, DEEP),
    ("open_parentheses", "x = " + "(" * 1000000, 1, DEEP),
    ("calls", "x = " + "Sin[" * 100000 + "1" + "]" * 100000 + ";", 1, DEEP),
    ("signs", "x = " + "- " * 500000 + "1;", 1, DEEP),
    ("powers", "x = " + "2^" * 500000 + "1;", 1, DEEP),
    ("choices", "x = " + "1?2:" * 300000 + "1;", 1, DEEP),
    ("long_sum", "y = 1; x = " + "+".join(["y"] * 500000) + ";", 1, "too long or too deep"),
    ("braces", "l[] = " + "{" * 100000 + "1" + "}" * 100000 + ";", 1, ""),
    ("indices", "l[] = {0}; x = " + "l[" * 100000 + "0" + "]" * 100000 + ";", 1, DEEP),
    ("transforms", "Translate{0,0,1}{" * 100000 + "Point{1};" + "}" * 100000, 1, DEEP),
    ("blocks", "For i In {1:2}\n" * 100000 + "EndFor\n" * 100000, 1, DEEP),
    ("open_blocks", "For i In {1:2}\n" * 500000, 1, DEEP),
    ("branches", "If (1)\n" * 500000 + "EndIf\n" * 500000, 0, ""),
    ("branches_not_taken", "If (0)\n" * 500000 + "EndIf\n" * 500000, 0, ""),
    ("formula", 'Field[1] = MathEval; Field[1].F = "' + "(" * 500000 + '"; Background Field = 1;', 1, ""),
    # text that is none
    ("semicolons", ";" * 2000000, 0, "there are more warnings, which are not shown"),
    ("open_comment", "/*" * 2000000, 1, ""),
    ("open_text", 's = "' + "x" * 2000000, 1, ""),
    ("zeros", "\0" * 2000000, 0, "nothing to mesh"),
    # models
    ("points", loop("Point(newp) = {i, 0, 0};"), 1, ENDS),
    ("points_that_double", "Point(1) = {0, 0, 0};\n" + loop("Translate {2^i, 0, 0} { Duplicata { Point{:}; } }"), 1, ENDS),
    ("curves_that_sweep", SPLIT + loop("Extrude {0, 1, 0} { Curve{:}; }"), 1, ""),
    ("loops_of_many", loop("Curve Loop(i) = {1:100000};"), 1, ENDS),
    ("splines_of_many", loop("Point(i) = {i, 0, 0};", "For i In {1:100000}") + loop("Spline(i) = {1:100000};"), 1, ENDS),
    ("boxes", loop("Point(i) = {i, 0, 0};", "For i In {1:100000}") + loop("l[] = Point In BoundingBox {-1, -1, -1, 1e9, 1, 1};"), 1, ENDS),
    ("far_away", "Point(1) = {1e308, 0, 0}; Point(2) = {-1e308, 0, 0}; Line(1) = {1, 2};", 1, "cannot be computed with"),
    ("tags", "Point(1e300) = {0, 0, 0}; Point(2147483648) = {0, 0, 0};", 1, "tag"),
    ("groups", SPLIT + loop('Physical Point(Sprintf("g%g", i)) = {1};'), 1, ENDS),
    ("meshes", SPLIT + loop("Mesh 1;"), 1, ENDS),
    ("fields", loop("Field[i] = MathEval;"), 1, ENDS),
    ("fields_of_one_another", loop("Field[i] = Threshold; Field[i].InField = i - 1;", "For i In {2:20000}")
     + "Field[1] = Threshold; Field[1].InField = 20000; Background Field = 1;" + SPLIT, 1, "500 deep"),
    ("layers", "Point(1) = {0, 0, 0}; Extrude {1, 0, 0} { Point{1}; Layers{2000000000}; }", 1, ""),
    ("nodes_of_a_curve", SPLIT + "Transfinite Curve {1} = 2e9;", 1, ""),
    ("tiny_size", SPLIT + "MeshSize {:} = 1e-300;", 1, ""),
    ("messages", loop('Error("x");'), 1, "x"),
]

for name, text, status, message in CASES:
    with open(name + ".geo", "w", encoding="latin-1") as f:
        f.write(text)
    print("%s\t%d\t%s" % (name, status, message))
