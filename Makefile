# libpneu. `make help` lists the targets.
BUILD   ?= build
CC      ?= cc
CXX     ?= c++
OPT     ?= -O2
MEASURED ?= ../shared/data
SANITIZE ?=
PREFIX  ?= /usr/local
N       ?= 500

WARN    := -Wall -Wextra -Wpedantic -Wshadow -Wvla -Wundef -Wwrite-strings -Wold-style-definition \
           -Wstrict-prototypes -Wmissing-prototypes -Wdouble-promotion -Wpointer-arith
FLAGS   := -std=c99 $(OPT) -g $(WARN) $(if $(WERROR),-Werror) $(if $(SANITIZE),-fsanitize=$(SANITIZE) -fno-omit-frame-pointer)
DEPS    := -MMD -MP
SINGLE_FLAG := $(if $(SINGLE),-DPNEU_SINGLE)

# Floating-point contraction differs between machines; off, so that results/ is the same on all.
FLAGS   += -ffp-contract=off

CMINPACK ?= $(firstword $(wildcard /usr/include/cminpack-1 /usr/local/include/cminpack-1 /opt/homebrew/include/cminpack-1))
LAB_FLAGS := -D_POSIX_C_SOURCE=200809L $(if $(CMINPACK),-I$(CMINPACK)) -fopenmp
LAB_LIBS  := -lsundials_cvode -lsundials_nvecserial -lnlopt -lconfig -ludunits2 -lcjson -lcminpack -lm

LIB_C   := $(wildcard lib/*.c lib/effects/*.c)
LAB_C   := $(wildcard apps/lab/*.c apps/study/*.c)
PROGS   := sweep simulate closeloop
TEST_C  := $(wildcard tests/test_*.c)
BLIND_C := $(wildcard tests/blind/*.c)
BENCH_C := $(filter-out %/main.c,$(wildcard tests/bench/*.c)) tests/second/rig.c $(filter-out tests/blind/main.c,$(BLIND_C))
HELP_C  := tests/fixture.c $(filter-out %/main.c,$(wildcard tests/second/*.c) $(BLIND_C))

LIB_O   := $(LIB_C:%.c=$(BUILD)/%.o)
LAB_O   := $(LAB_C:%.c=$(BUILD)/%.o)
HELP_O  := $(HELP_C:%.c=$(BUILD)/%.o)
BLIND_O := $(BLIND_C:%.c=$(BUILD)/%.o) $(BUILD)/tests/second/rig.o
BENCH_O := $(BENCH_C:%.c=$(BUILD)/%.o)
TESTS   := $(TEST_C:%.c=$(BUILD)/%)
STATIC  := $(BUILD)/libpneu.a
LAB     := $(BUILD)/liblab.a

# Tables made by another program are made again: the sources' checksum goes into the record of what is done.
SOURCES := $(sort $(wildcard lib/*.[ch] lib/*.def lib/effects/*.c apps/lab/*.[ch] apps/study/*.[ch] apps/study/*.def))

.DELETE_ON_ERROR:
.SECONDARY:
.PHONY: all help study check check-core check-single check-san check-readme verify bench figures install-packages clean

## Build the library and the programs
all: $(STATIC) $(PROGS)

## Show this list
help:
	@awk '/^## /{text=substr($$0,4)} /^[a-z-]+:/{if(text){name=$$1;sub(":.*","",name);printf "  make %-18s %s\n",name,text};text=""}' Makefile

## Run the study: installs missing packages, then writes tables, figures and report to results/
study: install-packages
	@$(MAKE) --no-print-directory all
	MEASURED='$(MEASURED)' ./sweep hypotheses.cfg

## Install missing packages (Debian, Ubuntu); names them for other systems
install-packages:
	@sh study/install-packages.sh

## Run every test: library in double and single precision, with sanitizers, headers, README, short study
check: install-packages
	@$(MAKE) --no-print-directory all
	@MEASURED='$(MEASURED)' MAKE='$(MAKE)' CC='$(CC)' CXX='$(CXX)' BUILD='$(BUILD)' sh tests/run.sh

## Close the loop on every measured set (MEASURED names the data's folder); writes results/measured/
measured: $(STATIC) closeloop $(BUILD)/measured
	MEASURED='$(MEASURED)' $(BUILD)/measured study/measured/sets.cfg
.PHONY: measured

$(BUILD)/measured: $(BUILD)/apps/measured.o $(LAB) $(STATIC)
	$(CC) $(FLAGS) $(LAB_FLAGS) $(CFLAGS) $^ $(LDFLAGS) $(LAB_LIBS) -o $@

## Time everything beside its rivals, in one process; writes results/bench.csv, work_precision.csv, scaling.csv
bench: all
	@$(MAKE) --no-print-directory BUILD='$(BUILD)/pic' OPT='$(OPT) -fPIC' $(BUILD)/pic/bench
	MEASURED='$(MEASURED)' BUILD='$(BUILD)' sh tests/bench/run.sh $(if $(QUICK),'$(BUILD)/bench/results' quick,results)

## Try closeloop on N rigs without its answer (500); writes results/blind.csv and blind.md, goes on after a stop
blind: closeloop $(BUILD)/tests/blind/blind
	$(BUILD)/tests/blind/blind --trials $(N) --work $(BUILD)/blind
## Repeat trial K of them and keep its files in build/blind/kept
blind-trial: closeloop $(BUILD)/tests/blind/blind
	$(BUILD)/tests/blind/blind --trial $(K) --keep $(BUILD)/blind/kept
.PHONY: blind blind-trial

## Build the test programs
tests: $(TESTS)
.PHONY: tests

$(STATIC): $(LIB_O)
	@rm -f $@
	$(AR) rcs $@ $^

$(LAB): $(LAB_O)
	@rm -f $@
	$(AR) rcs $@ $^

$(BUILD)/lib/%.o: lib/%.c
	@mkdir -p $(@D)
	$(CC) $(FLAGS) $(DEPS) $(SINGLE_FLAG) $(CFLAGS) -c $< -o $@

$(BUILD)/apps/%.o: apps/%.c
	@mkdir -p $(@D)
	$(CC) $(FLAGS) $(DEPS) $(LAB_FLAGS) $(CFLAGS) -c $< -o $@

$(BUILD)/apps/study/products.o: apps/study/products.c $(SOURCES)
	@mkdir -p $(@D)
	$(CC) $(FLAGS) $(DEPS) $(LAB_FLAGS) $(CFLAGS) -DSTUDY_BUILD='"'"$$(cat $(SOURCES) | cksum)"'"' -c $< -o $@

# Scripts and templates that a program carries inside, a line a string.
CARRIED := $(wildcard apps/lab/report/*) study/figures/style.gp
$(CARRIED:%=$(BUILD)/%.inc): $(BUILD)/%.inc: %
	@mkdir -p $(@D)
	sed -e 's/[\\"]/\\&/g' -e 's/??/?\\?/g' -e 's/.*/"&\\n",/' $< > $@

$(BUILD)/apps/lab/figures.o $(BUILD)/apps/lab/report_html.o: $(CARRIED:%=$(BUILD)/%.inc)
$(BUILD)/apps/lab/figures.o $(BUILD)/apps/lab/report_html.o: LAB_FLAGS += -I$(BUILD)

$(PROGS): %: $(BUILD)/apps/%.o $(LAB) $(STATIC)
	$(CC) $(FLAGS) $(LAB_FLAGS) $(CFLAGS) $^ $(LDFLAGS) $(LAB_LIBS) -o $@

$(BUILD)/tests/%.o: tests/%.c
	@mkdir -p $(@D)
	$(CC) $(FLAGS) $(DEPS) $(LAB_FLAGS) $(SINGLE_FLAG) $(CFLAGS) -c $< -o $@

$(BUILD)/tests/compare: $(BUILD)/tests/compare.o
	$(CC) $(FLAGS) $(CFLAGS) $^ -lm -o $@

# What is timed is a shared library, so that rivals in another language can share its process.
$(BUILD)/libbench.so: $(BENCH_O) $(LAB) $(STATIC)
	$(CC) $(FLAGS) $(LAB_FLAGS) $(CFLAGS) -shared -Wl,-Bsymbolic -Wl,--whole-archive $^ -Wl,--no-whole-archive $(LDFLAGS) $(LAB_LIBS) -o $@

$(BUILD)/bench: $(BUILD)/tests/bench/main.o $(BUILD)/libbench.so
	$(CC) $(FLAGS) $(CFLAGS) $< $(LDFLAGS) -L$(BUILD) -lbench -Wl,-rpath,'$$ORIGIN' -o $@

# No $(STATIC) here: what it links with proves that the trials know nothing of the library.
$(BUILD)/tests/blind/blind: $(BLIND_O) $(LAB)
	$(CC) $(FLAGS) $(LAB_FLAGS) $(CFLAGS) $^ $(LDFLAGS) -lcjson -lm -o $@

$(BUILD)/tests/test_%: $(BUILD)/tests/test_%.o $(HELP_O) $(LAB) $(STATIC)
	$(CC) $(FLAGS) $(LAB_FLAGS) $(CFLAGS) $^ $(LDFLAGS) $(LAB_LIBS) -lcmocka -o $@

## Remove what was built, but no results
clean:
	rm -rf $(BUILD) $(PROGS)

-include $(shell find $(BUILD) -name '*.d' 2>/dev/null)
