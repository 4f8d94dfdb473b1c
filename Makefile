# Makefile - builds meshgen, its library and its tests. `make help` lists the targets.
# One non-recursive file; objects of each configuration stand in build/<CONFIG>/.

CONFIG ?= release
prefix ?= /usr/local
bindir ?= $(prefix)/bin
datadir ?= $(prefix)/share
mandir ?= $(datadir)/man
DESTDIR ?=
CC ?= cc
CXX ?= c++
ifeq ($(origin CC),default)
CC := gcc
endif
ifeq ($(origin CXX),default)
CXX := g++
endif
PKG_CONFIG ?= pkg-config
# Extra flags of the person at the keyboard, e.g. MARCH=-march=native; they never change a result.
MARCH ?=
V ?= 0
Q := $(if $(filter 1,$(V)),,@)

B := build/$(CONFIG)

OPT_release := -O3 -g1 -DNDEBUG
OPT_debug := -O0 -g -DCHECK_LEVEL=1
OPT_asan := -O1 -g -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=undefined -DCHECK_LEVEL=1
OPT_stress := -O1 -g -DSTRESS -DCHECK_LEVEL=3
OPT_cov := -O0 -g --coverage -DCHECK_LEVEL=1
OPT_fuzz := -O1 -g -fsanitize=fuzzer-no-link,address,undefined -DCHECK_LEVEL=1
# Of the C++ library only the conversion of numbers is used; linked in, it need not be relocated at each start.
LINK_release := -static-libstdc++ -static-libgcc
ifeq ($(OPT_$(CONFIG)),)
$(error unknown CONFIG=$(CONFIG): release, debug, asan, stress, cov, fuzz)
endif

WARN := -Wall -Wextra -Wpedantic -Wshadow -Wvla -Wpointer-arith -Wwrite-strings -Wundef
CWARN := $(WARN) -Wstrict-prototypes -Wmissing-prototypes
ifdef DEVELOPER
WARN += -Werror
endif

# No contraction of a*b+c, never -ffast-math: exact predicates and equal bytes from every compiler need it.
COMMON := -Isrc -D_GNU_SOURCE -ffp-contract=off -fno-math-errno -fvisibility=hidden -pthread $(OPT_$(CONFIG)) $(MARCH) -MMD -MP
LIB_PKGS := cairo
PKG_CFLAGS := $(shell $(PKG_CONFIG) --cflags $(LIB_PKGS) 2>/dev/null)
CFLAGS_ALL := -std=c11 $(CWARN) $(COMMON) $(PKG_CFLAGS) $(CFLAGS)
CXXFLAGS_ALL := -std=c++17 $(WARN) $(COMMON) $(CXXFLAGS)
# cairo is loaded when a picture is drawn (out/cairo_load.h).
LIBS := -lmetis -lmpfr -lgmp -lz -lm

SRC_C := $(sort $(wildcard src/*/*.c))
SRC_CC := $(sort $(wildcard src/*/*.cc))
OBJ := $(SRC_C:src/%.c=$(B)/%.o) $(SRC_CC:src/%.cc=$(B)/%.o)
MAIN_OBJ := $(B)/cli/main.o
LIB := $(B)/libmeshgen.a
PROGRAM := $(B)/meshgen

.PHONY: all program meshgen
## all: build ./meshgen (default), a link to the program of this CONFIG
all: meshgen

meshgen: $(PROGRAM)
	$(Q)[ "$$(readlink $@)" = $< ] || ln -sfn $< $@

program: $(PROGRAM)

$(PROGRAM): $(MAIN_OBJ) $(LIB)
	@echo "LINK $@"
	$(Q)$(CXX) $(OPT_$(CONFIG)) -pthread $(LINK_$(CONFIG)) -o $@ $^ $(LDFLAGS) $(LIBS)

$(LIB): $(filter-out $(MAIN_OBJ),$(OBJ))
	@echo "AR   $@"
	$(Q)rm -f $@ && ar rcs $@ $^

$(B)/%.o: src/%.c Makefile
	@mkdir -p $(@D)
	@echo "CC   $<"
	$(Q)$(CC) $(CFLAGS_ALL) -c -o $@ $<

$(B)/%.o: src/%.cc Makefile
	@mkdir -p $(@D)
	@echo "CXX  $<"
	$(Q)$(CXX) $(CXXFLAGS_ALL) -c -o $@ $<

# ---- tests: every tests/unit/test_*.c or .cc is a cmocka program -----------------------------------------------
UNIT_C := $(sort $(wildcard tests/unit/test_*.c))
UNIT_CC := $(sort $(wildcard tests/unit/test_*.cc))
UNIT := $(UNIT_C:tests/unit/%.c=$(B)/unit/%) $(UNIT_CC:tests/unit/%.cc=$(B)/unit/%)

$(B)/unit/%: tests/unit/%.c $(LIB)
	@mkdir -p $(@D)
	@echo "CC   $<"
	$(Q)$(CC) $(CFLAGS_ALL) -Itests/unit -MF $@.d -MT $@ -o $@ $< $(LIB) $(LDFLAGS) -lcmocka -lstdc++ $(LIBS)

$(B)/unit/%: tests/unit/%.cc $(LIB)
	@mkdir -p $(@D)
	@echo "CXX  $<"
	$(Q)$(CXX) $(CXXFLAGS_ALL) -Wno-pedantic -Wno-shadow -Wno-undef -frounding-math -Itests/unit -MF $@.d -MT $@ -o $@ $< $(LIB) $(LDFLAGS) -lcmocka -lOpenMeshCore $(LIBS)

.PHONY: unit
## unit: build the unit tests of this CONFIG
unit: $(UNIT)


# ---- what people type ---------------------------------------------------------------------------------------------
# The package list decides flags (pkg-config), so installing comes first and the build is a second make.
.PHONY: demo run-demo
## demo: install what is missing, build, mesh geo/conge.geo to conge.msh, .vtk, .svg and .png, print the report
demo:
	$(Q)sh tests/install-packages.sh build
	$(Q)$(MAKE) --no-print-directory run-demo

run-demo: meshgen
	./meshgen -2 geo/conge.geo -o conge.msh -o conge.vtk -o conge.svg -o conge.png

.PHONY: check run-check
## check: install what the tests need, build everything, run all tests (last line: N passed, N failed)
check:
	$(Q)sh tests/install-packages.sh build test
	$(Q)$(MAKE) --no-print-directory run-check

run-check: all unit
	$(Q)tests/run.sh all

.PHONY: check-asan check-stress
## check-asan: unit and script tests under address and undefined-behaviour sanitizers
check-asan:
	$(Q)sh tests/install-packages.sh build test asan
	$(Q)$(MAKE) --no-print-directory CONFIG=asan program unit
	$(Q)CONFIG=asan tests/run.sh quick

## check-stress: the same in the stress build (arrays that always move, validators after every change)
check-stress:
	$(Q)sh tests/install-packages.sh build test
	$(Q)$(MAKE) --no-print-directory CONFIG=stress program unit
	$(Q)CONFIG=stress tests/run.sh quick

.PHONY: check-predicates
## check-predicates: signs of 10^7 random and adversarial cases against CGAL's exact numbers and MPFR (minutes)
check-predicates:
	$(Q)sh tests/install-packages.sh build test
	$(Q)$(MAKE) --no-print-directory unit
	$(Q)PREDICATE_CASES=$(or $(CASES),10000000) $(B)/unit/test_predicates

# Each fuzzer runs FUZZ_SECONDS over a corpus kept between runs in build/fuzz/corpus-<name>; what it finds stays in build/fuzz.
FUZZ_SECONDS ?= 60
.PHONY: fuzz run-fuzz
## fuzz: libFuzzer over scripts and mesh files, FUZZ_SECONDS (60) each; finds are left in build/fuzz
fuzz:
	$(Q)sh tests/install-packages.sh build asan test
	$(Q)$(MAKE) --no-print-directory CONFIG=fuzz CC=clang CXX=clang++ run-fuzz

run-fuzz: $(LIB)
	$(Q)sh tests/fuzz/run.sh "$(CC) $(CFLAGS_ALL) -fsanitize=fuzzer" "$(LIB) -lstdc++ $(LIBS)" $(B) $(FUZZ_SECONDS)

.PHONY: check-layers check-headers style metrics coverage
## check-layers: which folder includes which, against the table of docs/architecture.md; do comments and documents name what is there
check-layers:
	$(Q)sh tests/check-layers.sh
	$(Q)python3 tests/check_comments.py

## check-headers: every header compiles alone as C, and the public ones as C++, which oracles and benches are written in
check-headers:
	$(Q)for h in src/*/*.h; do \
	  echo "#include \"$${h#src/}\"" | $(CC) $(filter-out -MMD -MP,$(CFLAGS_ALL)) -fsyntax-only -x c - || exit 1; \
	  case $$h in *_int.h) continue ;; esac; \
	  echo "extern \"C\" {@#include \"$${h#src/}\"@}" | tr @ '\n' | \
	    $(CXX) $(filter-out -MMD -MP -Wpedantic -Wshadow,$(CXXFLAGS_ALL)) $(PKG_CFLAGS) -fsyntax-only -x c++ - || exit 1; \
	done; echo "all headers compile alone"

## style: what clang-format would change (a place to look, not a verdict)
style:
	$(Q)clang-format --dry-run src/*/*.c src/*/*.h 2>&1 | grep -c warning: || true

## metrics: the longest files and functions
metrics:
	$(Q)wc -l src/*/*.[ch]* | sort -n | tail -15

## coverage: line coverage of the unit and script tests (gcovr)
coverage:
	$(Q)$(MAKE) --no-print-directory CONFIG=cov program unit
	$(Q)CONFIG=cov tests/run.sh quick
	$(Q)gcovr -r . --object-directory build/cov src 2>/dev/null | tail -40

## pictures: the pictures of README and of docs/examples.md and docs/tutorial.md anew, by their own commands
.PHONY: pictures
PICTURES := $(CURDIR)/$(B)/pictures
pictures: all
	$(Q)rm -rf $(PICTURES) && mkdir -p $(PICTURES)/bin && ln -s $(CURDIR)/$(PROGRAM) $(PICTURES)/bin/meshgen
	$(Q)for d in examples tutorial; do \
	  mkdir $(PICTURES)/$$d && ln -s $(CURDIR)/geo $(PICTURES)/$$d/geo && \
	  awk '/^```sh$$/ { on = 1; next } /^```/ { on = 0 } on' docs/$$d.md >$(PICTURES)/$$d/block.sh && \
	  (cd $(PICTURES)/$$d && PATH=$(PICTURES)/bin:$$PATH bash -eu block.sh >said.txt 2>&1) || exit 1; done
	$(Q)cp $(PICTURES)/examples/*.png docs/pictures
	$(Q)for p in bracket fine quads change; do cp $(PICTURES)/tutorial/$$p.png docs/pictures/tutorial_$$p.png; done
	./meshgen -2 geo/conge.geo -v 2 -no_report -o docs/conge.png

## man: rewrite the generated part of meshgen.1 from the tables
.PHONY: man
man: all
	$(Q)sh tests/update-man.sh $(PROGRAM)

# ---- installing ---------------------------------------------------------------------------------------------------
.PHONY: install uninstall clean help
# Where each shell looks for completions; what goes there is printed by the program.
COMPLETION_bash := $(DESTDIR)$(datadir)/bash-completion/completions/meshgen
COMPLETION_zsh := $(DESTDIR)$(datadir)/zsh/site-functions/_meshgen
COMPLETION_fish := $(DESTDIR)$(datadir)/fish/vendor_completions.d/meshgen.fish
COMPLETIONS := $(foreach s,bash zsh fish,$(COMPLETION_$(s)))

## install: program, manual page and completions for bash, zsh and fish under prefix (DESTDIR is honoured)
install: program
	install -d $(DESTDIR)$(bindir) $(DESTDIR)$(mandir)/man1 $(dir $(COMPLETIONS))
	install -m 755 $(PROGRAM) $(DESTDIR)$(bindir)/meshgen
	install -m 644 meshgen.1 $(DESTDIR)$(mandir)/man1/meshgen.1
	$(foreach s,bash zsh fish,$(PROGRAM) -completion $(s) >$(COMPLETION_$(s)) &&) chmod 644 $(COMPLETIONS)

## uninstall: remove what install put there
uninstall:
	rm -f $(DESTDIR)$(bindir)/meshgen $(DESTDIR)$(mandir)/man1/meshgen.1 $(COMPLETIONS)

## clean: remove all that was built
clean:
	rm -rf build meshgen

## help: this list. CONFIG=release|debug|asan|stress|cov|fuzz, V=1, DEVELOPER=1 (-Werror), MARCH=-march=native
help:
	$(Q)sed -n 's/^## //p' $(MAKEFILE_LIST) | sort

-include $(OBJ:.o=.d) $(UNIT:%=%.d)
-include $(wildcard tests/bench/*.mk)
