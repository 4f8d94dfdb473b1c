# script.mk - speed of reading scripts: see docs/internals/script.md
.PHONY: bench-script
## bench-script: a file of 10^6 points and lines, a loop of 10^7 iterations
bench-script: $(B)/bench/bench_script
	$(Q)$<
