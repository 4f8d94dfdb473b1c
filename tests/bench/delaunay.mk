# Timings of the triangulation kernel against CGAL's, both at -O3 -march=native.

BENCH_TRI_SRC := $(wildcard src/base/*.c src/tri/*.c) src/base/number.cc src/geom/predicates.c src/geom/predicates_mp.c src/geom/hilbert.c
BENCH_TRI_OBJ := $(patsubst src/%,build/bench/%.o,$(BENCH_TRI_SRC))
BENCH_FLAGS := -Isrc -Itests/bench -D_GNU_SOURCE -ffp-contract=off -fno-math-errno -pthread -O3 -march=native -DNDEBUG -MMD -MP

build/bench/%.c.o: src/%.c
	@mkdir -p $(@D)
	$(Q)$(CC) -std=c11 $(CWARN) $(BENCH_FLAGS) -c -o $@ $<

build/bench/%.cc.o: src/%.cc
	@mkdir -p $(@D)
	$(Q)$(CXX) -std=c++17 $(WARN) $(BENCH_FLAGS) -c -o $@ $<

build/bench/bench_%: tests/bench/bench_%.cc $(BENCH_TRI_OBJ)
	@echo "CXX  $<"
	$(Q)$(CXX) -std=c++17 $(BENCH_FLAGS) -frounding-math -o $@ $< $(BENCH_TRI_OBJ) -lmpfr -lgmp -lm

.PHONY: bench-delaunay
## bench-delaunay: Delaunay triangulation of the point sets against CGAL (N=points, ROUNDS=repetitions)
bench-delaunay: build/bench/bench_delaunay
	build/bench/bench_delaunay $(or $(N),1000000) $(or $(ROUNDS),5)

build/bench/coastline.poly: tests/bench/coastline.py
	@mkdir -p $(@D)
	/usr/bin/python3 $< $@

.PHONY: bench-constrained
## bench-constrained: constrained triangulation of the world's shorelines against CGAL (ROUNDS=repetitions)
bench-constrained: build/bench/bench_constrained build/bench/coastline.poly
	build/bench/bench_constrained build/bench/coastline.poly $(or $(ROUNDS),5)

build/bench/bench_tables: tests/bench/bench_tables.c $(BENCH_TRI_OBJ)
	$(Q)$(CC) -std=c11 $(BENCH_FLAGS) -o $@ $< $(BENCH_TRI_OBJ) -lstdc++ -lmpfr -lgmp -lm

build/bench/draw_predicates: tests/bench/draw_predicates.c $(BENCH_TRI_OBJ)
	$(Q)$(CC) -std=c11 $(BENCH_FLAGS) $(PKG_CFLAGS) -o $@ $< $(BENCH_TRI_OBJ) -lcairo -lstdc++ -lmpfr -lgmp -lm

.PHONY: bench-tables docs-predicates
## bench-tables: walk steps, cavities and seconds for 10^3 .. 10^6 points, as in docs/internals/delaunay.md
bench-tables: build/bench/bench_tables
	build/bench/bench_tables
## docs-predicates: draw docs/predicates.png, the orientation test near a line
docs-predicates: build/bench/draw_predicates
	build/bench/draw_predicates docs/predicates.png

-include $(BENCH_TRI_OBJ:.o=.d)
