# Ambulo: build, test, check, install. `make help` lists the targets.
#
# Two commands are complete on a fresh machine: `make demo` and `make check`.

VARIANT ?= release
CC      ?= cc
PREFIX  ?= /usr/local

VERSION := $(shell sed -n 's/.*AMBULO_VERSION_STRING "\(.*\)"/\1/p' include/ambulo/ambulo.h)
SOVERSION := 0
UNAME_S := $(shell uname -s)
UNAME_M := $(shell uname -m)

BUILD := build
ifneq ($(VARIANT),release)
BUILD := build/$(VARIANT)
endif

WARNINGS := -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wstrict-prototypes \
            -Wmissing-prototypes -Wvla -Werror
# Contraction to fused multiply-add is off outside the kernels: the same source line then
# gives the same bits whatever the compiler and the machine. The kernels turn it on for
# themselves (below), where it is worth a factor of two. -ffast-math is off everywhere:
# finite checks and compensated sums must mean what they say.
CFLAGS_release := -O2 -g
CFLAGS_debug   := -O0 -g3
CFLAGS_san     := -O1 -g -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer
CFLAGS_cov     := -O0 -g --coverage
ALL_CFLAGS = -std=c11 $(WARNINGS) $(CFLAGS_$(VARIANT)) -ffp-contract=off -fPIC -fvisibility=hidden \
             -D_POSIX_C_SOURCE=200809L -DAMBULO_BUILDING_SHARED -Iinclude -Isrc $(DEP_CFLAGS) $(CFLAGS)
ALL_LDFLAGS = $(filter -fsanitize% --coverage,$(CFLAGS_$(VARIANT))) $(LDFLAGS)

DEP_CFLAGS := $(shell pkg-config --cflags nlopt yaml-0.1 2>/dev/null)
BLAS_LIBS  := $(shell pkg-config --libs openblas 2>/dev/null || echo -lopenblas)
DEP_LIBS   := $(shell pkg-config --libs nlopt yaml-0.1 2>/dev/null || echo -lnlopt -lyaml) $(BLAS_LIBS) -lm -lpthread

# One kernel source, one object per instruction set, chosen at run time.
KERNEL_FLAGS := -O3 -ffp-contract=fast -fno-math-errno -fno-trapping-math
KERNEL_FLAGS_avx512 := -mavx512f -mavx512dq -mavx512vl -mfma -mprefer-vector-width=512
KERNEL_FLAGS_avx2   := -mavx2 -mfma
ifneq ($(UNAME_M),x86_64)
KERNEL_FLAGS_avx512 :=
KERNEL_FLAGS_avx2 :=
endif

LIB_SOURCES := $(filter-out src/cli/%,$(wildcard src/*/*.c))
CLI_SOURCES := $(wildcard src/cli/*.c)
LIB_OBJECTS := $(LIB_SOURCES:%.c=$(BUILD)/obj/%.o)
CLI_OBJECTS := $(CLI_SOURCES:%.c=$(BUILD)/obj/%.o)
TEST_SOURCES := $(wildcard tests/*/test_*.c)
TESTS := $(TEST_SOURCES:tests/%.c=$(BUILD)/tests/%)
BENCH_SOURCES := $(wildcard bench/bench_*.c)
BENCHES := $(BENCH_SOURCES:bench/%.c=$(BUILD)/bench/%)

.PHONY: all
all: $(BUILD)/libambulo.a $(BUILD)/libambulo.so $(BUILD)/ambulo

$(BUILD)/obj/src/mechanics/kernels_%.o: src/mechanics/kernels_%.c
	@mkdir -p $(@D)
	$(CC) $(ALL_CFLAGS) $(KERNEL_FLAGS) $(KERNEL_FLAGS_$*) -MMD -MP -c $< -o $@

$(BUILD)/obj/%.o: %.c
	@mkdir -p $(@D)
	$(CC) $(ALL_CFLAGS) -MMD -MP -c $< -o $@

$(BUILD)/libambulo.a: $(LIB_OBJECTS)
	@rm -f $@
	ar rcs $@ $^

$(BUILD)/libambulo.so: $(LIB_OBJECTS)
	$(CC) -shared -Wl,-soname,libambulo.so.$(SOVERSION) $(ALL_LDFLAGS) $^ -o $@ $(DEP_LIBS)

$(BUILD)/ambulo: $(CLI_OBJECTS) $(BUILD)/libambulo.a
	$(CC) $(ALL_LDFLAGS) $(CLI_OBJECTS) $(BUILD)/libambulo.a -o $@ $(DEP_LIBS)

$(BUILD)/tests/%: tests/%.c $(BUILD)/libambulo.a
	@mkdir -p $(@D)
	$(CC) $(ALL_CFLAGS) -Itests -DAMBULO_SOURCE_DIR='"$(CURDIR)"' -MMD -MP $(ALL_LDFLAGS) $< $(BUILD)/libambulo.a -o $@ -lcmocka $(DEP_LIBS)

$(BUILD)/bench/%: bench/%.c $(BUILD)/libambulo.a
	@mkdir -p $(@D)
	$(CC) $(ALL_CFLAGS) -DAMBULO_SOURCE_DIR='"$(CURDIR)"' -MMD -MP $(ALL_LDFLAGS) $< $(BUILD)/libambulo.a -o $@ $(DEP_LIBS)

.PHONY: tests benches clean
tests: $(TESTS)
benches: $(BENCHES)

clean:
	rm -rf build

-include $(LIB_OBJECTS:.o=.d) $(CLI_OBJECTS:.o=.d) $(TESTS:=.d) $(BENCHES:=.d)
