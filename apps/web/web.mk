# closeloop as one HTML page, by Emscripten: build/web/closeloop.html.

WEB      := $(BUILD)/web
WEB_LIBS := $(WEB)/libraries
EMCC     ?= emcc
# Modules of Debian's node, which another node does not find
WEB_CC   := NODE_PATH="$${NODE_PATH:-/usr/share/nodejs}" $(EMCC)
UNITS    := packaging/cross/units

WEB_FLAGS := -std=c99 -O3 -ffp-contract=off -D_POSIX_C_SOURCE=200809L $(filter-out -Wdouble-promotion,$(WARN)) -Wno-unknown-pragmas $(if $(WERROR),-Werror)
WEB_C     := $(LIB_C) $(filter-out apps/lab/batch/% apps/lab/base/gnuplot.c,$(filter apps/lab/%,$(LAB_C))) $(UNITS)/units.c
WEB_O     := $(WEB_C:%.c=$(WEB)/%.o) $(WEB)/apps/web/web.o $(WEB)/units_table.o
WEB_LINK  := -sMODULARIZE=1 -sEXPORT_NAME=makeLab -sENVIRONMENT=worker -sFILESYSTEM=0 -sALLOW_MEMORY_GROWTH=1 \
             -sINITIAL_MEMORY=64MB -sMAXIMUM_MEMORY=4GB -sTOTAL_STACK=8MB -sEXPORTED_FUNCTIONS=_malloc,_free \
             -sEXPORTED_RUNTIME_METHODS=UTF8ToString,stringToUTF8,lengthBytesUTF8 --no-entry

## closeloop as one HTML page that runs in a browser, without network: build/web/closeloop.html; installs Emscripten
web:
	@sh study/install-packages.sh emscripten cmake dpkg-dev || $(GO_ON)
	@sh packaging/cross/libraries.sh wasm $(WEB_LIBS)
	@$(MAKE) --no-print-directory $(WEB)/closeloop.html
.PHONY: web

## See that the page gives the answers of the native programs, in a headless Chromium; RIGS='folders' tries these as well
web-check: all
	@sh study/install-packages.sh chromium python3 || $(GO_ON)
	@$(MAKE) --no-print-directory web >$(BUILD)/web.log 2>&1 || { tail -n 30 $(BUILD)/web.log; exit 1; }
	@BUILD='$(BUILD)' CC='$(CC)' RIGS='$(RIGS)' sh tests/check_web.sh
.PHONY: web-check

$(WEB)/%.o: %.c
	@mkdir -p $(@D)
	$(say) $(WEB_CC) $(WEB_FLAGS) $(DEPS) -I$(UNITS) -I$(WEB_LIBS)/include -I$(BUILD) -c $< -o $@
# What only the worker calls has no header; EM_JS is no standard C.
$(WEB)/apps/web/web.o: WEB_FLAGS := $(filter-out -std=c99 -Wpedantic -Wmissing-prototypes,$(WEB_FLAGS)) -std=gnu99
$(filter $(WEB)/apps/lab/report/%,$(WEB_O)): | $(CARRIED:%=$(BUILD)/%.inc)

$(WEB)/units_table.o: $(WEB)/units_table.c
	$(say) $(WEB_CC) $(WEB_FLAGS) -I$(UNITS) -c $< -o $@

$(WEB)/units_table.c: $(BUILD)/$(UNITS)/table_make
	@mkdir -p $(@D)
	$(say) $< $$(find /usr/share/xml/udunits /usr/share/udunits -name 'udunits2-*.xml' 2>/dev/null | sort) > $@

# It runs here, and asks this machine's UDUNITS-2.
$(BUILD)/$(UNITS)/table_make: $(UNITS)/table_make.c
	@mkdir -p $(@D)
	$(say) $(CC) $(FLAGS) $(shell pkg-config --cflags libxml-2.0) $< -lxml2 -ludunits2 -o $@

$(WEB)/lab.js: $(WEB_O)
	$(say) $(WEB_CC) -O3 $^ -L$(WEB_LIBS)/lib $(filter-out -ludunits2,$(LAB_LIBS)) $(WEB_LINK) -o $@

$(WEB)/lab.base64: $(WEB)/lab.js
	$(say) base64 $(WEB)/lab.wasm > $@

# As text of a page. The tables of units are those of UDUNITS-2; musl is the C library of Emscripten.
MUSL := $(dir $(shell command -v $(EMCC)))../share/emscripten/system/lib/libc/musl
$(WEB)/licences: $(WEB_LIBS)/licences
	$(say) { cat $<; for file in /usr/share/doc/libudunits2-data/copyright $(MUSL)/COPYRIGHT; do \
	  printf '==== %s\n\n' "$${file##*/share/}"; cat "$$file"; echo; done; } | sed 's/&/\&amp;/g; s/</\&lt;/g; s/>/\&gt;/g' > $@

$(WEB)/closeloop.html: apps/web/page.html apps/web/carry.awk apps/web/page.css apps/web/page.js apps/web/worker.js \
    apps/lab/report/page/common.css $(WEB)/lab.base64 $(WEB)/licences
	$(say) awk -v folders='apps/web apps/lab/report/page $(WEB)' -v version='$(VERSION)' -f apps/web/carry.awk $< > $@
	@ls -l $@ | awk '{ printf "  %s: %.2f MB\n", $$NF, $$5 / 1e6 }'
