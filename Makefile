# Graze. `make demo` and `make test` are all a newcomer needs; CONTRIBUTING.md explains the tree.
.SUFFIXES:
.DELETE_ON_ERROR:
# Objects of the tools are made by two pattern rules in a row; keep them.
.SECONDARY:
.DEFAULT_GOAL := all

VERSION := 0.1.0
BUILD   := build
BIN     := bin
LIB     := lib
CC      ?= cc
CXX     ?= c++
OBJCOPY ?= objcopy
OPTIMIZE ?= -O2
WARN    := -Wall -Wextra -Wpedantic -Wshadow -Wstrict-prototypes -Wmissing-prototypes
# No contraction: the same bits from every compiler. POSIX 2008 for files, pipes and threads.
CFLAGS  ?= $(OPTIMIZE) -g
ALL_CFLAGS = -std=c11 -D_POSIX_C_SOURCE=200809L -DGRAZE_VERSION='"$(VERSION)"' -ffp-contract=off -fno-math-errno \
             -fvisibility=hidden -fPIC -pthread $(WARN) -Iinclude -Isrc $(CFLAGS) $(EXTRA_CFLAGS)

# Each folder of src/ is an archive; it may use the folders named here and what they use (the table in CONTRIBUTING.md).
FOLDERS := base brdf rad image geometry material scene trace picture
USES_base     :=
USES_brdf     :=
USES_rad      := base
USES_image    := base
USES_geometry := rad base
USES_material := brdf rad image base
USES_scene    := material geometry brdf rad image base
USES_trace    := scene material geometry brdf rad image base
USES_picture  := trace scene material geometry brdf rad image base

LIBS_base     := -pthread
LIBS_image    := -lOpenEXRCore -ldl
LIBS_geometry := -lembree3 -ldl

archive = $(BUILD)/lib$(1).a
closure = $(1) $(USES_$(1))
archives = $(foreach f,$(call closure,$(1)),$(call archive,$(f)))
libs = -Wl,--as-needed $(foreach f,$(call closure,$(1)),$(LIBS_$(f))) -lm

SOURCES   := $(foreach f,$(FOLDERS),$(wildcard src/$(f)/*.c))
TOOLS     := $(patsubst src/tools/%.c,$(BIN)/%,$(wildcard src/tools/*.c))
TESTS     := $(foreach f,$(FOLDERS),$(patsubst test/%.c,$(BUILD)/test/%,$(wildcard test/$(f)/*.c)))
STATIC    := $(LIB)/libgraze.a
SONAME    := libgraze.so.0
SHARED    := $(LIB)/libgraze.so.$(VERSION)
LIBRARIES := $(STATIC) $(SHARED) $(LIB)/$(SONAME) $(LIB)/libgraze.so $(LIB)/graze/oiio.so

.PHONY: all programs tests
all: $(TOOLS) $(LIBRARIES)
programs: $(TOOLS) $(LIB)/graze/oiio.so
tests: $(TESTS)

# One short line for each file; V=1 shows whole commands.
say = $(if $(V),,@echo '  $(1)';)

# Everything compiled depends on this file, so that other flags or another compiler compile everything again; it changes
# only when they do. The same for the list of sources, so that a library forgets a source that is gone.
quote = '$(subst ','\'',$(1))'
define record_rule
$(BUILD)/$(1): FORCE
	@mkdir -p $$(@D)
	@echo $$(call quote,$(2)) | cmp -s - $$@ || echo $$(call quote,$(2)) >$$@
endef
.PHONY: FORCE
$(eval $(call record_rule,flags,$$(CC) $$(CXX) $$(ALL_CFLAGS) $$(LDFLAGS)))
$(eval $(call record_rule,sources,$$(SOURCES)))

define folder_rules
SOURCES_$(1) := $$(wildcard src/$(1)/*.c)
$(call archive,$(1)): $$(SOURCES_$(1):src/%.c=$(BUILD)/obj/%.o) $(BUILD)/sources
	@rm -f $$@
	$$(if $$(V),,@)$$(AR) rcs $$@ $$(filter %.o,$$^)
TESTS_$(1) := $$(patsubst test/%.c,$(BUILD)/test/%,$$(wildcard test/$(1)/*.c))
$$(TESTS_$(1)): $(BUILD)/test/%: test/%.c $(call archives,$(1)) $(BUILD)/flags
	@mkdir -p $$(@D)
	$$(call say,$$@)$$(CC) $$(ALL_CFLAGS) -Itest -MMD -MP -o $$@ $$< $(call archives,$(1)) $(call libs,$(1)) -lcmocka -lmpfr -lgmp $$(LDFLAGS)
# check-FOLDER: build and run one folder's tests.
.PHONY: check-$(1)
check-$(1): $$(TESTS_$(1))
	@for t in $$^; do echo "== $$$$t"; CMOCKA_MESSAGE_OUTPUT=TAP $$$$t || exit 1; done
endef
$(foreach f,$(FOLDERS),$(eval $(call folder_rules,$(f))))

$(BUILD)/obj/%.o: src/%.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(call say,$<)$(CC) $(ALL_CFLAGS) -MMD -MP -c -o $@ $<

# What the tools share among them, beside the library.
$(BUILD)/libtools.a: $(patsubst src/%.c,$(BUILD)/obj/%.o,$(wildcard src/tools/common/*.c))
	@rm -f $@
	@$(AR) rcs $@ $^
$(BIN)/%: $(BUILD)/obj/tools/%.o $(BUILD)/libtools.a $(call archives,picture)
	@mkdir -p $(@D)
	$(call say,$@)$(CC) $(ALL_CFLAGS) -o $@ $< $(BUILD)/libtools.a $(call archives,picture) $(call libs,picture) $(LDFLAGS)

# How well pictures agree: a small program for the demo and the tests.
$(BUILD)/agreement: scripts/agreement.c $(call archives,image) $(BUILD)/flags
	$(call say,$@)$(CC) $(ALL_CFLAGS) -MMD -MP -o $@ $< $(call archives,image) $(call libs,image) $(LDFLAGS)

# The libraries show nothing but what the public headers mark GRAZE_API. In the static one that is done by linking objects into
# one and making the hidden names local; three of them, so that a program that needs only the BRDF or the materials gets no more
# than that, and needs nothing but libm.
OBJECTS := $(SOURCES:src/%.c=$(BUILD)/obj/%.o)
PARTS   := brdf material scene
OBJECTS_brdf     := $(filter $(BUILD)/obj/brdf/%,$(OBJECTS))
OBJECTS_material := $(filter-out %/from_primitive.o,$(filter $(BUILD)/obj/material/%,$(OBJECTS))) $(BUILD)/obj/base/vector.o
OBJECTS_scene    := $(filter-out $(OBJECTS_brdf) $(filter-out %/vector.o,$(OBJECTS_material)),$(OBJECTS))
define part_rule
$(BUILD)/parts/$(1).o: $(OBJECTS_$(1)) $(BUILD)/sources
	@mkdir -p $$(@D)
	$$(call say,$$@)$$(LD) -r -o $$@ $(OBJECTS_$(1))
	@$$(OBJCOPY) --localize-hidden $$@
endef
$(foreach part,$(PARTS),$(eval $(call part_rule,$(part))))
$(STATIC): $(PARTS:%=$(BUILD)/parts/%.o)
	@mkdir -p $(@D)
	@rm -f $@
	$(call say,$@)$(AR) rcs $@ $^

$(SHARED): $(OBJECTS) $(BUILD)/sources
	@mkdir -p $(@D)
	$(call say,$@)$(CC) $(ALL_CFLAGS) -shared -Wl,-soname,$(SONAME) -Wl,--no-undefined -o $@ $(OBJECTS) $(call libs,picture) $(LDFLAGS)

$(LIB)/$(SONAME) $(LIB)/libgraze.so: $(SHARED)
	@ln -sf $(<F) $@

# OpenImageIO behind a C interface: opened only when a picture's format needs it.
$(LIB)/graze/oiio.so: src/image/oiio.cpp src/image/oiio.h $(BUILD)/flags
	@mkdir -p $(@D)
	$(call say,$@)$(CXX) -std=c++17 -O2 -shared -fPIC -fvisibility=hidden -Wall -Wextra -Wpedantic -Wshadow -Isrc -o $@ $< \
	    -lOpenImageIO -lOpenImageIO_Util

# --- What people run -------------------------------------------------------------------------------------------------

JOBS = $(if $(filter -j% --jobserver%,$(MAKEFLAGS)),,-j2)
PEER := yes

.PHONY: demo test bench asan
# demo: render the paper's grazing scene with each strategy; installs what is missing first
demo:
	@scripts/install-dependencies build
	@$(MAKE) $(JOBS) --no-print-directory all $(BUILD)/agreement
	@scripts/demo $(BIN) $(BUILD)/agreement out

# test: build and run all tests; installs what is missing first. PEER=no leaves out the comparison with real Radiance
test:
	@scripts/install-dependencies build test
	@$(if $(filter no,$(PEER)),,scripts/install-peer)
	@$(MAKE) $(JOBS) --no-print-directory all tests
	@BUILD=$(BUILD) BIN=$(BIN) MAKE=$(MAKE) test/run $(TEST_GROUPS)
test: TEST_GROUPS = unit cli $(if $(filter no,$(PEER)),,peer)

# bench: rays a second beside real Radiance's rtrace
bench:
	@scripts/install-dependencies build test
	@scripts/install-peer
	@$(MAKE) $(JOBS) --no-print-directory all
	@BIN=$(abspath $(BIN)) GRAZE_PEER=$(abspath build/peer) build/peer/bin/python test/bench/rays.py

# asan: unit and command-line tests under the address and undefined-behaviour sanitizers, built in build-asan
SANITIZE := -fsanitize=address,undefined -fno-sanitize-recover=all
asan:
	@scripts/install-dependencies build test
	@$(MAKE) $(JOBS) --no-print-directory BUILD=build-asan BIN=build-asan/bin LIB=build-asan/lib \
	    EXTRA_CFLAGS='$(SANITIZE)' LDFLAGS='$(SANITIZE)' programs tests
	@BUILD=build-asan BIN=build-asan/bin GRAZE_SANITIZED=1 test/run unit cli

C_FILES = $(shell find src include test examples scripts -name '*.[ch]' -o -name '*.cpp' | sort)
.PHONY: format lint
# format: put all C and C++ files into the house's layout
format:
	@scripts/install-dependencies lint
	clang-format -i $(C_FILES)

# lint: layout, clang-tidy, cppcheck; all must be clean
# (clang-tidy 14 confuses the va_lists of files that it checks in one run.)
lint:
	@scripts/install-dependencies build test lint
	clang-format --dry-run -Werror $(C_FILES)
	printf '%s\n' $(filter %.c,$(C_FILES)) | xargs -P 2 -I FILE clang-tidy --quiet FILE -- $(ALL_CFLAGS) -Itest
	cppcheck --quiet --std=c11 --language=c --enable=warning,performance,portability --inline-suppr --error-exitcode=1 \
	    --suppress=missingIncludeSystem -DGRAZE_VERSION='"$(VERSION)"' -Iinclude -Isrc $(filter src/%.c,$(C_FILES))

# --- Installation ----------------------------------------------------------------------------------------------------

PREFIX  ?= /usr/local
INSTALL ?= install
dest    = $(DESTDIR)$(PREFIX)
# What `uninstall` removes and `install` puts there, both relative to the prefix. The folders named graze are ours alone.
MANUALS   := $(wildcard man/man?/*.[0-9])
INSTALLED  = $(TOOLS:$(BIN)/%=bin/%) lib/libgraze.a lib/$(notdir $(SHARED)) lib/$(SONAME) lib/libgraze.so \
             lib/pkgconfig/graze.pc $(MANUALS:%=share/%)

.PHONY: install uninstall
# install: into PREFIX (/usr/local), below DESTDIR
install: all
	$(INSTALL) -d $(dest)/bin $(dest)/lib/graze $(dest)/lib/pkgconfig $(dest)/include/graze $(dest)/share/doc/graze
	$(INSTALL) $(TOOLS) $(dest)/bin
	$(INSTALL) -m 644 $(STATIC) $(dest)/lib
	$(INSTALL) -m 644 $(SHARED) $(dest)/lib
	ln -sf $(notdir $(SHARED)) $(dest)/lib/$(SONAME)
	ln -sf $(SONAME) $(dest)/lib/libgraze.so
	$(INSTALL) -m 644 $(LIB)/graze/oiio.so $(dest)/lib/graze
	$(INSTALL) -m 644 include/graze/*.h $(dest)/include/graze
	sed -e 's|@PREFIX@|$(PREFIX)|' -e 's|@VERSION@|$(VERSION)|' -e 's|@LIBS@|$(sort $(filter -l% -pthread,$(call libs,picture)))|' \
	    scripts/graze.pc.in >$(dest)/lib/pkgconfig/graze.pc
	for page in $(MANUALS); do $(INSTALL) -D -m 644 $$page $(dest)/share/$$page || exit 1; done
	$(INSTALL) -m 644 LICENSE $(dest)/share/doc/graze

# uninstall: remove what install put there
uninstall:
	rm -f $(addprefix $(dest)/,$(INSTALLED))
	rm -rf $(dest)/lib/graze $(dest)/include/graze $(dest)/share/doc/graze

.PHONY: clean help
# clean: remove everything that was built or downloaded
clean:
	rm -rf $(BUILD) build-asan $(BIN) $(LIB) out

# help: this list
help:
	@sed -n 's/^# \([a-zA-Z-]*\): /\1\t/p' Makefile | expand -t 14

-include $(shell find $(BUILD) -name '*.d' 2>/dev/null)
