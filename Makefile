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
FOLDERS := base brdf rad cal image fit geometry material scene trace picture
USES_base     :=
USES_brdf     :=
USES_rad      := base
USES_cal      := base
USES_image    := base
USES_fit      := brdf base
USES_geometry := rad base
USES_material := brdf rad cal image base
USES_scene    := material geometry brdf rad cal image base
USES_trace    := scene material geometry brdf rad cal image base
USES_picture  := trace scene material geometry brdf rad cal image base

LIBS_base     := -pthread
LIBS_image    := -lOpenEXRCore -ldl
LIBS_fit      := -lcminpack
LIBS_geometry := -lembree3 -ldl

archive = $(BUILD)/lib$(1).a
closure = $(1) $(USES_$(1))
archives = $(foreach f,$(call closure,$(1)),$(call archive,$(f)))
libs = -Wl,--as-needed $(foreach f,$(call closure,$(1)),$(LIBS_$(f))) -lm

# What the libraries are made of; src/fit is brdffit's alone.
SOURCES   := $(foreach f,$(filter-out fit,$(FOLDERS)),$(wildcard src/$(f)/*.c))
TOOLS     := $(patsubst src/tools/%.c,$(BIN)/%,$(wildcard src/tools/*.c))
TESTS     := $(foreach f,$(FOLDERS),$(patsubst test/%.c,$(BUILD)/test/%,$(wildcard test/$(f)/*.c)))
STATIC    := $(LIB)/libgraze.a
SONAME    := libgraze.so.0
SHARED    := $(LIB)/libgraze.so.$(VERSION)
LIBRARIES := $(STATIC) $(SHARED) $(LIB)/$(SONAME) $(LIB)/libgraze.so $(LIB)/graze/oiio.so

.PHONY: all programs tests
# all: the tools and the library
all: $(TOOLS) $(LIBRARIES)
programs: $(TOOLS) $(LIB)/graze/oiio.so
tests: $(TESTS)

# One short line for each file; V=1 shows whole commands.
say = $(if $(V),,@echo '  $(1)';)

# Everything compiled depends on this file, so that other flags or another compiler compile everything again; it changes
# only when they do. The same for the list of sources of each archive, each tool and the library, so that none keeps a source
# that is gone or lacks one whose object was there before.
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
$(call record_rule,lib$(1).sources,$$(SOURCES_$(1)))
$(call archive,$(1)): $$(SOURCES_$(1):src/%.c=$(BUILD)/obj/%.o) $(BUILD)/lib$(1).sources
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
# The reflectance models are loops to make vector code of; that -ftrapping-math would forbid in part.
$(BUILD)/obj/brdf/%.o: OPTIMIZE := -O3 -fno-trapping-math
$(BUILD)/obj/scene/light_weights_%.o: OPTIMIZE := -O3 -fno-trapping-math

# What the tools share among them, beside the library.
SOURCES_tools := $(wildcard src/tools/common/*.c)
$(eval $(call record_rule,libtools.sources,$$(SOURCES_tools)))
$(BUILD)/libtools.a: $(SOURCES_tools:src/%.c=$(BUILD)/obj/%.o) $(BUILD)/libtools.sources
	@rm -f $@
	@$(AR) rcs $@ $(filter %.o,$^)
# A tool is src/tools/NAME.c, and the files in src/tools/NAME if that is not all of it. It links src/picture and all that
# uses, or what BASIS_NAME says.
BASIS_brdffit := fit
define tool_rule
PARTS_$(notdir $(1)) := $$(patsubst src/%.c,$(BUILD)/obj/%.o,$$(wildcard src/tools/$(notdir $(1)).c src/tools/$(notdir $(1))/*.c))
$(call record_rule,$(notdir $(1)).sources,$$(PARTS_$(notdir $(1))))
$(1): $$(PARTS_$(notdir $(1))) $(BUILD)/$(notdir $(1)).sources $(BUILD)/libtools.a $(call archives,$(or $(BASIS_$(notdir $(1))),picture))
	@mkdir -p $$(@D)
	$$(call say,$$@)$$(CC) $$(ALL_CFLAGS) -o $$@ $$(PARTS_$(notdir $(1))) $(BUILD)/libtools.a $(call archives,$(or $(BASIS_$(notdir $(1))),picture)) \
	    $(call libs,$(or $(BASIS_$(notdir $(1))),picture)) $$(LDFLAGS)
endef
$(foreach tool,$(TOOLS),$(eval $(call tool_rule,$(tool))))
# Loops over blocks of records: gcc's -O2 would not make vector instructions of them.
$(BUILD)/obj/tools/brdfeval/block_%.o: OPTIMIZE := -O3

# How well pictures agree: a small program for the demo and the tests.
$(BUILD)/agreement: scripts/agreement.c $(call archives,image) $(BUILD)/flags
	$(call say,$@)$(CC) $(ALL_CFLAGS) -MMD -MP -o $@ $< $(call archives,image) $(call libs,image) $(LDFLAGS)

# Fuzz targets, under a main that replays their corpus; `make fuzz` puts libFuzzer's in its place.
FUZZ := $(patsubst test/%.c,$(BUILD)/test/%,$(filter-out %/replay.c,$(wildcard test/fuzz/*.c)))
FUZZ_MAIN := $(BUILD)/test/fuzz/replay.o
FUZZ_grid := $(BUILD)/obj/tools/brdfeval/grid.o $(BUILD)/obj/tools/brdfeval/evaluation.o
FUZZ_FLAGS_records := -Wl,--wrap=read,--wrap=poll
FUZZ_BASIS_measurements := fit
FUZZ_BASIS_cal := cal
FUZZ_BASIS_data := rad
FUZZ_BASIS_scene := rad
FUZZ_BASIS_answer := trace
FUZZ_BASIS_parts := rad
FUZZ_FLAGS_scene := -Wl,--wrap=whole_file_read_path,--wrap=rad_command_output,--wrap=access
FUZZ_FLAGS_parts := $(FUZZ_FLAGS_scene)
FUZZ_FLAGS_answer := $(FUZZ_FLAGS_scene)
$(BUILD)/test/fuzz/replay.o: test/fuzz/replay.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(call say,$<)$(CC) $(ALL_CFLAGS) -Itest -MMD -MP -c -o $@ $<
define fuzz_rule
PARTS_fuzz_$(1) := $(filter %.o,$(FUZZ_MAIN)) $(FUZZ_$(1)) $(call archives,$(or $(FUZZ_BASIS_$(1)),base))
$(BUILD)/test/fuzz/$(1): test/fuzz/$(1).c $$(PARTS_fuzz_$(1)) $(BUILD)/flags
	@mkdir -p $$(@D)
	$$(call say,$$@)$$(CC) $$(ALL_CFLAGS) -Itest -MMD -MP -o $$@ $$< $$(PARTS_fuzz_$(1)) $(filter -%,$(FUZZ_MAIN)) \
	    $(FUZZ_FLAGS_$(1)) $(call libs,$(or $(FUZZ_BASIS_$(1)),base)) $$(LDFLAGS)
endef
$(foreach target,$(notdir $(FUZZ)),$(eval $(call fuzz_rule,$(target))))
tests: $(FUZZ)

# The tools under a main that lets each of their allocations fail in turn.
WRAPPED := main malloc calloc realloc aligned_alloc strdup strndup fopen open_memstream arena_allocate arena_copy_text
define no_memory_rule
$(BUILD)/test/no_memory/$(1): test/no_memory/every_allocation.c $$(PARTS_$(1)) $(BUILD)/libtools.a $(call archives,$(or $(BASIS_$(1)),picture))
	@mkdir -p $$(@D)
	$$(call say,$$@)$$(CC) $$(ALL_CFLAGS) -MMD -MP -o $$@ $$< $$(PARTS_$(1)) $(BUILD)/libtools.a $(call archives,$(or $(BASIS_$(1)),picture)) \
	    $(WRAPPED:%=-Wl,--wrap=%) $(call libs,$(or $(BASIS_$(1)),picture)) $$(LDFLAGS)
tests: $(BUILD)/test/no_memory/$(1)
endef
$(foreach tool,$(notdir $(TOOLS)),$(eval $(call no_memory_rule,$(tool))))

# What the reflectance models cost; glibc has libmvec to compare with on this processor.
$(BUILD)/test/bench/brdf: test/bench/brdf.c $(call archives,brdf) $(BUILD)/flags
	@mkdir -p $(@D)
	$(call say,$@)$(CC) $(ALL_CFLAGS) -Itest -MMD -MP -o $@ $< $(call archives,brdf) $(call libs,brdf) \
	    $(if $(filter x86_64-%-gnu,$(shell $(CC) -dumpmachine)),-lmvec) $(LDFLAGS)

# What rays cost in Embree alone and in src/geometry.
$(BUILD)/test/bench/embree: test/bench/embree.c $(call archives,scene) $(BUILD)/flags
	@mkdir -p $(@D)
	$(call say,$@)$(CC) $(ALL_CFLAGS) -Itest -MMD -MP -o $@ $< $(call archives,scene) $(call libs,scene) $(LDFLAGS)

# Function files evaluated over records: for the comparison with Radiance, and for measurements.
$(BUILD)/test/bench/cal_values: test/bench/cal_values.c $(call archives,cal) $(BUILD)/flags
	@mkdir -p $(@D)
	$(call say,$@)$(CC) $(ALL_CFLAGS) -Itest -MMD -MP -o $@ $< $(call archives,cal) $(call libs,cal) $(LDFLAGS)
tests: $(BUILD)/test/bench/cal_values

# The long form of test/brdf/accuracy.c.
$(BUILD)/accuracy: test/accuracy/accuracy.c $(call archives,brdf) $(BUILD)/flags
	$(call say,$@)$(CC) $(ALL_CFLAGS) -Itest -MMD -MP -o $@ $< $(call archives,brdf) $(call libs,brdf) -lmpfr -lgmp $(LDFLAGS)

# The libraries show nothing but what the public headers mark GRAZE_API. In the static one that is done by linking objects into
# one and making the hidden names local; three of them, so that a program that needs only the BRDF or the materials gets no more
# than that, and needs nothing but libm.
OBJECTS := $(SOURCES:src/%.c=$(BUILD)/obj/%.o)
LIBRARY_PARTS := brdf material scene
# Those of material's files that need scenes.
FROM_SCENES      := amounts from_primitive function library modifier modify orientation prism reflection wgmd
OBJECTS_brdf     := $(filter $(BUILD)/obj/brdf/%,$(OBJECTS))
OBJECTS_material := $(filter-out $(FROM_SCENES:%=$(BUILD)/obj/material/%.o),$(filter $(BUILD)/obj/material/%,$(OBJECTS))) $(BUILD)/obj/base/vector.o
OBJECTS_scene    := $(filter-out $(OBJECTS_brdf) $(filter-out %/vector.o,$(OBJECTS_material)),$(OBJECTS))
define part_rule
$(BUILD)/parts/$(1).o: $(OBJECTS_$(1)) $(BUILD)/sources Makefile
	@mkdir -p $$(@D)
	$$(call say,$$@)$$(LD) -r -o $$@ $(OBJECTS_$(1))
	@$$(OBJCOPY) --localize-hidden $$@
endef
$(foreach part,$(LIBRARY_PARTS),$(eval $(call part_rule,$(part))))
$(STATIC): $(LIBRARY_PARTS:%=$(BUILD)/parts/%.o)
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

.PHONY: demo figures test bench fuzz asan accuracy coverage mutation
# demo: render the paper's grazing scene with each strategy; installs what is missing first
demo:
	@scripts/install-dependencies build
	@$(MAKE) $(JOBS) --no-print-directory all $(BUILD)/agreement
	@scripts/demo $(BIN) $(BUILD)/agreement out

# figures: draw the paper's figures into out/figures, and check the claims that go with them
figures:
	@scripts/install-dependencies build figures
	@$(MAKE) $(JOBS) --no-print-directory programs
	@figures/draw $(BIN) out/figures

# figures-page: the same, and bring the manual's page of figures, man/figures/README.md, up to date
.PHONY: figures-page
figures-page: figures
	@figures/page out/figures man/figures

# test: build and run all tests; installs what is missing first. PEER=no leaves out the comparison with real Radiance
test:
	@scripts/install-dependencies build test figures
	@$(if $(filter no,$(PEER)),,scripts/install-peer)
	@$(MAKE) $(JOBS) --no-print-directory all tests
	@BUILD=$(BUILD) BIN=$(BIN) MAKE=$(MAKE) test/run $(TEST_GROUPS)
test: TEST_GROUPS = unit cli $(if $(filter no,$(PEER)),,peer)

# bench: models beside libmvec, records and function files beside rcalc, rays, large scenes and pictures beside rtrace, and what features cost; BENCH=brdf, ... for one of these
BENCH := brdf records cal rays load features pictures
bench:
	@scripts/install-dependencies build test $(if $(filter pictures,$(BENCH)),figures)
	@$(if $(filter-out brdf,$(BENCH)),scripts/install-peer)
	@$(MAKE) $(JOBS) --no-print-directory programs $(BUILD)/test/bench/brdf $(BUILD)/test/bench/embree \
	    $(BUILD)/test/bench/cal_values
	@for part in $(BENCH); do \
	    if [ $$part = brdf ]; then $(BUILD)/test/bench/brdf; \
	    else BIN=$(abspath $(BIN)) BUILD=$(abspath $(BUILD)) GRAZE_PEER=$(abspath build/peer) \
	        GRAZE_BENCH_EMBREE=$(abspath $(BUILD)/test/bench/embree) \
	        build/peer/bin/python test/bench/$$part.py; fi || exit; \
	done

# fuzz: looks for inputs that break the readers, FUZZ_SECONDS (60) each, built in build-fuzz, where finds are left
FUZZ_SECONDS := 60
FUZZER := -fsanitize=address,undefined -fno-sanitize-recover=all
fuzz:
	@scripts/install-dependencies build fuzz
	@$(MAKE) $(JOBS) --no-print-directory BUILD=build-fuzz CC=clang EXTRA_CFLAGS='$(FUZZER) -fsanitize=fuzzer-no-link' \
	    LDFLAGS='$(FUZZER)' FUZZ_MAIN=-fsanitize=fuzzer $(FUZZ:$(BUILD)/%=build-fuzz/%)
	@failed=; for target in $(notdir $(FUZZ)); do \
	    log=build-fuzz/$$target.log; mkdir -p build-fuzz/corpus/$$target; \
	    if build-fuzz/test/fuzz/$$target -max_total_time=$(FUZZ_SECONDS) -max_len=4096 -artifact_prefix=build-fuzz/$$target- \
	        build-fuzz/corpus/$$target test/fuzz/corpus/$$target >$$log 2>&1; \
	    then echo "$$target: $$(tail -n 1 $$log)"; else failed="$$failed $$target"; tail -n 40 $$log; fi; \
	done; [ -z "$$failed" ] || { echo "found something:$$failed" >&2; exit 1; }

# accuracy: the reflectance models against arbitrary precision at 10^7 hard pairs, in minutes; WORST=FILE keeps the worst
accuracy:
	@scripts/install-dependencies build test
	@$(MAKE) $(JOBS) --no-print-directory $(BUILD)/accuracy
	@$(BUILD)/accuracy 1e7 $(WORST)

# coverage: which branches of src/brdf its tests take, which must be all
COVERAGE = $(BUILD)/coverage
coverage:
	@scripts/install-dependencies build test
	@rm -rf $(COVERAGE)
	@$(MAKE) $(JOBS) --no-print-directory BUILD=$(COVERAGE) OPTIMIZE=-O0 EXTRA_CFLAGS=--coverage LDFLAGS=--coverage \
	    $(TESTS_brdf:$(BUILD)/%=$(COVERAGE)/%)
	@BUILD=$(COVERAGE) GRAZE_SHORT=1 test/run test/brdf/*.c
	@scripts/coverage $(COVERAGE)/obj/brdf

# mutation: changes every number in src/brdf, one at a time: a test must notice; in a quarter of an hour
mutation:
	@scripts/install-dependencies build test
	@CC='$(CC)' scripts/mutation $(MUTATE)

# asan: unit and command-line tests under the address and undefined-behaviour sanitizers, built in build-asan
SANITIZE := -fsanitize=address,undefined -fno-sanitize-recover=all
asan:
	@scripts/install-dependencies build test figures
	@$(MAKE) $(JOBS) --no-print-directory BUILD=build-asan BIN=build-asan/bin LIB=build-asan/lib \
	    EXTRA_CFLAGS='$(SANITIZE)' LDFLAGS='$(SANITIZE)' programs tests
	@BUILD=build-asan BIN=build-asan/bin GRAZE_SANITIZED=1 test/run unit cli

C_FILES = $(shell find src include test examples scripts -name '*.[ch]' -o -name '*.cpp' | sort)
.PHONY: format lint
# format: put all C and C++ files into the house's layout
format:
	@scripts/install-dependencies lint
	clang-format -i $(C_FILES)

# lint: layout, clang-tidy, cppcheck; all run, and all must be clean
# (clang-tidy 14 confuses the va_lists of files that it checks in one run.)
lint:
	@scripts/install-dependencies build test lint
	failed=; \
	clang-format --dry-run -Werror $(C_FILES) || failed="$$failed clang-format"; \
	printf '%s\n' $(filter %.c,$(C_FILES)) | xargs -P 2 -I FILE clang-tidy --quiet FILE -- $(ALL_CFLAGS) -Itest || \
	    failed="$$failed clang-tidy"; \
	cppcheck --quiet --std=c11 --language=c --enable=warning,performance,portability --inline-suppr --error-exitcode=1 \
	    --suppress=missingIncludeSystem -DGRAZE_VERSION='"$(VERSION)"' -Iinclude -Isrc $(filter src/%.c,$(C_FILES)) || \
	    failed="$$failed cppcheck"; \
	[ -z "$$failed" ] || { echo "not clean:$$failed"; false; }

# --- Installation ----------------------------------------------------------------------------------------------------

PREFIX  ?= /usr/local
INSTALL ?= install
dest    = $(DESTDIR)$(PREFIX)
# What `uninstall` removes and `install` puts there, both relative to the prefix. The folders named graze are ours alone.
MANUALS   := $(wildcard man/man?/*.[0-9])
# A page of section 3 is found by the name of each of its functions.
LINKS      = $(shell scripts/manual-links $(filter man/man3/%,$(MANUALS)) | cut -d ' ' -f 1)
INSTALLED  = $(TOOLS:$(BIN)/%=bin/%) lib/libgraze.a lib/$(notdir $(SHARED)) lib/$(SONAME) lib/libgraze.so \
             lib/pkgconfig/graze.pc $(MANUALS:%=share/%) $(LINKS:%=share/man/man3/%)

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
	scripts/manual-links $(filter man/man3/%,$(MANUALS)) | while read -r link page; do \
	    echo ".so man3/$$page" >$(dest)/share/man/man3/$$link && chmod 644 $(dest)/share/man/man3/$$link || exit 1; done
	$(INSTALL) -m 644 LICENSE $(dest)/share/doc/graze
	$(INSTALL) -d $(dest)/share/doc/graze/figures
	$(INSTALL) -m 644 man/figures/README.md man/figures/*.png $(dest)/share/doc/graze/figures
	$(INSTALL) -d $(dest)/share/doc/graze/performance
	$(INSTALL) -m 644 man/performance/README.md man/performance/pictures.png $(dest)/share/doc/graze/performance

# uninstall: remove what install put there
uninstall:
	rm -f $(addprefix $(dest)/,$(INSTALLED))
	rm -rf $(dest)/lib/graze $(dest)/include/graze $(dest)/share/doc/graze

.PHONY: clean help
# clean: remove everything that was built or downloaded
clean:
	rm -rf $(BUILD) build-asan build-fuzz $(BIN) $(LIB) out

# help: this list
help:
	@sed -n 's/^# \([a-zA-Z-]*\): /\1\t/p' Makefile | expand -t 14

-include $(shell find $(BUILD) -type f -name '*.d' 2>/dev/null)
