# Benches of sizes and of the 1D mesh; the rule that builds build/<CONFIG>/bench/% stands in mesh.mk.
.PHONY: bench-size
## bench-size: crossings, distances, expressions and a coastline in 1D
bench-size: $(B)/bench/bench_size
	$<
