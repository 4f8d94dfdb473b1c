$(B)/bench/bench_model: tests/bench/bench_model.c $(LIB)
	@mkdir -p $(@D)
	$(Q)$(CC) $(CFLAGS_ALL) -MF $@.d -MT $@ -o $@ $< $(LIB) $(LDFLAGS) -lstdc++ $(LIBS)

.PHONY: bench-model
## bench-model: points, lines, transforms, extrusions, coherence, unrolling (N=points)
bench-model: $(B)/bench/bench_model
	$(B)/bench/bench_model $(or $(N),1000000)
