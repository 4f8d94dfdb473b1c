# mesh.mk - benches of refinement
$(B)/bench/bench_refine: LDFLAGS += -lcairo
$(B)/bench/%: tests/bench/%.c $(LIB)
	@mkdir -p $(@D)
	@echo "CC   $<"
	$(Q)$(CC) $(CFLAGS_ALL) -MF $@.d -MT $@ -o $@ $< $(LIB) $(LDFLAGS) -lstdc++ $(LIBS)

.PHONY: bench-mesh
## bench-mesh: our refinement and gmsh side by side: time and quality
bench-mesh: $(B)/bench/bench_refine meshgen
	bash tests/bench/mesh.sh $(B)/bench/bench_refine ./meshgen

.PHONY: bench-structured
## bench-structured: transfinite squares to a binary MSH, ours and gmsh side by side
bench-structured: meshgen
	bash tests/bench/structured.sh ./meshgen

.PHONY: docs-quality
## docs-quality: docs/quality.md anew: triangles of every face of geo/, ours and gmsh's
docs-quality: meshgen
	/usr/bin/python3 tests/bench/quality.py --page docs/quality.md geo geo/conge.geo@0.3 geo/conge.geo@0.1
