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

$(BUILD)/fmu2.so: OTHER := %/fmi3.c %/fmi3_absent.c
$(BUILD)/fmu3.so: OTHER := %/fmi2.c
$(BUILD)/fmu2.so $(BUILD)/fmu3.so: $(FMU_FILES)
	@mkdir -p $(@D)
	$(say) $(CC) $(FMU_FLAGS) $(CFLAGS) -shared -s $(LIB_C) $(filter-out $(OTHER),$(FMU_RUNTIME)) $(LDFLAGS) -lm -o $@

FMU_CARRIED := $(foreach file,$(FMU_FILES),$(file)=$(file)) fmu2.so=$(BUILD)/fmu2.so fmu3.so=$(BUILD)/fmu3.so \
               icon.svg=apps/fmu/carried/icon.svg icon.png=apps/fmu/carried/icon.png index.html=apps/fmu/carried/index.html license.txt=LICENSE
$(BUILD)/apps/fmu/carried.inc: $(FMU_FILES) $(BUILD)/fmu2.so $(BUILD)/fmu3.so $(wildcard apps/fmu/carried/*) LICENSE apps/fmu/carry.sh
	@mkdir -p $(@D)
	$(say) sh apps/fmu/carry.sh $(FMU_CARRIED) > $@

$(BUILD)/apps/fmu/carried.o: $(BUILD)/apps/fmu/carried.inc
$(BUILD)/apps/fmu/%.o: LAB_FLAGS += -I$(BUILD) $(FMU_XML)

$(FMU): $(FMU_C:%.c=$(BUILD)/%.o)
	@rm -f $@
	$(say) $(AR) rcs $@ $^

export-fmu: $(BUILD)/apps/export-fmu.o $(FMU) $(LAB) $(STATIC) $(BUILD)/jobs
	$(say) $(CC) $(FLAGS) $(LAB_FLAGS) $(CFLAGS) $(filter %.o %.a,$^) $(LDFLAGS) $(FMU_LIBS) $(LAB_LIBS) -o $@

$(BUILD)/tests/fmu/native: $(BUILD)/tests/fmu/native.o $(LAB) $(STATIC)
	$(say) $(CC) $(FLAGS) $(LAB_FLAGS) $(CFLAGS) $^ $(LDFLAGS) $(LAB_LIBS) -o $@
