# What is checked beside what the tests say: memory that runs out, memory that is misread, lines never run, static analysis.

ALLOC := $(BUILD)/tests/alloc
$(ALLOC)/closeloop $(ALLOC)/simulate: $(ALLOC)/%: $(BUILD)/apps/%.o $(ALLOC)/fail.o $(LAB) $(STATIC)
	$(CC) $(FLAGS) $(LAB_FLAGS) $(CFLAGS) $^ $(LDFLAGS) -Wl,--wrap=malloc,--wrap=calloc,--wrap=realloc $(LAB_LIBS) -o $@

## Run closeloop and simulate with memory that runs out, at one call after the other
alloc:
	@$(MAKE) --no-print-directory BUILD=$(BUILD)/sanitized SANITIZE=address,undefined OPT=-O1 \
	  $(BUILD)/sanitized/tests/alloc/closeloop $(BUILD)/sanitized/tests/alloc/simulate >$(BUILD)/alloc.log 2>&1 || \
	  { tail $(BUILD)/alloc.log; exit 1; }
	@sh tests/check_alloc.sh $(BUILD)/sanitized/tests/alloc
.PHONY: alloc
