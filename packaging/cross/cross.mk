# closeloop, simulate and export-fmu as programs of Windows, by MinGW: build/windows/libpneu-VERSION-windows.zip.

WINDOWS      := $(BUILD)/windows/programs
WINDOWS_LIBS := $(BUILD)/windows/libraries
WINDOWS_HOST := x86_64-w64-mingw32
# Threads of POSIX: OpenMP needs them.
WINDOWS_CC   := $(WINDOWS_HOST)-gcc-posix
PORT         := packaging/cross/windows
WINDOWS_EXE  := $(WINDOWS)/closeloop.exe $(WINDOWS)/simulate.exe $(WINDOWS)/export-fmu.exe
WINDOWS_ZIP  := libpneu-$(VERSION)-windows

# This compiler takes formats for those of Microsoft; the native build has checked them.
WINDOWS_FLAGS := -std=c99 $(OPT) $(WARN) -Wno-format $(if $(WERROR),-Werror) -ffp-contract=off $(OPENMP) -D_POSIX_C_SOURCE=200809L \
                 -D__USE_MINGW_ANSI_STDIO=1 -DLIBCONFIG_STATIC -DLIBXML_STATIC -DZIP_STATIC
WINDOWS_INCLUDE := -include $(PORT)/posix.h -I$(PORT) -I$(UNITS) -I$(WINDOWS_LIBS)/include -I$(WINDOWS_LIBS)/include/libxml2 -I$(BUILD)
WINDOWS_C := $(LIB_C) $(filter-out apps/lab/batch/% apps/lab/base/gnuplot.c apps/lab/base/interrupt.c,$(filter apps/lab/%,$(LAB_C))) \
             $(UNITS)/units.c $(wildcard $(PORT)/*.c)
WINDOWS_O := $(WINDOWS_C:%.c=$(WINDOWS)/%.o) $(WINDOWS)/units_table.o $(WINDOWS)/utf8.o

## closeloop, simulate and export-fmu for Windows, with their libraries inside: a zip in build/windows; installs MinGW
windows:
	@sh study/install-packages.sh gcc-mingw-w64-x86-64 libz-mingw-w64-dev cmake dpkg-dev zip || $(GO_ON)
	@sh packaging/cross/libraries.sh windows $(WINDOWS_LIBS)
	@$(MAKE) --no-print-directory $(BUILD)/windows/$(WINDOWS_ZIP).zip
.PHONY: windows

$(WINDOWS)/%.o: %.c
	@mkdir -p $(@D)
	$(say) $(WINDOWS_CC) $(WINDOWS_FLAGS) $(DEPS) $(WINDOWS_INCLUDE) -c $< -o $@
$(WINDOWS)/apps/lab/base/checksum.o: WINDOWS_FLAGS += -DLAB_BUILD='"'"$$(cat $(BUILD)/sources.cksum)"'"'
$(WINDOWS)/apps/lab/base/checksum.o: $(BUILD)/sources.cksum
$(filter $(WINDOWS)/apps/lab/report/%,$(WINDOWS_O)): | $(CARRIED:%=$(BUILD)/%.inc)
$(WINDOWS)/apps/fmu/carried.o: $(BUILD)/apps/fmu/carried.inc
$(WINDOWS)/apps/fmu/export.o: WINDOWS_FLAGS += $(if $(filter x86_64,$(shell uname -m)),-DFMU_LINUX64)

$(WINDOWS)/units_table.o: $(WEB)/units_table.c
	@mkdir -p $(@D)
	$(say) $(WINDOWS_CC) $(WINDOWS_FLAGS) -I$(UNITS) -c $< -o $@

# Names of files are UTF-8.
$(WINDOWS)/utf8.o: $(PORT)/utf8.rc $(PORT)/utf8.manifest
	@mkdir -p $(@D)
	$(say) $(WINDOWS_HOST)-windres -I$(PORT) $< $@

# posix.c has a main that goes before the program's.
$(WINDOWS)/export-fmu.exe: $(FMU_C:%.c=$(WINDOWS)/%.o)
$(WINDOWS)/export-fmu.exe: OWN_LIBS := -lzip -lz -lxml2 -lws2_32
$(WINDOWS_EXE): $(WINDOWS)/%.exe: $(WINDOWS)/apps/%.o $(WINDOWS_O)
	$(say) $(WINDOWS_CC) $(OPENMP) -s -static -Wl,--wrap=main $^ -L$(WINDOWS_LIBS)/lib $(OWN_LIBS) $(filter-out -ludunits2,$(LAB_LIBS)) -o $@

$(BUILD)/windows/$(WINDOWS_ZIP).zip: $(WINDOWS_EXE)
	@rm -rf $@ $(@D)/$(WINDOWS_ZIP) && mkdir -p $(@D)/$(WINDOWS_ZIP)
	@cp $(WINDOWS_EXE) README.md LICENSE $(@D)/$(WINDOWS_ZIP)/
	@cp $(WINDOWS_LIBS)/licences $(@D)/$(WINDOWS_ZIP)/licences.txt
	@cat /usr/share/doc/libudunits2-data/copyright /usr/share/doc/libz-mingw-w64-dev/copyright >> $(@D)/$(WINDOWS_ZIP)/licences.txt
	$(say) (cd $(@D) && zip -qr $(@F) $(WINDOWS_ZIP))
	@ls -l $@ | awk '{ printf "  %s: %.2f MB\n", $$NF, $$5 / 1e6 }'
