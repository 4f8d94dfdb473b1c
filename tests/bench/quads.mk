# quads.mk - benches of matching and recombination

$(B)/bench/bench_quads: tests/bench/bench_quads.cc $(LIB)
	@mkdir -p $(@D)
	@echo "CXX  $<"
	$(Q)$(CXX) -std=c++17 -O3 -Isrc -Itests/unit -D_GNU_SOURCE -ffp-contract=off -o $@ $< $(LIB) $(LDFLAGS) $(LIBS)

.PHONY: bench-quads
## bench-quads: matching against LEMON (N=triangles, LEMON=largest for LEMON), recombination against gmsh
bench-quads: $(B)/bench/bench_quads meshgen
	$(B)/bench/bench_quads $(or $(N),300000) $(or $(LEMON),35000)
	bash tests/bench/quads.sh $(PROGRAM)
