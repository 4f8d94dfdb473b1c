.PHONY: bench-batch
## bench-batch: start to finish of a model of 100 triangles; 1,000 models in one call beside calls of gmsh
bench-batch: meshgen
	$(Q)bash tests/bench/batch.sh ./meshgen
