"""What -0 writes, over a folder: unrolled.py MESHGEN FOLDER [--gmsh PROGRAM] [--only PATTERN] [--jobs N].

Of every .geo file that meshgen reads: the unrolled model, read by meshgen, is written as the same bytes. With --gmsh, that program
makes of the unrolled model the same entities as of the file itself (points and their places, curves and their ends and boxes, faces
and their curves, groups, members and names), and these are the entities that meshgen has. Where the program crashes on the file, or
stops, it reads a copy without fields and without what meshes or saves; the row says so.
Prints a row per fault and what was left out; last line "N passed, N failed".
"""
import argparse, concurrent.futures, math, os, re, subprocess, sys, tempfile

from corpus import copy_beside


def run(folder, *words):
    try:
        return subprocess.run(words, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=60)
    except subprocess.TimeoutExpired:
        return subprocess.CompletedProcess(words, -1, b"time limit")


def entities(path):
    """Of an MSH 4.1 file: points, curves, faces by tag, and names of groups."""
    with open(path, encoding="latin-1") as f:
        lines = [line.rstrip("\n") for line in f]
    names = {}
    if "$PhysicalNames" in lines:
        for line in lines[lines.index("$PhysicalNames") + 2 : lines.index("$EndPhysicalNames")]:
            dim, tag, name = line.split(" ", 2)
            if int(dim) < 3:
                names[int(dim), int(tag)] = name
    at = lines.index("$Entities") + 1
    many = [int(w) for w in lines[at].split()]
    out = []
    for dim in range(3):
        table = {}
        for line in lines[at + 1 : at + 1 + many[dim]]:
            w = line.split()
            head = 4 if dim == 0 else 7
            n = int(w[head])
            groups = {abs(int(t)) for t in w[head + 1 : head + 1 + n]}
            bounds = [abs(int(t)) for t in w[head + 2 + n :]] if dim else []
            if dim == 2:  # beyond the curves' tags: embedded curves
                bounds = sorted({t for t in bounds if t in out[1]})
            table[int(w[0])] = [float(x) for x in w[1:head]], groups, bounds
        at += many[dim]
        out.append(table)
    return out, names


def apart(dim, mine, theirs, size):
    """Points are where they are; gmsh samples the box of a curve at few points, so that it may be smaller, never larger; and
    with a tiny Geometry.Tolerance it may be one point."""
    if dim == 0:
        return max(abs(x - y) for x, y in zip(mine, theirs)) > 1e-9 * size
    more = [b - a for a, b in zip(mine[:3], theirs[:3])] + [a - b for a, b in zip(mine[3:], theirs[3:])]
    return dim == 1 and (min(more) < -1e-4 * size or max(more) > 0.1 * size and math.dist(theirs[:3], theirs[3:]) > 1e-3 * size)


def left_behind(mine, theirs):
    """Points that gmsh keeps after Coherence made them one with others, because it had published them before: of no curve, and the others are there."""
    used = {t for _, _, ends in theirs[1].values() for t in ends}
    place_of = lambda place: tuple("%.9g" % (x + 0.0) for x in place)
    places = {place_of(mine[0][t][0]) for t in mine[0]}
    return {t for t, (place, groups, _) in theirs[0].items() if t not in mine[0] and t not in used and not groups and place_of(place) in places}


def differing(a, b):
    """The first difference of two models."""
    (mine, names), (theirs, other) = a, b
    stale = left_behind(mine, theirs)
    theirs = [{t: e for t, e in theirs[0].items() if t not in stale}] + theirs[1:]
    closed = {ends[0] for _, _, ends in theirs[1].values() if ends and ends[0] == ends[-1]}  # may move to where the curve begins
    size = max((max(x) - min(x) for x in zip(*(p[0] for p in theirs[0].values()))), default=0) or 1
    for dim, what in enumerate(("point", "curve", "surface")):
        if set(mine[dim]) != set(theirs[dim]):
            gone, more = sorted(set(theirs[dim]) - set(mine[dim])), sorted(set(mine[dim]) - set(theirs[dim]))
            return "%ss: %d missing %s, %d more %s" % (what, len(gone), gone[:5], len(more), more[:5])
        for tag, (box, groups, bounds) in mine[dim].items():
            box2, groups2, bounds2 = theirs[dim][tag]
            if groups != groups2:
                return "%s %d is in groups %s, not %s" % (what, tag, sorted(groups), sorted(groups2))
            if bounds != bounds2:
                return "%s %d is bounded by %s, not %s" % (what, tag, bounds[:8], bounds2[:8])
            if apart(dim, box, box2, size) and not (dim == 0 and tag in closed):
                return "%s %d is at %s, not %s" % (what, tag, box, box2)
    if names != other:
        return "names: %s" % sorted(set(names.items()) ^ set(other.items()))[:4]
    return None


MESHING = re.compile(r"^\s*(Field\s*\[|BoundaryLayer Field|Background Field|Mesh\s+\d|Save\s|RefineMesh|OptimizeMesh|Mesh\.Algorithm)[^;]*;.*$", re.M)


def theirs(opt, folder, name):
    """Its entities, and a note."""
    for note in ("", "gmsh reads a copy without fields and meshing"):
        with open(os.path.join(folder, name), "a") as f:
            f.write("\nMesh.MshFileVersion = 4.1; Mesh.Binary = 0; Mesh.ScalingFactor = 1;\n")
        p = run(folder, opt.gmsh, name, "-0", "-save_all", "-format", "msh41", "-o", "theirs.msh")
        if os.path.exists(os.path.join(folder, "theirs.msh")) and p.returncode in (0, 1):
            return entities(os.path.join(folder, "theirs.msh")), note
        with open(os.path.join(folder, name), encoding="latin-1") as f:
            text = f.read()
        name = "edited.geo"
        with open(os.path.join(folder, name), "w", encoding="latin-1") as f:
            f.write(MESHING.sub("", text))
    return None, "not compared: gmsh does not read it"


def take(job):
    path, opt = job
    name, faults, notes = os.path.basename(path), [], []
    with tempfile.TemporaryDirectory() as folder:
        copy_beside(path, folder)
        p = run(folder, opt.meshgen, name, "-0", "-v", "2", "-o", "once.geo")
        if p.returncode or not os.path.exists(os.path.join(folder, "once.geo")):
            return name, None, ["left out: exit status %d" % p.returncode]
        run(folder, opt.meshgen, "once.geo", "-0", "-v", "2", "-o", "twice.geo")
        once, twice = (open(os.path.join(folder, f), "rb").read() if os.path.exists(os.path.join(folder, f)) else b"" for f in ("once.geo", "twice.geo"))
        faults += [] if once == twice else ["meshgen writes other bytes when it reads it back"]
        if opt.gmsh:
            model, note = theirs(opt, folder, name)
            notes += [note] if note else []
            back = run(folder, opt.gmsh, "once.geo", "-0", "-save_all", "-format", "msh41", "-o", "back.msh")
            if model and back.returncode == 0:
                stale = left_behind(entities(os.path.join(folder, "back.msh"))[0], model[0])
                notes += ["gmsh keeps %d points that are one with others" % len(stale)] if stale else []
            bad = model and (differing(entities(os.path.join(folder, "back.msh")), model) if back.returncode == 0 else "error")
            faults += ["gmsh reads back: " + bad] if bad else []
            run(folder, opt.meshgen, name, "-1", "-save_all", "-v", "1", "-no_report", "-format", "msh41", "-o", "mine.msh")
            mine = os.path.join(folder, "mine.msh")
            bad = model and (differing(entities(mine), model) if os.path.exists(mine) else "no mesh")
            faults += ["model: " + bad] if bad else []
    return name, faults, notes


def main():
    ap = argparse.ArgumentParser()
    ap.add_argument("meshgen")
    ap.add_argument("folder")
    ap.add_argument("--gmsh")
    ap.add_argument("--only", default="")
    ap.add_argument("--jobs", type=int, default=os.cpu_count())
    opt = ap.parse_args()
    opt.meshgen = os.path.abspath(opt.meshgen)
    files = sorted(f for f in os.listdir(opt.folder) if f.endswith(".geo") and opt.only in f)
    with concurrent.futures.ThreadPoolExecutor(opt.jobs) as ex:
        rows = list(ex.map(take, [(os.path.join(opt.folder, f), opt) for f in files]))
    for name, faults, notes in rows:
        for text in (faults or []) + notes:
            print("%-44s %s" % (name, text))
    taken = [faults for _, faults, _ in rows if faults is not None]
    bad = sum(1 for faults in taken if faults)
    print("%d passed, %d failed" % (len(taken) - bad, bad))
    return 1 if bad or not taken else 0


if __name__ == "__main__":
    sys.exit(main())
