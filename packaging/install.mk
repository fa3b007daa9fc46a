# What leaves this folder: make install, uninstall, docs, deb; the shared library and what other builds find it by.

override PREFIX := $(abspath $(PREFIX))

DESTDIR    ?=
BINDIR     ?= $(PREFIX)/bin
LIBDIR     ?= $(PREFIX)/lib
INCLUDEDIR ?= $(PREFIX)/include/pneu
DATADIR    ?= $(PREFIX)/share
MANDIR     ?= $(DATADIR)/man
DOCDIR     ?= $(DATADIR)/doc/libpneu
INSTALL    ?= install

# The version is in lib/pneu.h and nowhere else.
version_part = $(shell sed -n 's/^\#define PNEU_VERSION_$(1) *\([0-9]*\)$$/\1/p' lib/pneu.h)
MAJOR   := $(call version_part,MAJOR)
MINOR   := $(call version_part,MINOR)
VERSION := $(MAJOR).$(MINOR).$(call version_part,PATCH)

STAGE   := $(BUILD)/stage
READY   := $(BUILD)/ready
INSTALLED_LIST := $(DATADIR)/pneu/installed.txt

# ---- Shared library: what pneu.h declares, and no more, is seen from outside ----

SHARED_O := $(LIB_C:%.c=$(BUILD)/shared/%.o)

ifeq ($(shell uname -s),Darwin)
SHARED_NAME := libpneu.$(VERSION).dylib
SONAME      := libpneu.$(MAJOR).dylib
LINK_NAME   := libpneu.dylib
EXPORTS     := $(READY)/pneu.exports
SHARED_LINK = -dynamiclib -install_name $(LIBDIR)/$(SONAME) -compatibility_version $(MAJOR).$(MINOR) \
              -current_version $(VERSION) -exported_symbols_list $(EXPORTS)
else
SHARED_NAME := libpneu.so.$(VERSION)
SONAME      := libpneu.so.$(MAJOR)
LINK_NAME   := libpneu.so
EXPORTS     := $(READY)/pneu.map
SHARED_LINK = -shared -Wl,-soname,$(SONAME) -Wl,--version-script,$(EXPORTS) -Wl,-Bsymbolic-functions -Wl,-z,defs
endif

SHARED := $(READY)/$(SHARED_NAME)

## Build the shared library
shared: $(SHARED)
.PHONY: shared

$(BUILD)/shared/lib/%.o: lib/%.c
	@mkdir -p $(@D)
	$(CC) $(FLAGS) -fPIC $(DEPS) $(CFLAGS) -c $< -o $@

# The functions of pneu.h, with a version that is that of the structs' layout.
$(READY)/pneu.exports: lib/pneu.h packaging/functions.awk packaging/install.mk
	@mkdir -p $(@D)
	awk -f packaging/functions.awk lib/pneu.h | sed 's/^/_/' > $@

$(READY)/pneu.map: lib/pneu.h packaging/functions.awk packaging/install.mk
	@mkdir -p $(@D)
	{ echo 'PNEU_$(MAJOR).$(MINOR) {'; echo '  global:'; awk -f packaging/functions.awk lib/pneu.h | sed 's/.*/    &;/'; \
	  echo '  local: *;'; echo '};'; } > $@

$(SHARED): $(SHARED_O) $(EXPORTS)
	$(CC) $(FLAGS) $(CFLAGS) $(SHARED_LINK) $(SHARED_O) $(LDFLAGS) -lm -o $@

# ---- What other builds find it by ----

# Where the prefix lies, seen from a folder below it; a folder elsewhere has the prefix as it is.
from_to_prefix = $(if $(filter $(PREFIX)/%,$(1)),$(2)$(shell echo '$(1:$(PREFIX)/%=%)' | sed 's|[^/][^/]*|..|g; s|^|/|'),$(PREFIX))
below_prefix   = $(1:$(PREFIX)/%=%)

FILL_IN = sed -e 's|@VERSION@|$(VERSION)|g' -e 's|@MAJOR@|$(MAJOR)|g' -e 's|@MINOR@|$(MINOR)|g' \
  -e 's|@PC_PREFIX@|$(call from_to_prefix,$(LIBDIR)/pkgconfig,$${pcfiledir})|' \
  -e 's|@CMAKE_PREFIX@|$(call from_to_prefix,$(LIBDIR)/cmake/pneu,$${CMAKE_CURRENT_LIST_DIR})|' \
  -e 's|@INCLUDEDIR@|$(call below_prefix,$(INCLUDEDIR))|' -e 's|@LIBDIR@|$(call below_prefix,$(LIBDIR))|' \
  -e 's|@PROGRAMS@|$(TOOLS)|' -e 's|@SHARED@|$(SHARED_NAME)|' -e 's|@SONAME@|$(SONAME)|' \
  -e "s|@POINTER@|$$(echo __SIZEOF_POINTER__ | $(CC) -E -P -)|"

# Made again when the places change.
$(READY)/places: FORCE
	@mkdir -p $(@D)
	@echo '$(VERSION) $(PREFIX) $(LIBDIR) $(INCLUDEDIR) $(DATADIR) $(TOOLS)' | cmp -s - $@ || \
	  echo '$(VERSION) $(PREFIX) $(LIBDIR) $(INCLUDEDIR) $(DATADIR) $(TOOLS)' > $@

$(READY)/%: packaging/%.in $(READY)/places
	@mkdir -p $(@D)
	@$(FILL_IN) $< > $@

# sweep finds its study where that is installed.
$(READY)/sweep.o: apps/sweep.c $(READY)/places
	$(CC) $(FLAGS) $(DEPS) $(LAB_FLAGS) $(CFLAGS) -DSWEEP_INSTALLED='"$(DATADIR)/pneu/study"' -c $< -o $@

$(READY)/sweep: $(READY)/sweep.o $(LAB) $(STATIC)
	$(CC) $(FLAGS) $(LAB_FLAGS) $(CFLAGS) $(filter %.o %.a,$^) $(LDFLAGS) $(LAB_LIBS) -o $@

# ---- Manual: pages named after what they describe; tables in them come from the sources ----

MAN := $(patsubst packaging/man/%.in,%,$(wildcard packaging/man/*.in))

$(BUILD)/packaging/man/tables: $(BUILD)/packaging/man/tables.o $(LAB) $(STATIC)
	$(CC) $(FLAGS) $(LAB_FLAGS) $(CFLAGS) $^ $(LDFLAGS) $(LAB_LIBS) -o $@

$(BUILD)/packaging/%.o: packaging/%.c
	@mkdir -p $(@D)
	$(CC) $(FLAGS) $(DEPS) $(LAB_FLAGS) $(CFLAGS) -c $< -o $@

$(MAN:%=$(READY)/man/%): $(READY)/man/%: packaging/man/%.in packaging/man/fill.awk lib/pneu.h $(BUILD)/packaging/man/tables
	@mkdir -p $(@D)
	awk -v TABLES=$(BUILD)/packaging/man/tables -v HEADER=lib/pneu.h -f packaging/man/fill.awk $< > $@

## Make the pages of the manual: build/ready/man
man: $(MAN:%=$(READY)/man/%)
.PHONY: man

# ---- Pages on the interface ----

## Make pages on the interface from lib/pneu.h, by Doxygen, which it installs: build/docs/html
docs:
	@command -v doxygen >/dev/null || sh study/install-packages.sh doxygen
	@rm -rf $(BUILD)/docs
	@mkdir -p $(BUILD)/docs
	@{ cat packaging/doxygen/Doxyfile; echo 'PROJECT_NUMBER = $(VERSION)'; echo 'OUTPUT_DIRECTORY = "$(BUILD)/docs"'; \
	  echo 'FILTER_PATTERNS = "*.h=awk -f packaging/doxygen/filter.awk"'; } > $(BUILD)/docs/Doxyfile
	@doxygen $(BUILD)/docs/Doxyfile
	@echo "docs: $(BUILD)/docs/html/index.html"
.PHONY: docs

# ---- Install ----

INSTALLED_PROGS := $(filter-out sweep,$(TOOLS)) $(READY)/sweep
STUDY_DIRS      := actuators figures measured

# Everything in its place below a folder of its own.
stage: $(STATIC) $(SHARED) $(INSTALLED_PROGS) man $(READY)/pneu.pc $(READY)/pneuConfig.cmake $(READY)/pneuConfigVersion.cmake \
       $(READY)/completion/pneu.bash $(READY)/completion/_pneu
	@rm -rf $(STAGE)
	@$(INSTALL) -d $(addprefix $(STAGE),$(BINDIR) $(LIBDIR)/pkgconfig $(LIBDIR)/cmake/pneu $(INCLUDEDIR) $(DOCDIR)/examples \
	  $(MANDIR)/man1 $(MANDIR)/man3 $(MANDIR)/man5 $(STUDY_DIRS:%=$(DATADIR)/pneu/study/%) \
	  $(DATADIR)/bash-completion/completions $(DATADIR)/zsh/site-functions)
	@$(INSTALL) -m 755 $(INSTALLED_PROGS) $(STAGE)$(BINDIR)
	@$(INSTALL) -m 644 lib/pneu.h lib/effects.def $(STAGE)$(INCLUDEDIR)
	@$(INSTALL) -m 644 $(STATIC) $(SHARED) $(STAGE)$(LIBDIR)
	@ln -s $(SHARED_NAME) $(STAGE)$(LIBDIR)/$(SONAME)
	@ln -s $(SONAME) $(STAGE)$(LIBDIR)/$(LINK_NAME)
	@$(INSTALL) -m 644 $(READY)/pneu.pc $(STAGE)$(LIBDIR)/pkgconfig
	@$(INSTALL) -m 644 $(READY)/pneuConfig.cmake $(READY)/pneuConfigVersion.cmake $(STAGE)$(LIBDIR)/cmake/pneu
	@for page in $(MAN); do $(INSTALL) -m 644 $(READY)/man/$$page $(STAGE)$(MANDIR)/man$${page##*.} || exit 1; done
	@ln -s libpneu.3 $(STAGE)$(MANDIR)/man3/pneu.3
	@for program in $(TOOLS); do \
	  $(INSTALL) -m 644 $(READY)/completion/pneu.bash $(STAGE)$(DATADIR)/bash-completion/completions/$$program || exit 1; done
	@$(INSTALL) -m 644 $(READY)/completion/_pneu $(STAGE)$(DATADIR)/zsh/site-functions
	@$(INSTALL) -m 644 study/hypotheses.cfg study/PAPER.md $(STAGE)$(DATADIR)/pneu/study
	@for folder in $(STUDY_DIRS); do \
	  $(INSTALL) -m 644 study/$$folder/* $(STAGE)$(DATADIR)/pneu/study/$$folder || exit 1; done
	@chmod 755 $(STAGE)$(DATADIR)/pneu/study/measured/fetch.sh
	@$(INSTALL) -m 644 README.md DESIGN.md TRIED.md CHANGELOG.md LICENSE $(STAGE)$(DOCDIR)
	@cp -R tests/consumers/* $(STAGE)$(DOCDIR)/examples
	@chmod -R u=rwX,go=rX $(STAGE)
.PHONY: stage

## Install library, programs, manual and study below PREFIX (/usr/local); DESTDIR=... puts a folder before it
install: stage
	@sh packaging/install.sh install $(STAGE) '$(DESTDIR)' '$(INSTALLED_LIST)'
	@echo "installed below $(DESTDIR)$(PREFIX); what and where: $(DESTDIR)$(INSTALLED_LIST)"
	@[ -n '$(DESTDIR)' ] || sh packaging/install.sh found '$(LIBDIR)' '$(BINDIR)'

## Remove what make install has put there, and no more
uninstall:
	@sh packaging/install.sh uninstall '$(DESTDIR)' '$(INSTALLED_LIST)'
.PHONY: install uninstall

# ---- Debian packages ----

DEB_TOOLS := build-essential debhelper dpkg-dev fakeroot lintian doxygen

## Build packages for Debian (libpneu0, -dev, -doc, pneu-tools) and check them by lintian: build/deb; MAINTAINER="Name <address>"; installs the tools
deb:
	@sh study/install-packages.sh
	@sh study/install-packages.sh $(DEB_TOOLS)
	@MAINTAINER='$(MAINTAINER)' sh packaging/deb.sh $(BUILD)/deb $(VERSION)
.PHONY: deb

## Install these packages in a fresh Debian, made by debootstrap, and run the README's examples there; needs root
deb-check: deb
	@sh study/install-packages.sh debootstrap
	@sh tests/check_deb.sh $(BUILD)/deb
.PHONY: deb-check
