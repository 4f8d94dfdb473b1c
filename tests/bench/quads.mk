# quads.mk - benches of matching and recombination, and the long tests of the matching

$(B)/bench/bench_quads: tests/bench/bench_quads.cc $(LIB)
	@mkdir -p $(@D)
	@echo "CXX  $<"
	$(Q)$(CXX) -std=c++17 -O3 -Isrc -Itests/unit -D_GNU_SOURCE -ffp-contract=off -o $@ $< $(LIB) $(LDFLAGS) $(LIBS)

.PHONY: bench-quads check-blossom
## bench-quads: matching against LEMON (N=triangles, LEMON=largest for LEMON), recombination against gmsh
bench-quads: $(B)/bench/bench_quads meshgen
	bash tests/bench/quads.sh $(PROGRAM) $(B)/bench/bench_quads $(or $(N),300000) $(or $(LEMON),35000)

## check-blossom: the matching against LEMON on 300 random and mesh graphs of up to 50,000 vertices (minutes)
check-blossom: $(B)/unit/test_blossom
	$(Q)TEST_BLOSSOM_LONG=1 $(B)/unit/test_blossom
