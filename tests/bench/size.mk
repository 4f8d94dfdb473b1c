# Benches of sizes and of the 1D mesh; the rule that builds build/<CONFIG>/bench/% stands in mesh.mk.
.PHONY: bench-size
## bench-size: crossings, distances (beside gmsh's), expressions and a coastline in 1D
bench-size: $(B)/bench/bench_size meshgen
	$<
	bash tests/bench/distance.sh $(PROGRAM)

.PHONY: bench-curves
## bench-curves: how well the edges on curves fit the sizes, for geo/*.geo or FILES=...
FILES ?= $(wildcard geo/*.geo)
bench-curves: $(B)/bench/curve_counts
	$< -l $(FILES)
