# cross.mk - bench of the meshes made for quads

.PHONY: bench-cross
## bench-cross: algorithms 6, 8 and 9 with recombination: quality, irregular vertices, time
bench-cross: meshgen
	bash tests/bench/cross.sh $(PROGRAM)
