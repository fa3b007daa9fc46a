# export-fmu and what it carries inside: the sources of an FMU, and for each version of FMI a shared library made from
# them, into which it puts a model's data.

FMU_C       := $(wildcard apps/fmu/*.c) apps/fmu/runtime/shape.c
FMU_RUNTIME := $(wildcard apps/fmu/runtime/*.c)
FMU_FILES   := $(sort $(wildcard lib/*.[ch] lib/*.def lib/effects/*.c apps/fmu/runtime/*.[ch]))
FMU         := $(BUILD)/libfmu.a
FMU_XML     := $(shell pkg-config --cflags libxml-2.0 2>/dev/null)
FMU_LIBS    := -lzip $(or $(shell pkg-config --libs libxml-2.0 2>/dev/null),-lxml2)

# Not optimised across files: the model's data are constants to the compiler only in their own.
FMU_FLAGS := -std=c99 $(OPT) $(WARN) $(if $(WERROR),-Werror) -ffp-contract=off -fPIC -fvisibility=hidden -fno-lto

# For Windows too, where MinGW is.
FMU_MINGW   := $(shell command -v x86_64-w64-mingw32-gcc 2>/dev/null)
FMU_SHARED  := fmu2.so fmu3.so $(if $(FMU_MINGW),fmu2.dll fmu3.dll)

$(BUILD)/fmu2.%: OTHER := %/fmi3.c %/fmi3_absent.c
$(BUILD)/fmu3.%: OTHER := %/fmi2.c
$(BUILD)/fmu2.so $(BUILD)/fmu3.so: $(FMU_FILES)
	@mkdir -p $(@D)
	$(say) $(CC) $(FMU_FLAGS) $(CFLAGS) -shared -s $(LIB_C) $(filter-out $(OTHER),$(FMU_RUNTIME)) $(LDFLAGS) -lm -o $@

# No date goes into it: the same sources give the same bytes.
$(BUILD)/fmu2.dll $(BUILD)/fmu3.dll: $(FMU_FILES)
	@mkdir -p $(@D)
	$(say) $(FMU_MINGW) $(filter-out -fPIC -fvisibility%,$(FMU_FLAGS)) -Wno-format -shared -static -s -Wl,--no-insert-timestamp \
	  $(LIB_C) $(filter-out $(OTHER),$(FMU_RUNTIME)) -o $@

FMU_CARRIED := $(foreach file,$(FMU_FILES),$(file)=$(file)) $(foreach file,$(FMU_SHARED),$(file)=$(BUILD)/$(file)) \
               icon.svg=apps/fmu/carried/icon.svg icon.png=apps/fmu/carried/icon.png index.html=apps/fmu/carried/index.html license.txt=LICENSE \
               terminalsAndIcons.xml=apps/fmu/carried/terminalsAndIcons.xml
$(BUILD)/apps/fmu/carried.inc: $(FMU_FILES) $(FMU_SHARED:%=$(BUILD)/%) $(wildcard apps/fmu/carried/*) LICENSE apps/fmu/carry.sh \
                               $(BUILD)/carries
	@mkdir -p $(@D)
	$(say) sh apps/fmu/carry.sh $(FMU_CARRIED) > $@

# MinGW may come after the first build.
$(BUILD)/carries: FORCE
	@mkdir -p $(BUILD)
	@echo '$(FMU_SHARED)' | cmp -s - $@ || echo '$(FMU_SHARED)' >$@

$(BUILD)/apps/fmu/carried.o: $(BUILD)/apps/fmu/carried.inc
$(BUILD)/apps/fmu/%.o: LAB_FLAGS += -I$(BUILD) $(FMU_XML)

$(FMU): $(FMU_C:%.c=$(BUILD)/%.o)
	@rm -f $@
	$(say) $(AR) rcs $@ $^

export-fmu: $(BUILD)/apps/export-fmu.o $(FMU) $(LAB) $(STATIC) $(BUILD)/jobs
	$(say) $(CC) $(FLAGS) $(LAB_FLAGS) $(CFLAGS) $(filter %.o %.a,$^) $(LDFLAGS) $(FMU_LIBS) $(LAB_LIBS) -o $@

$(BUILD)/tests/fmu/native: $(BUILD)/tests/fmu/native.o $(LAB) $(STATIC)
	$(say) $(CC) $(FLAGS) $(LAB_FLAGS) $(CFLAGS) $^ $(LDFLAGS) $(LAB_LIBS) -o $@
