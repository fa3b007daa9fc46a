# What is checked beside what the tests say: memory that runs out, memory that is misread, lines never run, static analysis,
# steps that are wrong.

ALLOC := $(BUILD)/tests/alloc
$(ALLOC)/closeloop $(ALLOC)/simulate: $(ALLOC)/%: $(BUILD)/apps/%.o $(ALLOC)/fail.o $(LAB) $(STATIC)
	$(say) $(CC) $(FLAGS) $(LAB_FLAGS) $(CFLAGS) $^ $(LDFLAGS) -Wl,--wrap=malloc,--wrap=calloc,--wrap=realloc $(LAB_LIBS) -o $@

$(ALLOC)/export-fmu: $(BUILD)/apps/export-fmu.o $(ALLOC)/fail.o $(FMU) $(LAB) $(STATIC)
	$(say) $(CC) $(FLAGS) $(LAB_FLAGS) $(CFLAGS) $^ $(LDFLAGS) -Wl,--wrap=malloc,--wrap=calloc,--wrap=realloc $(FMU_LIBS) $(LAB_LIBS) -o $@

# The programs with sanitizers.
sanitized:
	@mkdir -p $(BUILD)
	@$(MAKE) --no-print-directory BUILD=$(BUILD)/sanitized SANITIZE=address,undefined OPT=-O1 \
	  $(BUILD)/sanitized/tests/alloc/closeloop $(BUILD)/sanitized/tests/alloc/simulate \
	  $(BUILD)/sanitized/tests/alloc/export-fmu >$(BUILD)/alloc.log 2>&1 || \
	  { tail $(BUILD)/alloc.log; exit 1; }
.PHONY: sanitized

## Attack closeloop, simulate and export-fmu with ATTACKS (10000) rigs, logs and lists of a stranger; a browser opens the pages
hostile: sanitized
	@BUILD='$(BUILD)' sh tests/check_hostile.sh $(or $(ATTACKS),10000)
.PHONY: hostile

## Run closeloop, simulate and export-fmu with memory that runs out, at one call after the other
alloc: sanitized
	@$(MAKE) --no-print-directory $(ALLOC)/closeloop >>$(BUILD)/alloc.log 2>&1 || { tail $(BUILD)/alloc.log; exit 1; }
	@sh tests/check_alloc.sh $(BUILD)/sanitized/tests/alloc $(ALLOC)
.PHONY: alloc

# Tests that say what the library and the readers of files do; none that fits.
OF_CORE  := $(CORE_TESTS:$(BUILD)/tests/%=%)
READING  := $(addprefix lab/,log/test_log rig/test_rig rig/test_rigterm base/test_units base/test_number base/test_csv) \
            study/test_table_read study/test_study fuzz/test_finds
COVERING := $(OF_CORE) $(READING) study/test_table
COVERED  := $(BUILD)/coverage

## Lines and branches of lib/ and of the readers that the tests reach; writes results/coverage.csv
coverage:
	@mkdir -p $(COVERED)
	@$(MAKE) --no-print-directory BUILD=$(COVERED) OPT=-O0 CFLAGS=--coverage $(COVERING:%=$(COVERED)/tests/%) \
	  >$(COVERED)/build.log 2>&1 || { tail $(COVERED)/build.log; exit 1; }
	@sh tests/coverage.sh $(COVERED) $(COVERING)
.PHONY: coverage

TIDY ?= clang-tidy
LINTED := $(LIB_C) $(LAB_C) $(wildcard apps/*.c apps/fmu/*.c apps/fmu/runtime/*.c)

## Static analysis of lib/ and apps/ by clang-tidy (.clang-tidy), which it installs
lint: $(CARRIED:%=$(BUILD)/%.inc) $(BUILD)/apps/fmu/carried.inc
	@sh study/install-packages.sh clang-tidy
	@printf '%s\n' $(LINTED) | xargs -P 2 -n 12 sh -c \
	  '$(TIDY) --quiet "$$@" -- -std=c99 $(filter-out -fopenmp,$(LAB_FLAGS)) $(FMU_XML) -I$(BUILD) 2>/dev/null' lint
	@echo "lint: nothing found in $(words $(LINTED)) files"
.PHONY: lint

# Under valgrind by `make valgrind`: what takes a second or two without it.
GRIND  := $(OF_CORE) $(READING)

## Tests of the library and of the readers under valgrind's memcheck
valgrind: $(GRIND:%=$(BUILD)/tests/%)
	@sh study/install-packages.sh valgrind
	@for test in $(GRIND); do \
	  valgrind -q --error-exitcode=9 --leak-check=full --show-leak-kinds=definite --errors-for-leak-kinds=definite \
	    --suppressions=tests/valgrind.supp $(BUILD)/tests/$$test >$(BUILD)/valgrind.log 2>&1 && \
	    echo "valgrind: nothing found in $$test" || { tail -n 40 $(BUILD)/valgrind.log; exit 1; }; \
	done
.PHONY: valgrind

$(BUILD)/tests/step_search: $(BUILD)/tests/step_search.o $(STATIC)
	$(say) $(CC) $(FLAGS) $(CFLAGS) $^ -lm -o $@

## Random steps of pneu_step against 64 small ones, STEPS (1000000, 4 minutes) in double and as many in single precision
step-search: $(BUILD)/tests/step_search
	@$(MAKE) --no-print-directory BUILD=$(BUILD)/single SINGLE=1 $(BUILD)/single/tests/step_search
	$(BUILD)/tests/step_search 0 $(or $(STEPS),1000000)
	$(BUILD)/single/tests/step_search 0 $(or $(STEPS),1000000)
.PHONY: step-search

## Run at full length what CONTRIBUTING.md lists beside the tests; hours
check-long:
	@$(TESTED_WITH) sh tests/run.sh searches
	$(MAKE) fuzz
	$(MAKE) valgrind
	$(MAKE) step-search STEPS=5000000
	$(MAKE) kill
	$(MAKE) mutate
	$(MAKE) coverage
	$(MAKE) lint
	$(MAKE) firmware-check
	$(MAKE) windows-check
.PHONY: check-long
