# Ambulo: build, test, check, install. `make help` lists the targets.
#
#   make VARIANT=debug|san|cov   other builds, each in a folder of its own
#   make CC=clang CFLAGS=-O3     another compiler, flags added at the end
#   make JOBS=1                  compile and test one thing at a time

VARIANT ?= release
PREFIX ?= /usr/local
JOBS ?= $(shell nproc 2>/dev/null || echo 2)
PKG_CONFIG ?= pkg-config

ifeq ($(VARIANT),release)
  OUT := build
  MODE := -O3 -g
else ifeq ($(VARIANT),debug)
  OUT := build/debug
  MODE := -O0 -g3
else ifeq ($(VARIANT),san)
  OUT := build/san
  # the instrumentation hides value ranges from the compiler, whose warnings about lengths
  # and initialization are then often wrong: they stay warnings here
  MODE := -O1 -g1 -fno-omit-frame-pointer -fsanitize=address,undefined \
    -fno-sanitize-recover=undefined -Wno-error
else ifeq ($(VARIANT),fuzz)
  # clang's alone; programs are linked with libFuzzer (tests/fuzz)
  OUT := build/fuzz
  MODE := -O1 -g1 -fno-omit-frame-pointer -fsanitize=fuzzer-no-link,address,undefined \
    -fno-sanitize-recover=undefined -Wno-error
else ifeq ($(VARIANT),tsan)
  OUT := build/tsan
  MODE := -O1 -g1 -fno-omit-frame-pointer -fsanitize=thread -Wno-error
else ifeq ($(VARIANT),cov)
  OUT := build/cov
  MODE := -O0 -g --coverage
else ifeq ($(VARIANT),way)
  OUT := build/way
  MODE := -O0 -g -finstrument-functions
else
  $(error VARIANT is '$(VARIANT)'; expected release, debug, san, fuzz, tsan, cov or way)
endif

# ------------------------------------------------------------------- flags

VERSION := $(shell sed -n 's/^.define AMBULO_VERSION_STRING "\(.*\)"/\1/p' include/ambulo/ambulo.h)
# of the first number; in 0.x, where every minor release may break, of both (docs/release.md)
SOVERSION := $(shell echo $(VERSION) | sed -E 's/^(0\.[0-9]+|[0-9]+)\..*/\1/')
MACHINE := $(shell $(CC) -dumpmachine 2>/dev/null || uname -m)
X86 := $(filter x86_64%,$(MACHINE))

CLANG := $(findstring clang,$(shell $(CC) --version 2>/dev/null))

WARNINGS := -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wstrict-prototypes \
  -Wmissing-prototypes -Wvla -Werror

# Floating point, decided here once.
# Everywhere: no contraction, so that a*b + c rounds twice on every compiler and processor and
# a result does not depend on how an expression happened to be grouped; no errno, which nothing
# here reads and which keeps sqrt from being one instruction. Never -ffast-math: the code
# tests for NaN and infinity.
# Kernels (the innermost recursion over time nodes, and band matrices): the same, so that every
# instruction set rounds alike and a solve ends in the same valley on every processor. No trap is ever enabled, so operations may be moved across branches. With the 32
# registers of AVX-512, gcc's scheduling before registers are given out pays (Jacobians 6 %, with
# the costs of a processor that has them; gradients 1 to 3 %); with 16 it does not.
FLOATING := -ffp-contract=off -fno-math-errno
KERNEL := -O3 -ffp-contract=off -fno-math-errno -fno-trapping-math -Wno-psabi $(if $(CLANG),-Wno-pass-failed)
KERNEL_avx512 := -mavx512f -mavx512dq -mavx512vl -mfma -mprefer-vector-width=512 \
  -mtune=skylake-avx512 $(if $(CLANG),,-fschedule-insns -fsched-pressure)
KERNEL_avx2 := -mavx2 -mfma

# A fault that is left shall end the program, not go on: the library and the program are built to see
# broken stacks and writes past a known size, tables of addresses are read-only once they are filled in.
# Kernels have no buffers of a length that an input decides, and their loops are what a solve waits for.
# (lint-hardening looks at what was built.)
ifeq ($(VARIANT),release)
  HARDENED := -fstack-protector-strong -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2
  KERNEL += -fno-stack-protector
endif

# What debuggers read names files from here: the folder of a build is in none of its bytes
# (make check-reproducible).
ifeq ($(VARIANT),release)
  PLACELESS = -ffile-prefix-map=$(CURDIR)=.
endif

# with ENGINE=1, as `make engine` has it, src/engine is all there is
ALL_CPPFLAGS = -Iinclude $(if $(ENGINE),,-Isrc -Isrc/files )-Isrc/engine -D_POSIX_C_SOURCE=200809L -DAMBULO_BUILDING_SHARED $(CPPFLAGS)
ALL_CFLAGS = -std=c11 $(WARNINGS) $(MODE) $(FLOATING) -fPIC -fvisibility=hidden

# Libraries by pkg-config where it knows them, by their usual names otherwise.
probe = $(shell $(PKG_CONFIG) --exists $(1) 2>/dev/null && $(PKG_CONFIG) $(2) $(1))
libs_of = $(or $(call probe,$(1),--libs),$(2))
links = $(shell echo 'int main(void) { return 0; }' | \
  $(CC) -x c - $(1) -o /dev/null 2>/dev/null && echo yes)
LAPACK_LIBS = $(or $(call probe,openblas,--libs),$(if $(call links,-lopenblas),-lopenblas),\
  $(call probe,lapack blas,--libs),-llapack -lblas)
ifeq ($(shell uname -s),Darwin)
  export PKG_CONFIG_PATH := $(PKG_CONFIG_PATH):$(shell brew --prefix openblas 2>/dev/null)/lib/pkgconfig
  ARCHIVE_FLAGS := rcs
  # what POSIX alone does not name: MAP_ANONYMOUS, _SC_NPROCESSORS_ONLN
  ALL_CPPFLAGS += -D_DARWIN_C_SOURCE
  shared_name = libambulo$(if $(ENGINE),_engine)$(1).dylib
  SHARED := -dynamiclib -install_name @rpath/$(call shared_name,.$(SOVERSION))
else
  # D: neither times nor owners
  ARCHIVE_FLAGS := rcsD
  shared_name = libambulo$(if $(ENGINE),_engine).so$(1)
  HARDENED_LINK = $(if $(filter release,$(VARIANT)),-Wl$(comma)-z$(comma)relro -Wl$(comma)-z$(comma)now -Wl$(comma)-z$(comma)noexecstack)
  # the engine's functions are of version AMBULO_0, those of the tools of AMBULO_TOOLS_0
  VERSIONS = $(OUT)/obj/libambulo.map
  SHARED = -shared -Wl,-soname,$(call shared_name,.$(SOVERSION)) -Wl,--version-script=$(VERSIONS) $(if $(filter san,$(VARIANT)),,-Wl,-z,defs)
endif
DEPENDENCIES := nlopt $(if $(ENGINE),,yaml-0.1)
DEPENDENCY_CFLAGS := $(foreach name,$(DEPENDENCIES),$(call probe,$(name),--cflags))
LIBS := $(call libs_of,nlopt,-lnlopt) $(if $(ENGINE),,$(call libs_of,yaml-0.1,-lyaml)) $(strip $(LAPACK_LIBS)) -lm -lpthread
ifndef ENGINE
# expat is optional: without it `ambulo import` says so
EXPAT := $(if $(call links,-include expat.h -lexpat),$(call libs_of,expat,-lexpat))
DEPENDENCY_CFLAGS += $(if $(EXPAT),-DAMBULO_HAS_EXPAT $(call probe,expat,--cflags))
LIBS += $(EXPAT)
# zlib too: without it the page of `ambulo report` is larger
ZLIB := $(if $(call links,-include zlib.h -lz),$(call libs_of,zlib,-lz))
DEPENDENCY_CFLAGS += $(if $(ZLIB),-DAMBULO_HAS_ZLIB $(call probe,zlib,--cflags))
LIBS += $(ZLIB)
endif
CMOCKA := $(call libs_of,cmocka,-lcmocka)
ALL_CPPFLAGS += $(DEPENDENCY_CFLAGS)

SHARED_LIBRARY = $(OUT)/$(call shared_name,)
ARCHIVE := $(OUT)/libambulo$(if $(ENGINE),_engine)$(if $(READERS),_readers).a

# ----------------------------------------------------------------- sources

# with READERS=1, as `make sanitize-engine` has it, src/engine and src/files, which its tests need
SOURCES := $(sort $(wildcard src/engine/*/*.c) $(if $(ENGINE),,$(wildcard src/files/*/*.c)) \
  $(if $(ENGINE)$(READERS),,$(wildcard src/*/*.c)))
ifeq ($(X86),)
  SOURCES := $(filter-out src/engine/mechanics/kernels_avx%.c src/engine/linear/band_kernels_avx%.c src/engine/muscle/kernels_avx%.c,$(SOURCES))
endif
CLI_SOURCES := $(filter src/cli/%,$(SOURCES))
LIB_OBJECTS := $(patsubst %.c,$(OUT)/obj/%.o,$(filter-out $(CLI_SOURCES),$(SOURCES))) \
  $(if $(ENGINE)$(READERS),,$(OUT)/obj/viewer.o $(OUT)/obj/engine_digest.o)
CLI_OBJECTS := $(patsubst %.c,$(OUT)/obj/%.o,$(CLI_SOURCES))
TEST_SOURCES := $(sort $(wildcard tests/*/test_*.c))
TESTS := $(patsubst %.c,$(OUT)/%,$(TEST_SOURCES))
BENCH_SOURCES := $(sort $(wildcard bench/bench_*.c))
BENCHES := $(patsubst %.c,$(OUT)/%,$(BENCH_SOURCES))
HEADERS := $(sort $(wildcard include/ambulo/*.h include/ambulo/tools/*.h))

.DEFAULT_GOAL := all
.DELETE_ON_ERROR:
.SUFFIXES:
.PHONY: all help setup demo check check-long run-long way engine test-engine sanitize-engine run-engine-tests tests test-objects run-tests bench bench-table1 bench-table4 bench-peers \
  sanitize fuzz check-threads run-threads valgrind check-kill check-faults check-slurm check-page check-python truth setup-truth check-judge wheel viewer coverage mutate \
  lint lint-format lint-static lint-order lint-size lint-symbols lint-hardening lint-abi lint-callers lint-mirror \
  lint-headers lint-interface \
  lint-equations lint-reading lint-keys lint-architecture lint-words lint-leftovers format \
  install uninstall clean force

# A second make with as many jobs as there are processors, unless -j was given. It also reads
# this file afresh, after the set-up may have installed what pkg-config is asked for.
submake = +@$(MAKE) --no-print-directory $(if $(filter -j% --jobserver%,$(MAKEFLAGS)),,-j$(JOBS))

help:
	@echo 'make              build/ambulo, build/libambulo.a, build/libambulo.so'
	@echo 'make demo         install what is missing, build, solve models/walk.yaml'
	@echo 'make check        install what is missing, build, run all tests'
	@echo 'make check-long   what takes longer: every page, packages, users'\'' ways, Python, the report in a browser'
	@echo 'make check-kill   five hundred random kills of a batch, then the same table'
	@echo 'make check-faults  calls that fail under each command, one after another (EVERY=100000: all)'
	@echo 'make check-slurm  a batch as a Slurm array and under GNU parallel, where they are installed'
	@echo 'make check-page   the page of ambulo report in a browser (chromium)'
	@echo 'make viewer       that page from its sources in src/show/viewer (npm)'
	@echo 'make check-python tests of the Python package with all that is optional, in an environment of its own'
	@echo 'make truth        motions of models/ rebuilt in Pinocchio: what no body could do (PROBLEMS="walk lift")'
	@echo 'make setup-truth  Pinocchio, for make truth, in build/python-venv'
	@echo 'make check-judge  problems stated anew in CasADi: same values, in extended precision too; what IPOPT still gains'
	@echo 'make wheel        the Python package as build/wheel/ambulo-*.whl'
	@echo 'make way          the files that one solve enters, in order (PROBLEM=models/walk.yaml)'
	@echo 'make engine       src/engine alone, with NLopt and LAPACK: build/engine/libambulo_engine.a, and its tests'
	@echo 'make sanitize-engine  tests of src/engine with sanitizers'
	@echo 'make sanitize     the same with address and undefined-behaviour sanitizers'
	@echo 'make check-threads  eight threads on shared objects, under the thread sanitizer'
	@echo 'make fuzz         every reader of files by libFuzzer (clang), 10 s each: SECONDS=600 TARGETS="model batch"'
	@echo 'make valgrind     a few test programs under valgrind'
	@echo 'make coverage     lines and branches that the tests reach, by room'
	@echo 'make mutate       mistaken changes that the tests of a room do not see: ROOM=solver COUNT=15 SEED=1'
	@echo 'make lint         format, static analysis, folder order, sizes, symbols, callers, test mirror'
	@echo 'make format       clang-format everything'
	@echo 'make bench        time every layer; results and changes in bench/results'
	@echo 'make bench-table1 three formulations of the same problems, as in Table 1 of the source paper'
	@echo 'make bench-table4 the nine cells of Table 4 of the source paper'
	@echo 'make bench-peers  mechanics and solves beside other programs, in one run'
	@echo 'make setup        only install what is missing'
	@echo 'make install      to PREFIX (/usr/local), below DESTDIR if set; make uninstall'
	@echo 'make deb          Debian packages of the build, in build/deb; lintian, where it is there'
	@echo 'make sbom         what a build links and bundles, with licences, as CycloneDX: build/sbom.cdx.json'
	@echo 'make check-reproducible  two builds in unlike surroundings: library, program, wheel and packages equal in every byte'
	@echo 'make book         the pages of docs/ as one, build/book/ambulo.html (needs pandoc)'
	@echo 'make cross-objects  compile for aarch64 and for musl, where the compilers are there'
	@echo 'make clean        remove build/'
	@echo 'variables         VARIANT=release|debug|san|fuzz|cov  CC=  CFLAGS=  LDFLAGS=  JOBS=  V=1'

# ------------------------------------------------------------------- build

all: $(ARCHIVE) $(SHARED_LIBRARY) $(if $(CLI_SOURCES),$(OUT)/ambulo)

# rewritten only when what it says changes: objects are rebuilt with new flags, archives
# with a new list of sources
define RECORD
@mkdir -p $(@D); echo '$(1)' | cmp -s - $@ || echo '$(1)' > $@
endef
$(OUT)/obj/flags: force | build/.found
	$(call RECORD,$(CC) $(ALL_CPPFLAGS) $(ALL_CFLAGS) $(HARDENED) $(PLACELESS) $(KERNEL) $(KERNEL_avx512) $(KERNEL_avx2) $(CFLAGS))
SOURCES_RECORD := $(OUT)/obj/$(notdir $(ARCHIVE)).sources
$(SOURCES_RECORD): force
	$(call RECORD,$(SOURCES) $(LDFLAGS) $(LIBS))

# commands are shown with V=1
quiet = $(if $(V),,@echo '  $(1)'; )
kernel_flags = $(KERNEL) $(KERNEL_$(patsubst kernels_%,%,$(patsubst band_%,%,$(basename $(notdir $<)))))
compile = $(call quiet,CC $<)$(CC) $(ALL_CPPFLAGS) $(ALL_CFLAGS) $(if $(filter src/%,$<),$(HARDENED)) $(if $(filter tests/% bench/%,$<),,$(PLACELESS)) $(1) $(CFLAGS) -MMD -MP -c $< -o $@

define compile_kernel
	@mkdir -p $(@D)
	$(call compile,$(if $(filter release cov,$(VARIANT)),$(kernel_flags),$(filter-out -O3,$(kernel_flags))) \
	  $(if $(filter fuzz tsan,$(VARIANT)),-fno-sanitize=all))
endef
$(OUT)/obj/src/engine/mechanics/kernels_%.o: src/engine/mechanics/kernels_%.c $(OUT)/obj/flags
	$(compile_kernel)
$(OUT)/obj/src/engine/muscle/kernels_%.o: src/engine/muscle/kernels_%.c $(OUT)/obj/flags
	$(compile_kernel)
$(OUT)/obj/src/engine/linear/band_kernels_%.o: src/engine/linear/band_kernels_%.c $(OUT)/obj/flags
	$(compile_kernel)

$(OUT)/obj/%.o: %.c $(OUT)/obj/flags
	@mkdir -p $(@D)
	$(call compile,$(if $(filter tests/%,$<),$(TEST_MODE)) $(if $(filter tests/% bench/%,$<),-Itests$(if $(ENGINE), -Isrc -Isrc/files))$(if $(filter bench/peers/%,$<), -Ibench))

# the page of `ambulo report`, as an array of bytes (src/show/page.h); the zero behind it ends a text
$(OUT)/obj/viewer.c: src/show/viewer.html Makefile
	@mkdir -p $(@D)
	$(call quiet,GEN $@){ echo '#include "show/page.h"'; echo 'const unsigned char ambulo__viewer[] = {'; \
	  od -An -v -t u1 $< | sed 's/[0-9][0-9]*/&,/g'; echo '0};'; \
	  echo 'const size_t ambulo__viewer_size = sizeof ambulo__viewer - 1;'; } > $@
$(OUT)/obj/viewer.o: $(OUT)/obj/viewer.c $(OUT)/obj/flags
	$(call compile,)

# which engine this is: results are those of its sources (src/show/summary_json.h)
ENGINE_FILES := $(sort $(wildcard include/ambulo/*.h src/engine/*/*.[ch]))
$(OUT)/obj/engine_digest.c: $(ENGINE_FILES) $(SOURCES_RECORD) Makefile
	@mkdir -p $(@D)
	$(call quiet,GEN $@)digest=$$(cat $(ENGINE_FILES) | { sha256sum 2>/dev/null || shasum -a 256; } | cut -c1-16) && \
	  { echo '#include "show/summary_json.h"'; \
	  echo "const char ambulo__engine_digest[] = \"$$digest\";"; } > $@
$(OUT)/obj/engine_digest.o: $(OUT)/obj/engine_digest.c $(OUT)/obj/flags
	$(call compile,)

$(ARCHIVE): $(LIB_OBJECTS) $(SOURCES_RECORD)
	@rm -f $@
	$(call quiet,AR $@)$(AR) $(ARCHIVE_FLAGS) $@ $(LIB_OBJECTS)

$(OUT)/obj/libambulo.map: $(HEADERS) .setup/symbols.sh
	@mkdir -p $(@D); .setup/symbols.sh map > $@

$(SHARED_LIBRARY): $(LIB_OBJECTS) $(SOURCES_RECORD) $(VERSIONS)
	$(call quiet,LD $@)$(CC) $(MODE) $(SHARED) $(HARDENED_LINK) $(LIB_OBJECTS) $(LDFLAGS) $(LIBS) -o $@

# one variant reports which functions it enters
TRACER := $(if $(filter way,$(VARIANT)),$(OUT)/obj/tests/support/way.o)
$(OUT)/ambulo: $(CLI_OBJECTS) $(ARCHIVE) $(TRACER)
	$(call quiet,LD $@)$(CC) $(MODE) $(if $(HARDENED_LINK),-pie $(HARDENED_LINK)) $(CLI_OBJECTS) $(TRACER) $(ARCHIVE) $(LDFLAGS) $(LIBS) -o $@

# Tests of a release are compiled at -O1 and linked without what debuggers read: the library is what is
# fast, and four hundred programs are compiled and linked in half of the time.
TEST_MODE := $(if $(filter release,$(VARIANT)),-O1)
comma := ,
TEST_LINK := $(if $(filter release,$(VARIANT)),-Wl$(comma)-S)

# the parts of the program are linked into its tests, its main() is not
CLI_PARTS := $(filter-out %/main.o,$(CLI_OBJECTS))
$(OUT)/tests/cli/test_%: $(OUT)/obj/tests/cli/test_%.o $(CLI_PARTS) $(ARCHIVE)
	@mkdir -p $(@D)
	$(call quiet,LD $@)$(CC) $(MODE) $(TEST_LINK) $< $(CLI_PARTS) $(ARCHIVE) $(LDFLAGS) $(CMOCKA) $(LIBS) -o $@

$(OUT)/tests/%: $(OUT)/obj/tests/%.o $(ARCHIVE)
	@mkdir -p $(@D)
	$(call quiet,LD $@)$(CC) $(MODE) $(TEST_LINK) $< $(ARCHIVE) $(LDFLAGS) $(CMOCKA) $(LIBS) -o $@

# calls that fail under every command: a library in front of that of C, which no variant instruments
ifeq ($(shell uname -s),Linux)
$(OUT)/tests/faults/test_commands: $(OUT)/tests/faults/preload.so
endif
$(OUT)/tests/faults/preload.so: tests/faults/preload.c tests/faults/faults.h
	@mkdir -p $(@D)
	$(call quiet,LD $@)$(CC) $(ALL_CPPFLAGS) -Itests -std=c11 $(WARNINGS) -O1 -fPIC -shared $< -ldl -o $@

$(OUT)/bench/%: $(OUT)/obj/bench/%.o $(ARCHIVE)
	@mkdir -p $(@D)
	$(call quiet,LD $@)$(CC) $(MODE) $< $(ARCHIVE) $(LDFLAGS) $(LIBS) -o $@

.SECONDARY:
-include $(wildcard $(OUT)/obj/*/*.d $(OUT)/obj/*/*/*.d $(OUT)/obj/*/*/*/*.d)

# --------------------------------------------------- set-up, demo and tests

# installs only what is missing for a purpose; the stamp makes it instant afterwards
build/.ready-%: .setup/install.sh
	@CC='$(CC)' .setup/install.sh $*
	@mkdir -p build && touch $@ build/.found
# a plain make only says what is missing
build/.found:
	@CC='$(CC)' .setup/install.sh build --list
	@mkdir -p build && touch $@
setup: build/.ready-test

demo: build/.ready-build
	$(submake) all
	build/ambulo solve models/walk.yaml -o build/demo --force

check: build/.ready-test
	$(submake) run-tests

# What make check runs beside the programs: scripts of rooms, the cases of the program a file at a time.
# make check-long runs what takes minutes, or needs what is not always there: tests/ROOM/long*.sh, and
# every page of the docs. SCRIPT:ARGUMENT is a script with an argument.
SCRIPTS := $(patsubst %,tests/cli/run.sh:%,$(notdir $(sort $(wildcard tests/cli/*.txt)))) \
  $(filter-out tests/cli/run.sh,$(sort $(wildcard tests/*/run.sh tests/*/run_*.sh)))
LONG_SCRIPTS := tests/docs/run.sh:--all $(sort $(wildcard tests/*/long*.sh))
LONG_TESTS := $(filter %/test_sensitivity_reference %/test_mirror %/test_auglag %/test_starts %/walks/test_run %/test_bounces \
  %/test_obstacles %/test_held_tasks %/test_ground_work %/walks/test_walk %/test_whole_body \
  %/test_sensitivity_errors %/test_node_types %/test_numbers_body %/test_numbers_walk %/test_numbers_task %/test_numbers_muscles \
  %/test_event_times %/test_differences %/test_step_rows %/test_sensitivity_surface %/test_front_faults,$(TESTS))

tests: $(TESTS)
# what tests are compiled to, without linking: is every call still right?
test-objects: $(patsubst %.c,$(OUT)/obj/%.o,$(TEST_SOURCES) $(BENCH_SOURCES))

# every program that was built runs, whatever became of the others; a failed build is a failure
run-tests:
	+@status=0; $(MAKE) --no-print-directory -k all tests || status=$$?; \
	  BUILD_STATUS=$$status JOBS=$(JOBS) OUT=$(OUT) CC='$(CC)' CFLAGS='$(CFLAGS)' \
	  CPPFLAGS='$(CPPFLAGS)' LDFLAGS='$(LDFLAGS)' MODE='$(MODE)' tests/support/all.sh $(SCRIPTS) $(TESTS)

check-long: build/.ready-test
	$(submake) run-long
run-long: all $(LONG_TESTS) $(OUT)/tests/faults/test_commands
	@JOBS=$(JOBS) OUT=$(OUT) CC='$(CC)' CFLAGS='$(CFLAGS)' CPPFLAGS='$(CPPFLAGS)' LDFLAGS='$(LDFLAGS)' \
	  MODE='$(MODE)' AMBULO_LONG=1 AMBULO_FAULTS_EVERY=$(EVERY) tests/support/all.sh $(LONG_SCRIPTS) $(LONG_TESTS) $(OUT)/tests/faults/test_commands

check-kill: build/.ready-build
	$(submake) all
	@AMBULO=$(OUT)/ambulo KILLS=500 SWEEP=models/sweep_walk.yaml tests/study/kill_test.sh

# calls that fail under each command, every one up to the EVERY-th of a kind, then at growing distances
EVERY ?= 40
check-faults: build/.ready-test
	$(submake) all $(OUT)/tests/faults/test_commands
	@AMBULO='$(CURDIR)/$(OUT)/ambulo' AMBULO_FAULTS_EVERY=$(EVERY) OPENBLAS_NUM_THREADS=1 $(OUT)/tests/faults/test_commands

check-slurm: build/.ready-build
	$(submake) all
	@AMBULO=$(OUT)/ambulo tests/study/cluster_test.sh

# Python, from PyPI, in build/python-venv; `make check` uses what there is
PYTHON_PATH = PATH='$(CURDIR)/build/python-venv/bin':"$$PATH"
wheel: build/.ready-build build/.ready-python
	$(submake) $(SHARED_LIBRARY) $(OUT)/ambulo
	@$(PYTHON_PATH); if PYTHON=python .setup/old_glibc.sh $(OUT) $(OUT)/old-glibc; \
	  then library=$(OUT)/old-glibc/libambulo.so; else [ $$? = 3 ] || exit 1; library=$(SHARED_LIBRARY); fi; \
	  LD_LIBRARY_PATH="$(CURDIR)/$(OUT)/old-glibc" python src/python/package.py wheel $$library $(OUT)/wheel

check-python: build/.ready-build build/.ready-python
	$(submake) all
	@$(PYTHON_PATH) PYTHON=python OUT=$(OUT) CC='$(CC)' MODE='$(MODE)' tests/python/long.sh

# Pinocchio is asked for by setup-truth alone; without it make truth is skipped, with a word
setup-truth: build/.ready-truth
truth: build/.ready-build
	$(submake) all
	@$(PYTHON_PATH) $(or $(AMBULO_PYTHON),python3) tests/truth/truth.py --ambulo $(OUT)/ambulo --results $(OUT)/truth \
	  --markdown $(OUT)/truth.md --jobs $(JOBS) $(PROBLEMS)

check-judge: build/.ready-build build/.ready-judge
	$(submake) $(SHARED_LIBRARY) $(OUT)/ambulo
	@$(PYTHON_PATH) python src/python/package.py stage $(SHARED_LIBRARY) $(OUT)/judge/python
	@$(PYTHON_PATH) PYTHONPATH=$(OUT)/judge/python python tests/truth/judge.py $(OUT)/ambulo models $(OUT)/judge $(PROBLEMS)

# threads on shared objects, under the thread sanitizer
THREAD_TESTS := $(OUT)/tests/api/test_shared $(OUT)/tests/api/test_threads
check-threads: build/.ready-test
	$(submake) VARIANT=tsan run-threads
run-threads: $(THREAD_TESTS)
	@TEST_WRAPPER='setarch -R' JOBS=$(JOBS) OUT=$(OUT) MODE='$(MODE)' tests/support/all.sh $(THREAD_TESTS)

# Targets of tests/fuzz, a program each, for so many seconds each: make fuzz SECONDS=600 TARGETS="model batch"
SECONDS ?= 10
TARGETS ?=
FUZZ_TARGETS = $(or $(TARGETS),$(notdir $(wildcard tests/fuzz/seeds/*)))
fuzz: build/.ready-test
	@command -v clang >/dev/null || { echo 'skipped: make fuzz: no clang'; exit 1; }
	$(submake) CC=clang VARIANT=fuzz $(patsubst %,build/fuzz/%,$(FUZZ_TARGETS))
	@JOBS=$(JOBS) tests/fuzz/fuzz.sh build/fuzz $(SECONDS) $(FUZZ_TARGETS)
ifeq ($(VARIANT),fuzz)
$(patsubst %,$(OUT)/%,$(FUZZ_TARGETS)): $(OUT)/%: tests/fuzz/fuzz.c $(wildcard tests/fuzz/*.h) $(ARCHIVE)
	@mkdir -p $(@D)
	$(call quiet,LD $@)$(CC) $(ALL_CPPFLAGS) -Itests $(ALL_CFLAGS) -fsanitize=fuzzer -DFUZZ_TARGET=$* $< $(ARCHIVE) \
	  $(LDFLAGS) $(CMOCKA) $(LIBS) -o $@
endif

sanitize: build/.ready-test
	$(submake) VARIANT=san run-tests

# one thread: OpenBLAS gains nothing on matrices of this size
bench: build/.ready-build
	$(submake) $(BENCHES)
	@for program in $(BENCHES); do OPENBLAS_NUM_THREADS=1 $$program || exit 1; done

bench-table1: build/.ready-build
	$(submake) $(OUT)/bench/table1
	@OPENBLAS_NUM_THREADS=1 $(OUT)/bench/table1

bench-table4: build/.ready-build
	$(submake) $(OUT)/bench/table4
	@OPENBLAS_NUM_THREADS=1 $(OUT)/bench/table4

# the page of `ambulo report` from its sources: needs npm, and the packages of package-lock.json
viewer:
	@rm -rf build/viewer && mkdir -p build && cp -R src/show/viewer build/viewer
	@cd build/viewer && npm ci --silent --no-audit --no-fund && node build.mjs ../../src/show/viewer.html

# the page in a browser, which is installed if it is missing; without one, `make check` skips this
check-page: build/.ready-page
	$(submake) all
	@AMBULO=$(OUT)/ambulo tests/show/long_page.sh

bench-peers: build/.ready-build
	$(submake) $(OUT)/ambulo $(OUT)/bench/peers/ours
	@OUT=$(OUT) sh bench/peers.sh

# the emulated processor has no AVX-512, so this also covers the narrower kernels
VALGRIND_TESTS ?= $(filter $(OUT)/tests/base/% $(OUT)/tests/model/% $(OUT)/tests/formats/% $(OUT)/tests/trajectory/%,$(TESTS))
valgrind: build/.ready-valgrind
	$(submake) $(VALGRIND_TESTS)
	@TEST_WRAPPER='valgrind -q --leak-check=full --error-exitcode=99' JOBS=$(JOBS) \
	  OUT=build/valgrind tests/support/all.sh $(VALGRIND_TESTS)

# the files that one solve enters, in order: make way PROBLEM=models/run.yaml
PROBLEM ?= models/walk.yaml
way: build/.ready-build
	$(submake) VARIANT=way build/way/ambulo
	@.setup/way.sh build/way/ambulo $(PROBLEM)

# the engine's rooms alone: what .ci/run can afford
ENGINE_ROOMS := $(notdir $(wildcard src/engine/*))
ENGINE_TESTS := $(filter $(addsuffix /%,$(addprefix $(OUT)/tests/,$(ENGINE_ROOMS))),$(TESTS))
# An archive of src/engine with NLopt, LAPACK and libc alone, and whatever of the rooms' tests needs no
# more: without files, most problems are out of reach. The library that is linked of it shows that
# nothing else is needed.
ENGINE_OBJECTS := $(patsubst %.c,$(OUT)/obj/%.o,$(wildcard $(patsubst %,tests/%/test_*.c,$(ENGINE_ROOMS) api)))
engine: build/.ready-test
	$(submake) ENGINE=1 OUT=build/engine test-engine
test-engine: all $(ENGINE_OBJECTS)
	@.setup/engine_tests.sh $(ARCHIVE) $(ENGINE_OBJECTS) > $(OUT)/tests.list
	+@programs=$$(sed 's#/obj/#/#; s#\.o$$##' $(OUT)/tests.list); $(MAKE) --no-print-directory -k $$programs; \
	  JOBS=$(JOBS) OUT=$(OUT) tests/support/all.sh $$programs

sanitize-engine: build/.ready-test
	$(submake) VARIANT=san READERS=1 run-engine-tests
run-engine-tests: $(ENGINE_TESTS)
	@JOBS=$(JOBS) OUT=$(OUT) MODE='$(MODE)' tests/support/all.sh $(ENGINE_TESTS)

coverage: build/.ready-test
	+@$(MAKE) --no-print-directory VARIANT=cov run-tests
	@.setup/coverage.py build/cov

# mistaken changes at random, one at a time, in a copy of the tree: which do the tests of their room not see?
ROOM ?= base
COUNT ?= 15
SEED ?= 1
mutate: build/.ready-test
	$(submake) all test-objects
	@tests/support/mutate.py --room $(ROOM) --count $(COUNT) --seed $(SEED)

# -------------------------------------------------------------------- lint

LINT := format static order size symbols hardening abi callers mirror headers interface equations reading keys architecture words leftovers
FORMATTED = $(wildcard include/ambulo/*.h include/ambulo/tools/*.h src/*/*.[ch] src/*/*/*.[ch] tests/*/*.[ch] bench/*.[ch] bench/peers/*.c \
  docs/examples/*.c)
# the kernels are one text compiled per instruction set: the baseline stands for all
TIDY_SOURCES = $(filter-out src/engine/mechanics/kernels_avx%.c src/engine/linear/band_kernels_avx%.c src/engine/muscle/kernels_avx%.c,$(SOURCES))

lint: build/.ready-lint
	+@failed=; for part in $(LINT); do echo "lint-$$part"; \
	  $(MAKE) --no-print-directory lint-$$part || failed="$$failed $$part"; done; \
	  if [ -n "$$failed" ]; then echo "lint failed:$$failed"; exit 1; fi; echo 'lint passed'

format: build/.ready-lint
	@clang-format -i $(FORMATTED)
lint-format: build/.ready-lint
	@clang-format --dry-run -Werror $(FORMATTED)
lint-static: build/.ready-lint
	@.setup/lint_static.sh $(JOBS) $(TIDY_SOURCES) -- -std=c11 $(ALL_CPPFLAGS)
lint-order: build/.ready-build
	$(submake) all
	@.setup/lint_order.sh $(OUT)/obj/src
lint-size:
	@.setup/lint_size.sh
lint-symbols: build/.ready-build
	$(submake) $(SHARED_LIBRARY) $(ARCHIVE)
	@.setup/lint_symbols.sh $(SHARED_LIBRARY) $(ARCHIVE)
lint-hardening: build/.ready-build
	$(submake) all
	@.setup/lint_hardening.sh $(SHARED_LIBRARY) $(OUT)/ambulo $(SOVERSION)
lint-callers: build/.ready-build
	$(submake) $(ARCHIVE) $(OUT)/ambulo
	@.setup/lint_callers.sh $(OUT)/obj/src
lint-mirror:
	@.setup/lint_mirror.sh
lint-headers:
	@CC='$(CC)' .setup/lint_headers.sh
lint-interface:
	@.setup/lint_interface.sh
lint-abi:
	@CC='$(CC)' .setup/lint_abi.sh
lint-equations:
	@.setup/lint_equations.sh
lint-reading:
	@.setup/lint_reading.sh
lint-keys:
	@.setup/lint_keys.sh
lint-architecture:
	@.setup/lint_architecture.sh
lint-words:
	@.setup/lint_words.sh
lint-leftovers:
	@! grep -nE '\b(TODO|FIXME|XXX)\b' -r $(wildcard src include tests models bench docs README* CHANGELOG*)

# ----------------------------------------------------------------- install

# PREFIX/lib, or where a distribution has libraries: make install LIBDIR=/usr/lib/x86_64-linux-gnu
LIBDIR ?= $(PREFIX)/lib
MODELS = $(shell find models -type f -name '*.yaml' -o -name '*.csv' -o -name '*.md' 2>/dev/null)
DOCS = LICENSE README.md CHANGELOG.md $(wildcard CITATION.cff CONTRIBUTING.md ARCHITECTURE.md docs/*.md docs/images/*.svg \
  docs/images/*.png docs/examples/*)

# where the loader does not look by itself, programs are told where the library is
RPATH = $(if $(filter /usr,$(PREFIX)),,-Wl,-rpath,$${libdir} )

define PKG_CONFIG_FILE
prefix=$(PREFIX)
libdir=$(if $(filter $(PREFIX)/%,$(LIBDIR)),$${prefix}$(LIBDIR:$(PREFIX)%=%),$(LIBDIR))
includedir=$${prefix}/include

Name: ambulo
Description: prediction of human motion by optimization
Version: $(VERSION)
Libs: -L$${libdir} $(RPATH)-lambulo
Libs.private: $(LIBS)
Cflags: -I$${includedir}
endef
export PKG_CONFIG_FILE

# "mode <tab> file <tab> place" of all that is installed
define PLACES
{ place() { printf '%s\t%s\t%s\n' "$$@"; }; share=$(PREFIX)/share; \
  place 755 $(OUT)/ambulo $(PREFIX)/bin/ambulo; \
  place 644 $(ARCHIVE) $(LIBDIR)/libambulo.a; \
  place 755 $(SHARED_LIBRARY) $(LIBDIR)/$(call shared_name,.$(VERSION)); \
  place link $(call shared_name,.$(VERSION)) $(LIBDIR)/$(call shared_name,.$(SOVERSION)); \
  place link $(call shared_name,.$(SOVERSION)) $(LIBDIR)/$(call shared_name,); \
  place 644 $$stage/ambulo.pc $(LIBDIR)/pkgconfig/ambulo.pc; \
  for file in ambulo-config.cmake ambulo-config-version.cmake; do \
    place 644 $$stage/$$file $(LIBDIR)/cmake/ambulo/$$file; done; \
  for file in $(HEADERS); do place 644 $$file $(PREFIX)/$$file; done; \
  for file in $(MODELS); do place 644 $$file $$share/ambulo/$$file; done; \
  for file in $(DOCS); do place 644 $$file $$share/doc/ambulo/$$file; done; \
  (cd $$stage/share && find . -type f) | sort | while read -r file; do \
    place 644 $$stage/share/$$file $$share/$${file#./}; done; }
endef

# in a folder of its own, so that two may go on at once
install: all
	@stage=$$(mktemp -d) && trap 'rm -rf "$$stage"' EXIT && \
	.setup/manual.sh $(OUT)/ambulo "$$stage/share" && \
	printf '%s\n' "$$PKG_CONFIG_FILE" > "$$stage/ambulo.pc" && \
	.setup/cmake_config.sh '$(VERSION)' '$(PREFIX)' '$(LIBDIR)' '$(LIBS)' "$$stage" && \
	$(PLACES) | .setup/place.sh install '$(DESTDIR)' '$(PREFIX)'
	@.setup/after_install.sh '$(DESTDIR)' '$(PREFIX)' '$(LIBDIR)'

uninstall:
	@.setup/place.sh uninstall '$(DESTDIR)' '$(PREFIX)'

.PHONY: book
book:
	@.setup/book.sh build/book/ambulo.html

.PHONY: objects cross-objects
objects: $(LIB_OBJECTS) $(CLI_OBJECTS)
cross-objects:
	@JOBS=$(JOBS) .setup/cross.sh aarch64
	@JOBS=$(JOBS) .setup/cross.sh musl

.PHONY: deb
deb: build/.ready-build
	$(submake) all
	@.setup/deb.sh $(OUT) build/deb
	@if command -v lintian >/dev/null; then lintian --fail-on error,warning build/deb/*.deb; fi

.PHONY: sbom
sbom: build/.ready-build
	$(submake) $(OUT)/ambulo
	@.setup/sbom.py $(OUT)/ambulo $(OUT)/sbom.cdx.json && echo $(OUT)/sbom.cdx.json

# two builds, two folders, two of everything that may differ between machines: the same bytes
.PHONY: check-reproducible
check-reproducible: build/.ready-build
	@JOBS=$(JOBS) CC='$(CC)' .setup/reproducible.sh

clean:
	rm -rf build
force:
