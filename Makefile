# libpneu. `make help` lists the targets.
BUILD   ?= build
MPI     ?=
CC      ?= cc
CXX     ?= c++
OPT     ?= -O2
MEASURED ?= ../shared/data
SANITIZE ?=
PREFIX  ?= /usr/local
N       ?= 500

WARN    := -Wall -Wextra -Wpedantic -Wshadow -Wvla -Wundef -Wwrite-strings -Wold-style-definition \
           -Wstrict-prototypes -Wmissing-prototypes -Wdouble-promotion -Wpointer-arith
FLAGS   := -std=c99 $(OPT) -g $(WARN) $(if $(WERROR),-Werror) $(if $(SANITIZE),-fsanitize=$(SANITIZE) -DLAB_SANITIZED -fno-sanitize-recover=all -fno-omit-frame-pointer)
DEPS    := -MMD -MP
SINGLE_FLAG := $(if $(SINGLE),-DPNEU_SINGLE)

# Floating-point contraction differs between machines; off, so that results/ is the same on all.
FLAGS   += -ffp-contract=off

OPENMP ?= -fopenmp
LAB_FLAGS := -D_POSIX_C_SOURCE=200809L $(OPENMP)
LAB_LIBS  := -lsundials_cvode -lsundials_nvecserial -lnlopt -lconfig -ludunits2 -lcjson -lm
ifdef MPI
MPI_FLAGS := $(shell pkg-config --cflags ompi-c 2>/dev/null)
LAB_LIBS  += $(shell pkg-config --libs ompi-c 2>/dev/null)
endif

LIB_C   := $(wildcard lib/*.c lib/effects/*.c)
# closeloop --batch over the ranks of MPI: make MPI=1 closeloop
JOBS_C  := $(if $(MPI),apps/lab/batch/mpi/jobs.c,apps/lab/batch/jobs.c)
LAB_C   := $(filter-out apps/lab/batch/jobs.c,$(wildcard apps/lab/*/*.c apps/study/*.c)) $(JOBS_C)
PROGS   := sweep simulate closeloop
# export-fmu has a rule of its own (apps/fmu/fmu.mk)
TOOLS   := $(PROGS) export-fmu
# The test of a file of lib/ or apps/ lies under tests/ as the file does under the root; those of helpers lie beside them.
TEST_C  := $(wildcard tests/test_*.c tests/*/test_*.c tests/lab/*/test_*.c)
BLIND_C := $(filter-out $(TEST_C),$(wildcard tests/blind/*.c))
HELP_C  := tests/check.c tests/fixture.c tests/fuzz/targets.c $(filter-out %/main.c $(TEST_C),$(wildcard tests/second/*.c) $(BLIND_C))
BENCH_C := $(filter-out %/main.c %/fleet.c,$(wildcard tests/bench/*.c)) tests/second/rig.c $(filter-out tests/blind/main.c,$(BLIND_C))

LIB_O   := $(LIB_C:%.c=$(BUILD)/%.o)
LAB_O   := $(LAB_C:%.c=$(BUILD)/%.o)
HELP_O  := $(HELP_C:%.c=$(BUILD)/%.o)
HELP    := $(BUILD)/libhelp.a
BLIND_O := $(BLIND_C:%.c=$(BUILD)/%.o) $(BUILD)/tests/second/rig.o
BENCH_O := $(BENCH_C:%.c=$(BUILD)/%.o)
TESTS   := $(TEST_C:%.c=$(BUILD)/%)
CORE_TESTS := $(filter $(BUILD)/tests/lib/%,$(TESTS))
STATIC  := $(BUILD)/libpneu.a
LAB     := $(BUILD)/liblab$(if $(MPI),-mpi).a

# What was made by another program is made again: the sources' checksum goes into the record of what is done.
SOURCES := $(sort $(wildcard lib/*.[ch] lib/*.def lib/effects/*.c apps/lab/*/*.[ch] apps/lab/*/*.def apps/lab/report/page/*.* apps/lab/report/page/uplot/* apps/study/*.[ch] study/paper/* study/measured/report.md))

# What is being made, or with V=1 how.
say = $(if $(V),,@echo '  $@' &&)

.DELETE_ON_ERROR:
.SECONDARY:
.PHONY: all help study check bench install-packages clean

# Where there are no rights or no network, but all is there, or all but a part of the tests.
GO_ON := echo "going on with what is there" >&2

## Build the library and the programs
all: $(BUILD)/found/programs $(STATIC) $(TOOLS)

## Show this list
help:
	@awk '/^## /{text=substr($$0,4)} /^[a-z-]+:/{if(text){name=$$1;sub(":.*","",name);printf "  make %-18s %s\n",name,text};text=""}' $(filter %akefile %.mk,$(MAKEFILE_LIST))

## Run the study: installs missing packages, then writes tables, figures and report to results/
study:
	@sh study/install-packages.sh || $(GO_ON)
	@$(MAKE) --no-print-directory all
	./sweep hypotheses.cfg

## Install missing packages (Debian, Ubuntu); names them for other systems
install-packages:
	@sh study/install-packages.sh

TESTED_WITH = MEASURED='$(MEASURED)' MAKE='$(MAKE)' CC='$(CC)' CXX='$(CXX)' BUILD='$(BUILD)'

## Run the tests: library in double and single precision, programs, README, short study, a few blind trials; three minutes
check:
	@sh study/install-packages.sh tests || $(GO_ON)
	@$(MAKE) --no-print-directory all
	@$(TESTED_WITH) sh tests/run.sh

## Run these and everything else: sanitizers, firmware, FMUs, browser, Windows, packages, kill, mutants, fuzz; installs what they need
check-all:
	@sh study/install-packages.sh everything || $(GO_ON)
	@$(MAKE) --no-print-directory all
	@$(TESTED_WITH) sh tests/run.sh all
.PHONY: check-all

## Close the loop on every measured set (MEASURED names the data's folder); writes results/measured/ and the gallery
measured: $(STATIC) closeloop $(BUILD)/measured
	MEASURED='$(MEASURED)' $(BUILD)/measured study/measured/sets.cfg
	@$(MAKE) --no-print-directory gallery
.PHONY: measured

$(BUILD)/measured: $(BUILD)/apps/measured.o $(LAB) $(STATIC)
	$(say) $(CC) $(FLAGS) $(LAB_FLAGS) $(CFLAGS) $^ $(LDFLAGS) $(LAB_LIBS) -o $@

## Build the core for Cortex-M4F and M0+, 32-bit x86 and a big-endian machine and run it there, emulated; installs the tools
firmware-check: $(STATIC)
	@CC='$(CC)' sh tests/firmware/install.sh
	@MAKE='$(MAKE)' CC='$(CC)' BUILD='$(BUILD)' sh tests/firmware/check.sh full
.PHONY: firmware-check

## Time everything beside its rivals, in one process; writes results/bench.csv, work_precision.csv, scaling.csv
bench: all
	@$(MAKE) --no-print-directory BUILD='$(BUILD)/pic' OPT='$(OPT) -fPIC' $(BUILD)/pic/bench
	MEASURED='$(MEASURED)' BUILD='$(BUILD)' sh tests/bench/run.sh $(if $(QUICK),'$(BUILD)/bench/results' quick,results)

## The page that closeloop makes of the guide's log; writes results/sample/
sample: closeloop
	./closeloop study/guides/leak/rig.cfg study/guides/leak/fit.csv --holdout study/guides/leak/holdout.csv --figures --out $(BUILD)/sample
	mkdir -p results/sample && cp $(BUILD)/sample/report.html $(BUILD)/sample/response.svg results/sample/
.PHONY: sample

## All figures of results/ on one page
gallery:
	@sh study/gallery.sh >results/GALLERY.md.part && mv results/GALLERY.md.part results/GALLERY.md
.PHONY: gallery

## Try closeloop on N rigs (500) without its answer, and on more of which nothing is missing, or the noise not told, or the log as recorded; goes on after a stop
blind: closeloop $(BUILD)/tests/blind/blind
	$(BUILD)/tests/blind/blind --trials $(N) --work $(BUILD)/blind
	$(BUILD)/tests/blind/blind --trials $$((5 * $(N) + 100)) --series blind_nothing --work $(BUILD)/blind
	$(BUILD)/tests/blind/blind --trials $$(($(N) / 5)) --series blind_noise --work $(BUILD)/blind
	$(BUILD)/tests/blind/blind --trials $(N) --series blind_recorded --work $(BUILD)/blind
## Repeat trial K of them (SERIES=blind_recorded: of that series) and keep its files in build/blind/kept
blind-trial: closeloop $(BUILD)/tests/blind/blind
	$(BUILD)/tests/blind/blind --trial $(K) $(if $(SERIES),--series $(SERIES)) --keep $(BUILD)/blind/kept
.PHONY: blind blind-trial

## Run closeloop --batch on N logs (500) of a few hundred rows; writes results/fleet.csv, goes on after a stop
fleet: closeloop $(BUILD)/tests/bench/fleet
	BUILD='$(BUILD)' sh tests/bench/fleet.sh $(N)
.PHONY: fleet

## Break the library one sign or factor at a time, see that a test notices: MUTANTS=10 SEED=1 draws some, else all
mutate: tests
	@CC='$(CC)' MAKE='$(MAKE)' BUILD='$(BUILD)' LINK='-fopenmp $(LAB_LIBS) -lcmocka' MUTANTS='$(MUTANTS)' \
	  SEED='$(or $(SEED),1)' OUT='$(if $(MUTANTS)$(FILES),,results/mutation.csv)' sh tests/mutate.sh
.PHONY: mutate

## End sweep, closeloop and a batch by kill -9 KILLS times (200, 5 minutes), see that nothing is half-written and the next run is whole
kill: sweep simulate closeloop
	@BUILD='$(BUILD)' KILLS='$(or $(KILLS),200)' SEED='$(or $(SEED),1)' sh tests/kill.sh
.PHONY: kill

## Build the test programs
tests: $(TESTS)
.PHONY: tests

$(STATIC): $(LIB_O)
	@rm -f $@
	$(say) $(AR) rcs $@ $^

$(LAB): $(LAB_O)
	@rm -f $@
	$(say) $(AR) rcs $@ $^

# What tests share: each takes what it needs, so that a test of the core links no reader.
$(HELP): $(HELP_O)
	@rm -f $@
	$(say) $(AR) rcs $@ $^

# What is missing is named before the compiler stumbles over it.
$(BUILD)/found/%: study/packages.txt
	@mkdir -p $(@D)
	@sh study/missing.sh $* $@ $(CC) $(LAB_FLAGS) $(MPI_FLAGS) $(FMU_XML) $(CFLAGS)

$(BUILD)/lib/%.o: lib/%.c | $(BUILD)/found/compiler
	@mkdir -p $(@D)
	$(say) $(CC) $(FLAGS) $(DEPS) $(SINGLE_FLAG) $(CFLAGS) -c $< -o $@

$(BUILD)/apps/%.o: apps/%.c | $(BUILD)/found/programs
	@mkdir -p $(@D)
	$(say) $(CC) $(FLAGS) $(DEPS) $(LAB_FLAGS) $(CFLAGS) -c $< -o $@

$(BUILD)/apps/lab/batch/mpi/%.o: LAB_FLAGS += $(MPI_FLAGS)
$(BUILD)/apps/lab/batch/mpi/jobs.o: | $(BUILD)/found/mpi

# Programs are linked again when MPI=1 comes or goes.
$(BUILD)/jobs: FORCE
	@mkdir -p $(@D)
	@echo '$(JOBS_C)' | cmp -s - $@ || echo '$(JOBS_C)' > $@
.PHONY: FORCE

$(BUILD)/sources.cksum: $(SOURCES)
	@mkdir -p $(@D)
	@cat $(SOURCES) | cksum > $@

$(BUILD)/apps/lab/base/checksum.o: apps/lab/base/checksum.c $(BUILD)/sources.cksum
	@mkdir -p $(@D)
	$(say) $(CC) $(FLAGS) $(DEPS) $(LAB_FLAGS) $(CFLAGS) -DLAB_BUILD='"'"$$(cat $(BUILD)/sources.cksum)"'"' -c $< -o $@

# Scripts and templates that a program carries inside, in strings of a thousand characters at most.
CARRIED := $(wildcard apps/lab/report/page/*.* apps/lab/report/page/uplot/* study/paper/*) study/measured/report.md study/figures/style.gp
$(CARRIED:%=$(BUILD)/%.inc): $(BUILD)/%.inc: % apps/lab/report/carry.awk
	@mkdir -p $(@D)
	$(say) LC_ALL=C awk -f apps/lab/report/carry.awk $< > $@

# Which of them an object carries is known once it has been compiled; before that, all must be there.
$(filter $(BUILD)/apps/lab/report/% $(BUILD)/apps/study/%,$(LAB_O)): | $(CARRIED:%=$(BUILD)/%.inc)
$(BUILD)/apps/lab/report/%.o $(BUILD)/apps/study/%.o: LAB_FLAGS += -I$(BUILD)

# Programs stay in the folder of their build as well, for its tests: those of a sanitized build start sanitized ones.
$(PROGS:%=$(BUILD)/bin/%): $(BUILD)/bin/%: $(BUILD)/apps/%.o $(LAB) $(STATIC) $(BUILD)/jobs
	@mkdir -p $(@D)
	$(say) $(CC) $(FLAGS) $(LAB_FLAGS) $(CFLAGS) $(filter %.o %.a,$^) $(LDFLAGS) $(LAB_LIBS) -o $@

$(PROGS): %: $(BUILD)/bin/%
	$(say) cp -f $< $@

$(TESTS:%=%.o) $(BUILD)/tests/check.o $(BUILD)/tests/fixture.o: | $(BUILD)/found/tests
$(BUILD)/tests/%.o: tests/%.c | $(BUILD)/found/programs
	@mkdir -p $(@D)
	$(say) $(CC) $(FLAGS) $(DEPS) $(LAB_FLAGS) $(SINGLE_FLAG) -DPROGRAMS='"$(BUILD)/bin"' $(CFLAGS) -c $< -o $@

$(BUILD)/tests/apps/test_closeloop: | $(BUILD)/bin/closeloop
$(BUILD)/tests/apps/test_simulate: | $(BUILD)/bin/simulate
$(BUILD)/tests/lab/api/test_api: | $(BUILD)/bin/closeloop $(BUILD)/bin/simulate

$(BUILD)/tests/compare: $(BUILD)/tests/compare.o
	$(say) $(CC) $(FLAGS) $(CFLAGS) $^ -lm -o $@

$(BUILD)/tests/decisions: $(BUILD)/tests/decisions.o $(BUILD)/apps/lab/trace/decide.o
	$(say) $(CC) $(FLAGS) $(CFLAGS) $^ -lm -o $@

# What is timed is a shared library, so that rivals in another language can share its process.
$(BUILD)/libbench.so: $(BENCH_O) $(LAB) $(STATIC)
	$(say) $(CC) $(FLAGS) $(LAB_FLAGS) $(CFLAGS) -shared -Wl,-Bsymbolic -Wl,--whole-archive $^ -Wl,--no-whole-archive $(LDFLAGS) $(LAB_LIBS) -o $@

$(BUILD)/bench: $(BUILD)/tests/bench/main.o $(BUILD)/libbench.so
	$(say) $(CC) $(FLAGS) $(CFLAGS) $< $(LDFLAGS) -L$(BUILD) -lbench -Wl,-rpath,'$$ORIGIN' -o $@

$(BUILD)/tests/bench/fleet: $(BUILD)/tests/bench/fleet.o $(filter-out %/main.o,$(BLIND_O)) $(LAB)
	$(say) $(CC) $(FLAGS) $(LAB_FLAGS) $(CFLAGS) $^ $(LDFLAGS) -lcjson -lm -o $@

# No $(STATIC) here: what it links with proves that the trials know nothing of the library.
$(BUILD)/tests/blind/blind: $(BLIND_O) $(LAB)
	$(say) $(CC) $(FLAGS) $(LAB_FLAGS) $(CFLAGS) $^ $(LDFLAGS) -lcjson -lm -o $@

# Tests of the core link nothing of the lab.
$(CORE_TESTS): %: %.o $(HELP) $(STATIC)
	$(say) $(CC) $(FLAGS) $(LAB_FLAGS) $(CFLAGS) $^ $(LDFLAGS) -lcmocka -lm -o $@

$(filter-out $(CORE_TESTS),$(TESTS)): %: %.o $(HELP) $(LAB) $(STATIC)
	$(say) $(CC) $(FLAGS) $(LAB_FLAGS) $(CFLAGS) $^ $(LDFLAGS) $(LAB_LIBS) -lcmocka -o $@

include apps/web/web.mk python/python.mk apps/fmu/fmu.mk tests/fuzz/fuzz.mk tests/trust.mk tests/portable.mk packaging/install.mk packaging/cross/cross.mk

## Remove what was built, but no results
clean:
	rm -rf $(BUILD) $(TOOLS)

-include $(shell find $(BUILD) -name '*.d' 2>/dev/null)
