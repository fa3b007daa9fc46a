# Whether lib/ is what any C99 compiler takes: clang with every warning that it has, also as if for Windows; mingw-w64 and Wine.

CLANG ?= clang
CLANGXX ?= clang++

# What is left out of -Weverything, and why:
#   padded          open structs are laid out by what belongs together
#   float-equal     exact comparisons are meant: a neutral parameter, a division by zero
#   unsafe-buffer-usage           every array of C (clang 16 and later)
#   declaration-after-statement   none is there; C99 would allow it (clang 14 warns for C90 only)
#   duplicate-enum, enum-enum-conversion   an effect has a place in the list of effects and one among the parameters
#   unknown-warning-option        for compilers without one of these
STRICT := -std=c99 -pedantic-errors -Weverything -Werror -Wno-unknown-warning-option -Wno-padded -Wno-float-equal \
          -Wno-unsafe-buffer-usage -Wno-duplicate-enum -Wno-enum-enum-conversion -Wno-declaration-after-statement -fsyntax-only

# One file after the other, so that no more is found in one than in all: each_file FLAGS
each_file = for file in $(LIB_C); do $(CLANG) $(STRICT) $(1) $$file || exit 1; done

## Every warning of clang on lib/, in each configuration and as if for Windows; installs clang and mingw-w64's headers
strict:
	@command -v $(CLANG) >/dev/null || sh study/install-packages.sh clang
	@for flags in '' -DPNEU_SINGLE -DPNEU_ORDER=4 -DPNEU_TERM_KNOTS=0; do \
	  $(call each_file,$$flags); done
	@if [ -d /usr/share/mingw-w64/include ] || sh study/install-packages.sh mingw-w64-common; then \
	  $(call each_file,--target=x86_64-pc-windows-msvc -fms-compatibility -isystem /usr/share/mingw-w64/include); \
	  else echo "absent: headers of mingw-w64"; fi
	@for standard in c90 c99 c11 c2x; do echo '#include "pneu.h"' | \
	  $(CLANG) -x c $(filter-out -std=%,$(STRICT)) -std=$$standard -Ilib - || exit 1; done
	@for standard in c++98 c++11 c++20; do echo '#include "pneu.h"' | \
	  $(CLANGXX) -x c++ $(filter-out -std=%,$(STRICT)) -std=$$standard -Ilib - || exit 1; done
	@echo "strict: nothing found in $(words $(LIB_C)) files and the header"
.PHONY: strict

## Build core and programs for Windows by mingw-w64, run the tests under Wine and compare answers; installs both
windows-check: closeloop simulate windows
	@sh study/install-packages.sh gcc-mingw-w64-x86-64 wine64 wine
	@MAKE='$(MAKE)' CC='$(CC)' BUILD='$(BUILD)' MEASURED='$(MEASURED)' RIGS='$(RIGS)' sh tests/check_windows.sh
.PHONY: windows-check
