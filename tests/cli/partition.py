"""Compare two partitioned MSH 4.1 files in ASCII: are the same elements in the same parts, do the same edges lie between them, does
each part see the same ghost cells? Elements are told by the places of their nodes. Usage: partition.py a.msh b.msh"""
import sys


class Mesh:
    def __init__(self, path):
        self.section = {}
        name = None
        with open(path) as f:
            for line in f:
                if line.startswith("$End"):
                    name = None
                elif line.startswith("$"):
                    name = line[1:].strip()
                    self.section[name] = []
                else:
                    self.section[name].append(line.split())
        self.read_pieces()
        self.read_nodes()
        self.read_elements()
        self.read_ghosts()

    def read_pieces(self):
        rows = iter(self.section["PartitionedEntities"])
        self.parts = int(next(rows)[0])
        for _ in range(int(next(rows)[0])):
            next(rows)
        self.piece = {}  # (dim, tag) -> parent's dim, parts
        for dim, count in enumerate(map(int, next(rows))):
            for _ in range(count):
                r = next(rows)
                n = int(r[3])
                self.piece[dim, int(r[0])] = int(r[1]), tuple(sorted(map(int, r[4:4 + n])))
        # Not how many pieces: a seam that follows a curve and leaves it is two here, and sometimes one in gmsh.
        self.pieces = {(dim, parent, parts): True for (dim, _), (parent, parts) in self.piece.items()}

    def read_nodes(self):
        rows = iter(self.section["Nodes"])
        self.node = {}
        for _ in range(int(next(rows)[0])):
            n = int(next(rows)[3])
            tags = [int(next(rows)[0]) for _ in range(n)]
            for t in tags:
                self.node[t] = tuple(round(float(x), 9) for x in next(rows))

    def read_elements(self):
        rows = iter(self.section["Elements"])
        self.where = {}  # number -> places of its nodes
        self.own, self.seam = {}, {}
        for _ in range(int(next(rows)[0])):
            dim, tag, _, n = map(int, next(rows))
            parent, parts = self.piece[dim, tag]
            for _ in range(n):
                r = next(rows)
                places = tuple(sorted(self.node[int(v)] for v in r[1:]))
                self.where[int(r[0])] = places
                if parent == dim:
                    self.own[places] = parts
                elif dim == 1:
                    self.seam[places] = parts

    def read_ghosts(self):
        self.ghost = {}
        for r in self.section.get("GhostElements", [])[1:]:
            self.ghost[self.where[int(r[0])]] = int(r[1]), tuple(sorted(map(int, r[3:])))


def main():
    a, b = (Mesh(p) for p in sys.argv[1:])
    good = True
    for what in ("parts", "pieces", "own", "seam", "ghost"):
        x, y = getattr(a, what), getattr(b, what)
        print(what, "same" if x == y else "differ", x if what == "parts" else f"{len(x)} {len(y)}")
        if x != y:
            good = False
            if what != "parts":
                print([(k, x.get(k), y.get(k)) for k in set(x) | set(y) if x.get(k) != y.get(k)][:5])
    return not good


sys.exit(main())
