# One target's build: make -f tests/firmware/target.mk TARGET=m4f OUT=build/firmware/m4f FOLDER/demo ...
# DEFS: how the core is configured. Run from the project's root.
OPT    ?= -O2
DEFS   ?=
NATIVE ?= cc
LTO    ?=
FLAGS  := -std=c99 $(OPT) -Wall -Wextra -Wpedantic -Wdouble-promotion -Werror -ffp-contract=off -Ilib -Itests/firmware
BOARD  := board_host

# Cortex-M: the compiler's own library (newlib), no start-up of its own.
BARE   := -mthumb -DPNEU_SINGLE -ffunction-sections -fdata-sections
BARE_LINK := --specs=nano.specs -nostartfiles -T tests/firmware/cortex.ld -Wl,--gc-sections

ifeq ($(TARGET),host) # what the targets are compared with
  CC := $(NATIVE)
  FLAGS += -DPNEU_SINGLE
else ifeq ($(TARGET),m4f)
  CC := arm-none-eabi-gcc
  FLAGS += $(BARE) -mcpu=cortex-m4 -mfloat-abi=hard -mfpu=fpv4-sp-d16 -DBOARD_CLOCK=25000000
  LINK := $(BARE_LINK)
  BOARD := board_cortex
else ifeq ($(TARGET),m0)
  CC := arm-none-eabi-gcc
  FLAGS += $(BARE) -mcpu=cortex-m0plus -mfloat-abi=soft -DBOARD_CLOCK=16000000
  LINK := $(BARE_LINK)
  BOARD := board_cortex
else ifeq ($(TARGET),i386) # headers of the kernel lie beside those of the 64-bit system
  CC := $(NATIVE) -m32
  FLAGS += -isystem /usr/include/$(shell $(NATIVE) -print-multiarch)
else ifeq ($(TARGET),s390x)
  CC := $(S390X)
  LINK := -static
else ifeq ($(TARGET),windows)
  CC := x86_64-w64-mingw32-gcc
  LINK := -static
else
  $(error TARGET: host, m4f, m0, i386, s390x or windows)
endif

LIB_O := $(patsubst lib/%.c,$(OUT)/lib/%.o,$(wildcard lib/*.c lib/effects/*.c))

.SECONDARY:
.DELETE_ON_ERROR:

$(OUT)/demo: $(OUT)/demo.o $(OUT)/rig_logs.o $(OUT)/$(BOARD).o $(OUT)/libpneu.a
$(OUT)/count: $(OUT)/count.o $(OUT)/$(BOARD).o $(OUT)/libpneu.a

$(OUT)/demo $(OUT)/count:
	$(CC) $(FLAGS) $(LTO) -fstack-usage $(LINK) $^ -lm -Wl,-Map=$@.map -o $@

# The core's tests, with a small stand-in for cmocka.
TEST_FLAGS := -D_POSIX_C_SOURCE=200809L -Itests/firmware/cmocka
TEST_NEEDS := $(OUT)/tests/check.o $(OUT)/cmocka/cmocka.o $(OUT)/tests/fixture.o $(OUT)/tests/second/rig.o $(OUT)/libpneu.a
$(OUT)/tests/lib/test_%: $(OUT)/tests/lib/test_%.o $(TEST_NEEDS)
	$(CC) $(FLAGS) $(LINK) $^ -lm -o $@
$(OUT)/tests/lib/test_%.exe: $(OUT)/tests/lib/test_%.o $(TEST_NEEDS)
	$(CC) $(FLAGS) $(LINK) $^ -lm -o $@

$(OUT)/libpneu.a: $(LIB_O)
	@rm -f $@
	$(if $(filter arm%,$(CC)),arm-none-eabi-ar,$(if $(filter s390x,$(TARGET)),s390x-linux-gnu-ar,$(if $(filter windows,$(TARGET)),x86_64-w64-mingw32-ar,ar))) rcs $@ $^

$(OUT)/lib/%.o: lib/%.c
	@mkdir -p $(@D)
	$(CC) $(FLAGS) $(LTO) -MMD -MP -fstack-usage $(DEFS) -c $< -o $@

$(OUT)/tests/%.o: tests/%.c
	@mkdir -p $(@D)
	$(CC) $(FLAGS) -MMD -MP $(TEST_FLAGS) $(DEFS) -c $< -o $@

$(OUT)/%.o: tests/firmware/%.c
	@mkdir -p $(@D)
	$(CC) $(FLAGS) -MMD -MP $(DEFS) -c $< -o $@

-include $(shell find $(OUT) -name '*.d' 2>/dev/null)
