# Fuzzing of the file readers by libFuzzer; only clang has it.
FUZZ_CC      ?= clang
FUZZ_SECONDS ?= 60
FUZZ_TARGETS ?= log rig study table
FUZZ_RUNS    ?= -1

# The readers and what they need, without the rest of the programs.
FUZZ_READERS := $(wildcard apps/lab/base/*.c apps/lab/log/*.c apps/lab/rig/*.c) \
                $(addprefix apps/study/,study.c table.c)
FUZZ_C       := $(LIB_C) $(FUZZ_READERS) tests/fuzz/targets.c tests/fuzz/libfuzzer.c
FUZZING      := $(BUILD)/fuzzing

## Fuzz the readers of files, FUZZ_SECONDS (60) or FUZZ_RUNS executions each; FUZZ_TARGETS: log rig study table; installs clang
fuzz:
	@sh study/install-packages.sh clang libclang-rt-dev
	@mkdir -p $(FUZZING)
	@$(MAKE) --no-print-directory BUILD=$(FUZZING) CC=$(FUZZ_CC) WARN=-w OPENMP= \
	  SANITIZE=address,undefined,fuzzer-no-link $(FUZZING)/fuzz >$(FUZZING)/build.log 2>&1 || \
	  { tail $(FUZZING)/build.log; exit 1; }
	@sh tests/fuzz/run.sh $(FUZZING) $(FUZZ_SECONDS) $(FUZZ_RUNS) $(FUZZ_TARGETS)
.PHONY: fuzz

$(BUILD)/fuzz: $(FUZZ_C:%.c=$(BUILD)/%.o)
	$(say) $(CC) $(FLAGS) -fsanitize=fuzzer $^ -lnlopt -lconfig -ludunits2 -lcjson -lm -o $@

# Where the fuzzer is not to look for new ways: nearest names take most of the time otherwise, the library holds no reader.
ifneq ($(findstring fuzzer,$(SANITIZE)),)
$(BUILD)/apps/lab/base/names.o $(LIB_O): FLAGS += -fno-sanitize=fuzzer-no-link
endif
