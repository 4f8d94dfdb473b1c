#!/usr/bin/env python3
"""Comments and documents keep up with the code: check_comments.py [FOLDER]. Prints what does not hold, and how much; exit status 1 then.

- A file named in a comment or document is there, and so is a target of make named in a document.
- A word with an underscore in a comment, or between backticks in a document, stands in the code, is a file's name or a rule of the
  grammar. Symbols of formulas, with a part of one letter or a digit alone, do not count.
- The key of a reference, as [Name95], is listed in docs/references.md.
- The first line of a source file begins with its name.
- A function of a public header has a comment: above it or the functions it stands with, or behind it.
"""
import fnmatch
import os
import re
import subprocess
import sys

os.chdir(sys.argv[1] if len(sys.argv) > 1 else os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
FILES = subprocess.run(["find", "src", "tests", "docs", "geo", "Makefile", "README.md", "-type", "f"], capture_output=True, text=True,
                       check=True).stdout.split()
FILE = re.compile(r"(?<![\w./*-])((?:[a-z0-9_]+/)*[a-z0-9_*]+\.(?:c|h|cc|def|sh|py|mk|md)|geo/\w+\.geo)(?!\w)")
WORD = re.compile(r"(?<![\w./\[-])([a-z][a-z0-9]*(?:_{1,2}[a-z0-9]+)+)(?![\w*])")
KEY = re.compile(r"\[[A-Z][A-Za-z]+\d+[a-z]?\]")
PROTOTYPE = re.compile(r"^(?!typedef|static|enum|#|//)[A-Za-z].*\w\(.*[;,]\s*(//.*)?$")
EXAMPLES = {"folder/file.h", "folder/folder_int.h", "folder_int", "module_verb_object", "module__name"}  # of docs/style.md
references = open("docs/references.md", encoding="utf-8").read()
problems = []


def split(text):
    """Code without its comments, and the comments with their lines."""
    comments = []

    def take(m):
        if m.group().startswith("//"):
            comments.append((text.count("\n", 0, m.start()) + 1, m.group()))
            return " "
        return m.group()

    return re.sub(r'//[^\n]*|"(?:\\.|[^"\\\n])*"', take, text), comments


def is_there(name):
    return any(fnmatch.fnmatch(f, name) or fnmatch.fnmatch(f, "*/" + name) for f in FILES)


def check(path, line, text, words):
    for name in FILE.findall(text):
        if name not in EXAMPLES and not is_there(name):
            problems.append(f"{path}:{line}: there is no file {name}")
    for key in KEY.findall(text):
        if key not in references:
            problems.append(f"{path}:{line}: {key} is not in docs/references.md")
    for word in words:
        formula = any(len(part) < 2 or part.isdigit() for part in re.split("_+", word))
        if not formula and word not in known and word not in EXAMPLES:
            problems.append(f"{path}:{line}: nothing is called {word}")


def check_header(path, text):
    covered = False
    for n, line in enumerate(text.split("\n"), 1):
        if not line.strip() or line.startswith("//"):
            covered = line.startswith("//")
        elif "//" in line:
            covered = True
        elif PROTOTYPE.match(line) and not covered:
            problems.append(f"{path}:{n}: a function without a comment: {line[:80]}")


known, comments = set(), {}
for f in FILES:
    stem, ending = os.path.splitext(os.path.basename(f))
    known.add(stem)
    if ending in (".png", ".md"):
        continue
    text = open(f, encoding="latin-1").read()
    if ending in (".c", ".h", ".cc", ".def"):
        text, comments[f] = split(text)
        for _, c in comments[f]:
            known.update(re.findall(r"(\w+) ->", c))  # rules of the grammar
        if f.startswith("src") and not (comments[f] and comments[f][0][1].startswith(f"// {stem}{ending} - ")):
            problems.append(f"{f}:1: the first line does not begin with the file's name")
        if ending == ".h" and not f.endswith("_int.h"):
            check_header(f, open(f, encoding="latin-1").read())
    known.update(re.findall(r"\w+", text))
for f, list_of in comments.items():
    for n, c in list_of:
        check(f, n, c, WORD.findall(c))
makefiles = "".join(open(f).read() for f in FILES if f == "Makefile" or f.endswith(".mk"))
for f in FILES:
    if not f.endswith(".md"):
        continue
    for n, line in enumerate(open(f, encoding="utf-8"), 1):
        ticked = re.findall(r"`([^`]+)`", line)
        check(f, n, line, [w for t in ticked for w in WORD.findall(t)])
        for target in [t for q in ticked for t in re.findall(r"^(?:\w+=\S+ )*make (?:\w+=\S+ )*([a-z][a-z-]*)", q)]:
            if not re.search(rf"^(?:[\w-]+ )*{target}(?: [\w-]+)*:", makefiles, re.M):
                problems.append(f"{f}:{n}: make has no target {target}")
print("\n".join(problems) or "comments and documents name what is there")
sys.exit(1 if problems else 0)
