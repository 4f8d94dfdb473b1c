# Benches of sizes and of the 1D mesh; the rule that builds build/<CONFIG>/bench/% stands in mesh.mk.
