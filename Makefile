# libpneu. `make help` lists the targets.
BUILD   ?= build
CC      ?= cc
CXX     ?= c++
OPT     ?= -O2
WARN    := -Wall -Wextra -Wpedantic -Wshadow -Wvla -Wundef -Wwrite-strings -Wold-style-definition \
           -Wstrict-prototypes -Wmissing-prototypes -Wdouble-promotion -Wpointer-arith
CFLAGS  ?= $(OPT) -g
CFLAGS  += -std=c99 $(WARN) -MMD -MP $(if $(SINGLE),-DPNEU_SINGLE)

PKGS     := libconfig nlopt udunits cjson
LAB_LIBS := $(BUILD)/liblab.a $(BUILD)/libpneu.a -lsundials_cvode -lsundials_nvecserial \
            -lnlopt -lconfig -ludunits2 -lcjson -lcminpack -lm
LAB_FLAGS := -D_POSIX_C_SOURCE=200809L -I/usr/include/cminpack-1 -fopenmp

LIB_C  := $(wildcard lib/*.c lib/effects/*.c)
LAB_C  := $(wildcard apps/lab/*.c apps/study/*.c)
PROGS  := sweep simulate
TEST_C := $(wildcard tests/test_*.c)

LIB_O  := $(LIB_C:%.c=$(BUILD)/%.o)
LAB_O  := $(LAB_C:%.c=$(BUILD)/%.o)
TESTS  := $(TEST_C:tests/%.c=$(BUILD)/tests/%)

.DELETE_ON_ERROR:
.PHONY: all help clean

## Build the library and the programs
all: $(BUILD)/libpneu.a $(PROGS)

## Show this list
help:
	@awk '/^## /{text=substr($$0,4)} /^[a-z-]+:/{if(text){sub(":.*","");printf "  make %-16s %s\n",$$0,text};text=""}' $(MAKEFILE_LIST)

$(BUILD)/libpneu.a: $(LIB_O)
	rm -f $@; $(AR) rcs $@ $^

$(BUILD)/liblab.a: $(LAB_O)
	rm -f $@; $(AR) rcs $@ $^

$(BUILD)/lib/%.o: lib/%.c
	@mkdir -p $(@D)
	$(CC) $(CFLAGS) -c $< -o $@

$(BUILD)/apps/%.o: apps/%.c
	@mkdir -p $(@D)
	$(CC) $(CFLAGS) $(LAB_FLAGS) -c $< -o $@

$(PROGS): %: $(BUILD)/apps/%.o $(BUILD)/liblab.a $(BUILD)/libpneu.a
	$(CC) $(CFLAGS) -fopenmp $< $(LAB_LIBS) -o $@

$(BUILD)/tests/%: tests/%.c $(BUILD)/liblab.a $(BUILD)/libpneu.a
	@mkdir -p $(@D)
	$(CC) $(CFLAGS) $(LAB_FLAGS) $< $(LAB_LIBS) -lcmocka -o $@

## Remove what was built, but no results
clean:
	rm -rf $(BUILD) $(PROGS)

-include $(shell find $(BUILD) -name '*.d' 2>/dev/null)
