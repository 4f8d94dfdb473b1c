$(B)/bench/bench_io: tests/bench/bench_io.c $(LIB)
	@mkdir -p $(@D)
	$(Q)$(CC) $(CFLAGS_ALL) -MF $@.d -MT $@ -o $@ $< $(LIB) $(LDFLAGS) -lstdc++ $(LIBS)

.PHONY: bench-io
## bench-io: write and read 10^6 triangles in every format, hash, audit, diff; gmsh converting the same file beside ours
bench-io: $(B)/bench/bench_io meshgen
	$(Q)d=$$(mktemp -d) && $< $$d && \
	for prog in "gmsh -save -v 1" "./meshgen -v 1 -no_report"; do for f in msh2 vtk; do \
	  echo "$$prog bench_io.msh -format $$f"; \
	  bash -c "TIMEFORMAT='  wall %R  user %U  sys %S'; time $$prog $$d/bench_io.msh -format $$f -o $$d/out.$$f"; \
	done; done; \
	echo "meshgen diff of two files"; \
	bash -c "TIMEFORMAT='  wall %R  user %U  sys %S'; time ./meshgen diff $$d/bench_io.msh $$d/bench_io_bin.msh"; \
	rm -rf $$d
