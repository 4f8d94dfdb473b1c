# corpus.py - what corpus.sh runs: each file in its own folder copy of the tree, in parallel, with a time limit
# SPDX-License-Identifier: MIT
import argparse, concurrent.futures, csv, math, os, re, shutil, subprocess, sys, tempfile, time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def read_msh2(path):
    """Nodes, elements (type, physical, entity, nodes) and names of an ASCII MSH 2.2 file."""
    nodes, elems, names = {}, [], {}
    with open(path, encoding="latin-1") as f:
        lines = iter(f)
        for line in lines:
            if line.startswith("$PhysicalNames"):
                for _ in range(int(next(lines))):
                    m = re.match(r'(\d+) (\d+) "(.*)"', next(lines))
                    names[int(m[1]), int(m[2])] = m[3]
            elif line.startswith("$Nodes"):
                for _ in range(int(next(lines))):
                    w = next(lines).split()
                    nodes[w[0]] = (float(w[1]), float(w[2]), float(w[3]))
            elif line.startswith("$Elements"):
                for _ in range(int(next(lines))):
                    w = next(lines).split()
                    k = int(w[2])
                    elems.append((int(w[1]), int(w[3]), int(w[4]), w[3 + k:]))
    return nodes, elems, names


CORNERS = {15: 1, 1: 2, 8: 2, 26: 2, 27: 2, 2: 3, 9: 3, 20: 3, 21: 3, 23: 3, 3: 4, 10: 4, 16: 4, 36: 4, 37: 4, 39: 4}
DIM = {t: 0 if n == 1 else 1 if n == 2 else 2 for t, n in CORNERS.items()}


def measure(p):
    if len(p) < 2:
        return 0.0
    if len(p) == 2:
        return math.dist(p[0], p[1])
    total = [0.0, 0.0, 0.0]
    for i in range(1, len(p) - 1):
        a = [p[i][k] - p[0][k] for k in range(3)]
        b = [p[i + 1][k] - p[0][k] for k in range(3)]
        total[0] += a[1] * b[2] - a[2] * b[1]
        total[1] += a[2] * b[0] - a[0] * b[2]
        total[2] += a[0] * b[1] - a[1] * b[0]
    return 0.5 * math.hypot(*total)


def members(path):
    """Physical groups as sets of entities, and the entities without group: (dim, tag, name) -> tags."""
    _, elems, names = read_msh2(path)
    out = {}
    for t, phys, ent, _ in elems:
        if t in DIM:
            out.setdefault((DIM[t], abs(phys), names.get((DIM[t], abs(phys)), "")), set()).add(ent)
    return out


def differing_members(mine, theirs):
    for key in sorted(set(mine) | set(theirs)):
        if mine.get(key) != theirs.get(key):
            a, b = mine.get(key, set()), theirs.get(key, set())
            return "members of group %s: only mine %s, only gmsh's %s" % (key, sorted(a - b)[:5], sorted(b - a)[:5])
    return None


def summarize(path, without=(), tag_0_grouped=True):
    """Counts, groups, lengths and areas; of the elements of some faces nothing is said."""
    nodes, elems, names = read_msh2(path)
    elems = [e for e in elems if not (DIM[e[0]] == 2 and e[2] in without)]
    if not tag_0_grouped:
        elems = [(t, phys if ent else 0, ent, n) for t, phys, ent, n in elems]
    r = {"nodes": len(nodes), "points0d": 0, "lines": 0, "triangles": 0, "quads": 0, "groups": {}, "area": {}, "length": {}, "total": 0.0}
    for t, phys, ent, n in elems:
        d, p = DIM[t], [nodes[k] for k in n[: CORNERS[t]]]
        size = measure(p)
        key = "points0d" if d == 0 else "lines" if d == 1 else "triangles" if len(p) == 3 else "quads"
        r[key] += 1
        if phys:
            r["groups"].setdefault((d, abs(phys)), names.get((d, abs(phys)), ""))
        if d == 2:
            r["area"][abs(phys)] = r["area"].get(abs(phys), 0) + size
            r["total"] += size
        if d == 1:
            r["length"][abs(phys)] = r["length"].get(abs(phys), 0) + size
    for (d, tag), name in names.items():
        r["groups"].setdefault((d, tag), name)
    return r


def pairs(text):
    return {int(k): float(v) for k, v in (w.split(":") for w in text.split(";") if ":" in w)}  # else: "(188 surfaces)"


def compare(mine, ref):
    """List of disagreements with a reference row: groups, areas per group, lengths per group, line counts apart."""
    out = []
    want = {}
    for w in ref["phys_groups(dim:tag:name)"].split(";"):
        if w:
            d, tag, name = w.split(":", 2)
            want[int(d), int(tag)] = name
    got = {k: v for k, v in mine["groups"].items() if k[0] < 3}
    if {k for k in want if k[0] < 3} - set(got) or set(got) - set(want):
        out.append("groups: want %s, got %s" % (sorted(want)[:6], sorted(got)[:6]))
    else:
        bad = [k for k in want if k in got and want[k] and want[k] != got[k]]
        if bad:
            out.append("names of %s" % bad[:4])
    if float(ref["total_area_2d"] or 0) > 0:
        areas = pairs(ref["area_by_phys_surface(tag:area)"])
        for tag in sorted(set(areas) | set(mine["area"])):
            a, b = areas.get(tag, 0), mine["area"].get(tag, 0)
            if abs(a - b) > 0.01 * max(a, b) + 1e-12:
                out.append("area of group %d: %.8g, reference %.8g" % (tag, b, a))
                break
    return out


SKIPPED = re.compile(r"Mesh generation of surface (\d+) skipped")


def skipped_faces(ref):
    """Faces that the reference's program said it left without a mesh: there is nothing there to compare with."""
    return sorted({int(n) for text in ref.values() if isinstance(text, str) for n in SKIPPED.findall(text)})


def loses_tag_0(ref):
    """Does the reference have faces or curves of tag 0 that are in none of its groups, where there are groups? Gmsh 4.8 cannot put them in one."""
    return bool(ref["phys_groups(dim:tag:name)"]) and re.search(r"(^|;)0:", ref["area_by_elementary_surface(tag:area)"]) is not None


def compare_members(opt, scratch, name, msh, row):
    """With the groups of the file that gmsh writes; nothing is said of files that it cannot mesh, or writes in another format."""
    theirs = os.path.join(scratch, "theirs.msh")
    try:
        p = subprocess.run([opt.gmsh, "-2", "-v", "0", name, "-o", theirs, "-format", "msh22", "-nt", "1"], cwd=scratch,
                           stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=opt.timeout)
        bad = differing_members(members(msh), members(theirs)) if p.returncode == 0 else ""
    except (subprocess.TimeoutExpired, OSError, ValueError, KeyError, IndexError, StopIteration):
        return
    if bad == "":
        return
    row["members"] = "ok" if not bad else "differ"
    if bad:
        row["note"] = (row["note"] + "; " if row["note"] else "") + bad


def copy_beside(path, scratch, stand_in=()):
    """Files that stand in for what the script names and its author did not publish; their names if there are any. A copy of the script, since it may write files beside itself, with the rest of its folder linked for Include."""
    folder, name = os.path.split(os.path.abspath(path))
    for f in os.listdir(folder):
        if f != name:
            os.symlink(os.path.join(folder, f), os.path.join(scratch, f))
    shutil.copy(path, os.path.join(scratch, name))
    text, made = open(path, encoding="latin-1").read(), []
    for file, content in (s.split("=", 1) for s in stand_in):
        if '"%s"' % file in text and not os.path.exists(os.path.join(scratch, file)):
            with open(os.path.join(scratch, file), "w") as f:
                f.write(content + "\n")
            made.append(file)
    return made


def run_one(job):
    path, opt = job
    name = os.path.basename(path)
    row = {"file": name, "parsed": "-", "meshed": "-", "audited": "-", "compared": "-", "note": "", "lines": "", "elements": ""}
    scratch = tempfile.mkdtemp(prefix="meshgen-corpus.")
    try:
        made = copy_beside(path, scratch, opt.stand_in)
        if made:
            row["note"] = "with a stand-in for %s. " % ", ".join(made)
        prog = os.environ.get("MESHGEN", os.path.join(ROOT, "build/release/meshgen"))
        msh = os.path.join(scratch, "out.msh2")

        def go(args):
            t = time.time()
            try:
                p = subprocess.run([prog] + args, cwd=scratch, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=opt.timeout)
                code, err = p.returncode, p.stderr.decode("latin-1")
            except subprocess.TimeoutExpired:
                code, err = "timeout", "timeout"
            row["seconds"] = time.time() - t
            return code, err

        def first(err):
            lines = [l for l in err.splitlines() if "error" in l or "timeout" in l]
            return (lines or err.splitlines() or [""])[0][:150]

        code, err = go(["-parse_and_exit", "-v", "2", name])
        if opt.bad:
            row["parsed"] = "ok" if code == 0 else str(code)
            if code == 0:
                code, err = go(["-2", "-v", "2", name, "-o", msh, "-format", "msh2", "-no_report"])
            positioned = re.search(r":\d+:\d+: error: ", err) is not None
            row["meshed"] = str(code)
            row["pass"] = code == 1 and positioned
            row["note"] = first(err)
            return row
        row["parsed"] = "ok" if code == 0 else str(code)
        if code != 0:
            row["note"] = first(err)
            return row
        code, err = go(["-2", "-v", "2", name, "-o", msh, "-format", "msh2", "-no_report"] + opt.args.split())
        row["meshed"] = "ok" if code == 0 else str(code)
        if code != 0:
            row["note"] = first(err)
            return row
        if not os.path.exists(msh):
            row["pass"] = True
            row["note"] = "the script ended the program"
            return row
        code, err = go(["check", msh])
        row["audited"] = "ok" if code == 0 else str(code)
        if code != 0:
            row["note"] = first(err)
        mine = summarize(msh)
        row["elements"] = "%d+%d" % (mine["triangles"], mine["quads"])
        row["lines"] = mine["lines"]
        ref = opt.ref.get(name)
        if ref and ref["exit"] == "0":
            skipped = skipped_faces(ref)
            lost = loses_tag_0(ref)
            bad = compare(summarize(msh, skipped, not lost) if skipped or lost else mine, ref)
            if lost:
                row["note"] += "the reference's program has nothing of tag 0 in groups. "
            for face in skipped:
                row["note"] += "face %d is not compared: the reference has no mesh of it. " % face
            row["compared"] = "ok" if not bad else "differs"
            row["lines"] = "%d/%s" % (mine["lines"], ref["lines"])
            row["elements"] = "%d+%d/%s+%s" % (mine["triangles"], mine["quads"], ref["triangles"], ref["quads"])
            if bad:
                row["note"] = (row["note"] + "; ".join(bad))[:150]
        if opt.gmsh:
            compare_members(opt, scratch, name, msh, row)
        row["pass"] = row["audited"] == "ok" and row["compared"] != "differs"
        return row
    except Exception as e:  # a broken output file is the program's failure, not the harness's
        row["note"] = "harness: %r" % e
        return row
    finally:
        shutil.rmtree(scratch, ignore_errors=True)


KEEPS = re.compile(r"warning: surface (\d+) keeps (\d+) triangles?: (.*)")


def recombine_one(job):
    """One file with every face recombined by one method: finished, audited, and no triangle that was not announced as unavoidable."""
    path, opt, algorithm, method = job
    name = os.path.basename(path)
    row = {"file": name, "algorithm": algorithm, "method": method, "state": "-", "quads": 0, "triangles": 0, "seconds": 0.0, "note": "", "pass": False}
    scratch = tempfile.mkdtemp(prefix="meshgen-corpus.")
    try:
        copy_beside(path, scratch, opt.stand_in)
        prog = os.environ.get("MESHGEN", os.path.join(ROOT, "build/release/meshgen"))
        args = [prog, "-2", "-v", "2", name, "-o", "out.msh2", "-format", "msh2", "-no_report"]
        for key, value in (("Algorithm", algorithm), ("RecombineAll", 1), ("RecombinationAlgorithm", method)):
            args += ["-setnumber", "Mesh." + key, str(value)]
        t = time.time()
        p = subprocess.run(args + opt.args.split(), cwd=scratch, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, timeout=opt.timeout)
        row["seconds"] = time.time() - t
        err = p.stderr.decode("latin-1")
        msh = os.path.join(scratch, "out.msh2")
        if p.returncode != 0:
            row["state"], row["note"] = "exit %d" % p.returncode, next((l for l in err.splitlines() if "error" in l or "abort" in l.lower()), "")[:120]
        elif not os.path.exists(msh):
            row["state"], row["pass"], row["note"] = "no mesh", True, "the script ended the program"
        else:
            if subprocess.run([prog, "check", msh], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE).returncode != 0:
                row["state"] = "audit"
                return row
            mine = summarize(msh)
            row["quads"], row["triangles"], row["state"] = mine["quads"], mine["triangles"], "ok"
            kept = KEEPS.findall(err)
            odd = all(int(n) == 1 and "odd" in why for _, n, why in kept)
            refuses = re.search(r"^\s*Mesh\.RecombineAll\s*=\s*0", open(path, encoding="latin-1").read(), re.M) and not mine["quads"]
            row["pass"] = bool(refuses) or method == 0 or mine["triangles"] == 0 or (odd and mine["triangles"] <= len(kept))
            if method and mine["triangles"]:
                row["note"] = "; ".join("surface %s: %s, %s" % k for k in kept)[:110] or ("the script asks for triangles" if refuses else "triangles without a word")
    except subprocess.TimeoutExpired:
        row["state"] = "timeout"
    except Exception as e:
        row["state"], row["note"] = "harness", repr(e)
    finally:
        shutil.rmtree(scratch, ignore_errors=True)
    return row


def recombine(files, opt):
    methods = [0, 1, 2, 3] if opt.recombine == "all" else [int(w) for w in opt.recombine.split(",")]
    jobs = [(os.path.join(opt.folder, f), opt, a, m) for f in files for a in map(int, opt.algorithms.split(",")) for m in methods]
    rows = []
    print("%-52s %4s %4s %-8s %9s %9s %8s  %s" % ("file", "alg", "rec", "state", "quads", "triangles", "seconds", "note"))
    with concurrent.futures.ThreadPoolExecutor(opt.jobs) as ex:
        for r in ex.map(recombine_one, jobs):
            rows.append(r)
            mark = "" if r["pass"] else "NOT GOOD: "
            print("%-52s %4d %4d %-8s %9d %9d %8.2f  %s%s" % (r["file"][:52], r["algorithm"], r["method"], r["state"], r["quads"], r["triangles"], r["seconds"], mark, r["note"]), flush=True)
    good = sum(1 for r in rows if r["pass"])
    print("%d quadrangles, %d triangles; with methods 1 to 3 %d triangles, each in a face whose boundary is fixed odd unless listed as not good"
          % (sum(r["quads"] for r in rows), sum(r["triangles"] for r in rows), sum(r["triangles"] for r in rows if r["method"])))
    print("%d passed, %d failed" % (good, len(rows) - good))
    return 0 if good == len(rows) and rows else 1


def main():
    ap = argparse.ArgumentParser()
    ap.add_argument("folder")
    ap.add_argument("--reference", action="append", default=[])
    ap.add_argument("--jobs", type=int, default=os.cpu_count())
    ap.add_argument("--timeout", type=float, default=60)
    ap.add_argument("--args", default="")
    ap.add_argument("--only", default="")
    ap.add_argument("--all-names", action="store_true", help="also files that the reference does not list")
    ap.add_argument("--gmsh", metavar="PROGRAM", help="compare the members of groups with what this gmsh makes of each file")
    ap.add_argument("--stand-in", action="append", default=[], metavar="FILE=TEXT",
                    help="put a file of that text beside the scripts that name it, if it is missing there")
    ap.add_argument("--bad", action="store_true")
    ap.add_argument("--floor", type=int, help="good files that there must be; then only those missing from it count as failed")
    ap.add_argument("--recombine", nargs="?", const="all", metavar="METHODS", help="every face recombined; methods as 0,1,2,3")
    ap.add_argument("--algorithms", default="6", help="with --recombine: 2D algorithms as 6,8")
    opt = ap.parse_args()
    opt.ref = {}
    for r in opt.reference:
        with open(r, encoding="utf-8") as f:
            for row in csv.DictReader(f, delimiter="\t", quoting=csv.QUOTE_NONE):
                if row["file"] not in opt.ref or opt.ref[row["file"]]["exit"] != "0":
                    opt.ref[row["file"]] = row
    files = sorted(f for f in os.listdir(opt.folder) if f.endswith(".geo") and opt.only in f)
    if opt.ref and not opt.all_names:  # the rest are fragments that others include
        files = [f for f in files if f in opt.ref]
    if opt.recombine:
        return recombine(files, opt)
    jobs = [(os.path.join(opt.folder, f), opt) for f in files]
    with concurrent.futures.ThreadPoolExecutor(opt.jobs) as ex:
        rows = list(ex.map(run_one, jobs))
    print("%-52s %-7s %-7s %-7s %-8s %13s %22s  %s" % ("file", "parsed", "meshed", "audited", "compared", "lines/ref", "tri+quad/ref", "note"))
    for r in rows:
        print("%-52s %-7s %-7s %-7s %-8s %13s %22s  %s" % (r["file"][:52], r["parsed"], r["meshed"], r["audited"], r["compared"], r["lines"], r["elements"], r["note"]))
    good = sum(1 for r in rows if r.get("pass"))
    count = lambda k: sum(1 for r in rows if r[k] == "ok")
    same = [r for r in rows if "/" in str(r["lines"])]
    for r in rows:
        if not r.get("pass"):
            print("not good: %s: %s" % (r["file"], r["note"] or "see the table"))
    print("%d files: %d parsed, %d meshed, %d audited, %d compared equal of %d with a reference; line counts equal on %d of %d"
          % (len(rows), count("parsed"), count("meshed"), count("audited"), count("compared"), count("compared") + sum(1 for r in rows if r["compared"] == "differs"),
             sum(1 for r in same if r["lines"].split("/")[0] == r["lines"].split("/")[1]), len(same)))
    if opt.gmsh:
        for r in rows:
            if r.get("members") == "differ":
                print("members differ: %s: %s" % (r["file"], r["note"]))
        print("members of all groups equal on %d of %d files that gmsh meshes without error"
              % (sum(1 for r in rows if r.get("members") == "ok"), sum(1 for r in rows if r.get("members"))))
    failed = len(rows) - good
    if opt.floor is not None:
        print("%d good, %d not (listed above); the floor is %d" % (good, failed, opt.floor))
        failed = max(0, opt.floor - good)
    print("%d passed, %d failed" % (good, failed))
    return 0 if failed == 0 and rows else 1


if __name__ == "__main__":
    sys.exit(main())
