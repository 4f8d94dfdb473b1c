$(B)/bench/bench_io: tests/bench/bench_io.c $(LIB)
	@mkdir -p $(@D)
	$(Q)$(CC) $(CFLAGS_ALL) -MF $@.d -MT $@ -o $@ $< $(LIB) $(LDFLAGS) -lstdc++ $(LIBS)

.PHONY: bench-io
## bench-io: write and read 10^6 triangles in every format, hash, audit, diff; gmsh converting the same file beside ours
bench-io: $(B)/bench/bench_io meshgen
	$(Q)d=$$(mktemp -d) && $< $$d && \
	echo "converting bench_io.msh (MSH 4.1, ASCII), whole processes" && bash tests/bench/convert.sh ./meshgen $$d/bench_io.msh && \
	echo "converting bench_io_bin.msh (MSH 4.1, binary)" && bash tests/bench/convert.sh ./meshgen $$d/bench_io_bin.msh; \
	echo "meshgen diff of two files"; \
	bash -c "TIMEFORMAT='  wall %R  user %U  sys %S'; time ./meshgen diff $$d/bench_io.msh $$d/bench_io_bin.msh"; \
	rm -rf $$d
