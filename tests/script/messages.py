# messages.py - is every message of src/script and src/model provoked by a script test? Reads what test_script prints.
# SPDX-License-Identifier: MIT
import glob, re, sys

# What no script can provoke in a second, or not from a script alone.
BEYOND = (
    "need more than %zu MB", "too many different names", "would have more than %d bytes",  # limits that take long to reach
    "is not possible here", "cannot merge '%s' here",                # hosts that cannot mesh or merge
    "cannot be the name of a variable", "is not an option",          # of the command line: tests/cli
    "there must be at least 1", "cannot write to", "has holes; only Plane Surface", "meet in a way that was not resolved", "do not follow one another",  # callers of the model, last resorts
)
CALL = re.compile(r"\b(script__error|parse__fail|parse__expected|diag_error|diag_warning|diag_note)\s*\(")


def arguments(text, at):
    depth, quoted, i = 1, False, at
    while depth:
        c = text[i]
        if quoted:
            i += c == "\\"
            quoted = c != '"'
        elif c == '"':
            quoted = True
        else:
            depth += (c == "(") - (c == ")")
        i += 1
    return text[at : i - 1]


def formats():
    for path in sorted(glob.glob("src/script/*.c") + glob.glob("src/model/*.c")):
        if path.endswith("model_check.c"):
            continue  # what must never happen
        text = open(path).read()
        for call in CALL.finditer(text):
            parts = re.search(r'(?:"(?:[^"\\]|\\.)*"\s*)+', arguments(text, call.end()))
            if not parts:
                continue
            words = "".join(re.findall(r'"((?:[^"\\]|\\.)*)"', parts[0])).replace('\\"', '"')
            if call[1] == "parse__expected":
                words = "expected " + words
            yield "%s:%d" % (path, text.count("\n", 0, call.start()) + 1), words


def pattern(words):
    literal = re.split(r"%(?:%|[-+ #0-9.*]*(?:l|z|ll)?[a-zA-Z])", words)
    return ".*?".join(re.escape(w) for w in literal)


said = sys.stdin.read()
silent = [(where, words) for where, words in formats()
          if not any(b in words for b in BEYOND) and not re.search(pattern(words), said)]
for where, words in silent:
    print("# %s: no script test provokes: %s" % (where, words))
print("%s - every message of scripts and models is provoked by a test" % ("not ok 1" if silent else "ok 1"))
sys.exit(bool(silent))
