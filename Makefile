# bandlimit: one file builds everything; outputs stand under build/.
#
#   make            the program and the libraries          make check      all tests
#   make reproduce  the figures, into out/                 make bench      the benchmark
#   make install    PREFIX=/usr/local LIBDIR=$PREFIX/lib DESTDIR=
#   make format     clang-format              make docs       the tables of docs/
#   make asan, ubsan, tsan   the quick tests under a sanitizer; sanitize: the first two at once
#   make recipes    adding a thing is one file and one line; make V=1 shows the commands
#   make check T=word    only the tests whose name has the word; SCALE=1 repeats as often as CI does

PREFIX ?= /usr/local
LIBDIR ?= $(PREFIX)/lib
BUILD ?= build
CFLAGS ?= -O3 -g
CXXFLAGS ?= -O2 -g
TEST_CFLAGS ?= -O1 -g
STRIP ?= strip
OBJCOPY ?= objcopy
JOBS ?= $(shell nproc 2>/dev/null || echo 2)
VERSION := $(shell sed -n 's/.*BL_VERSION "\(.*\)".*/\1/p' core/version.h)
SOVERSION := 0

# --- what is built ------------------------------------------------------------------------------

NOISES := $(shell sed -n 's/^BL_NOISE(\(.*\))/\1/p' noises/noises.def)
ISAS := baseline v3 v4
FOLDERS := core filters noises textures sources spectra aliasing score reports api
LIBRARY_C := $(filter-out $(NOISES:%=noises/%.c),$(wildcard $(FOLDERS:%=%/*.c) $(FOLDERS:%=%/*/*.c)))
LIBRARY_OBJECTS := $(LIBRARY_C:%.c=$(BUILD)/%.o) \
    $(foreach isa,$(ISAS),$(NOISES:%=$(BUILD)/noises/%.$(isa).o))
PROGRAM_OBJECTS := $(patsubst %.c,$(BUILD)/%.o,$(wildcard cli/*.c))
TESTS := $(patsubst tests/%.c,%,$(wildcard tests/t-*.c))
TEST_HELPERS := $(patsubst %.c,$(BUILD)/%.o,$(filter-out $(wildcard tests/t-*.c),$(wildcard tests/*.c)))
IMAGE_OBJECTS := $(BUILD)/core/oiio.o $(BUILD)/core/colourspace.o $(BUILD)/core/status.o
OBJECTS := $(LIBRARY_OBJECTS) $(IMAGE_OBJECTS) $(PROGRAM_OBJECTS) $(TESTS:%=$(BUILD)/tests/%.o) $(TEST_HELPERS)

# Expanded when first used, and once: `make deps` may have to install pkg-config first.
once = $(eval $(1) := $(shell $(2)))$($(1))
PACKAGES_USED := fftw3 fftw3f jansson
PACKAGE_FLAGS = $(call once,PACKAGE_FLAGS,pkg-config --cflags $(PACKAGES_USED))
PACKAGE_LIBS = $(call once,PACKAGE_LIBS,pkg-config --libs $(PACKAGES_USED))
OIIO_FLAGS = $(call once,OIIO_FLAGS,pkg-config --cflags OpenImageIO)
OIIO_LIBS = $(call once,OIIO_LIBS,pkg-config --libs OpenImageIO)
TEST_LIBS = $(call once,TEST_LIBS,pkg-config --libs cmocka gsl mpfr)

WARNINGS := -Wall -Wextra -Wshadow -Wpointer-arith -Wundef -Wvla -Wwrite-strings
ifeq ($(CI),true)
WARNINGS += -Werror
endif
C_WARNINGS := $(WARNINGS) -Wstrict-prototypes -Wmissing-prototypes
# The same bits on every instruction set: no contraction to fused operations, no reordering. The
# other two flags change no value; they free the compiler from errno and from floating traps.
NUMBERS := -ffp-contract=off -fno-math-errno -fno-trapping-math
COMMON = -I. -fPIC -fopenmp -MMD -MP $(SANITIZE)
COMPILE_C = $(CC) -std=gnu17 -D_GNU_SOURCE $(C_WARNINGS) $(NUMBERS) $(COMMON) $(PACKAGE_FLAGS) \
    $(CPPFLAGS) $(CFLAGS)
LIBS = $(PACKAGE_LIBS) -lfftw3_omp -lfftw3f_omp -lpthread -ldl -lm

ISA_FLAGS_baseline := -march=x86-64-v2
ISA_FLAGS_v3 := -march=x86-64-v3
# Scheduling for a processor that has the set: a tenth faster rows, the same bits.
ISA_FLAGS_v4 := -march=x86-64-v4 -mtune=icelake-server -mprefer-vector-width=512

# What is being made; the whole command with V=1.
Q := $(if $(V),,@)
say = $(if $(V),,@printf '  %-8s %s\n' $(1) $@)

.PHONY: FORCE all tests check recipes reproduce bench docs install deps format clean
.PHONY: asan ubsan sanitize tsan
.DELETE_ON_ERROR:
all: $(BUILD)/bandlimit $(BUILD)/bandlimit-images.so $(BUILD)/libbandlimit.a \
    $(BUILD)/libbandlimit.so $(BUILD)/bandlimit.pc

$(BUILD)/%.o: %.c
	@mkdir -p $(@D)
	$(call say,compile)
	$(Q)$(COMPILE_C) -c $< -o $@

$(BUILD)/core/oiio.o: core/oiio.cpp
	@mkdir -p $(@D)
	$(call say,compile)
	$(Q)$(CXX) -std=c++17 -fvisibility=hidden $(WARNINGS) $(COMMON) $(OIIO_FLAGS) $(CPPFLAGS) $(CXXFLAGS) -c $< -o $@

# Where it finds bandlimit-images.so when that is not beside it: compiled anew for other folders.
$(BUILD)/folders: FORCE
	@mkdir -p $(@D)
	@echo '$(PREFIX) $(LIBDIR)' | cmp -s - $@ || echo '$(PREFIX) $(LIBDIR)' > $@
$(BUILD)/core/image_library.o: $(BUILD)/folders
$(BUILD)/core/image_library.o: COMMON += -DBL_LIBRARY_FOLDER='"$(LIBDIR)"' \
    -DBL_LIBRARY_FROM_PROGRAM='"../$(LIBDIR:$(PREFIX)/%=%)"'

define noise_rule
$(BUILD)/noises/%.$(1).o: noises/%.c
	@mkdir -p $$(@D)
	$$(call say,compile)
	$$(Q)$$(COMPILE_C) -DBL_ISA=$(1) $$(ISA_FLAGS_$(1)) -c $$< -o $$@
endef
$(foreach isa,$(ISAS),$(eval $(call noise_rule,$(isa))))

# All that needs OpenImageIO, loaded when an image is read or written; core/image_library.h.
$(BUILD)/bandlimit-images.so: $(IMAGE_OBJECTS) core/oiio.map
	$(call say,link)
	$(Q)$(CXX) -shared $(SANITIZE) $(IMAGE_OBJECTS) $(LDFLAGS) -Wl,--version-script=core/oiio.map $(OIIO_LIBS) -o $@

$(BUILD)/libbandlimit.a: $(LIBRARY_OBJECTS)
	$(call say,archive)
	@rm -f $@
	$(Q)$(AR) rcs $@ $^

# The archive that is installed: one object, in which only the public functions have names. The one
# above is for the program and the tests, which know the inside.
$(BUILD)/installed/libbandlimit.a: $(LIBRARY_OBJECTS)
	@mkdir -p $(@D)
	$(call say,archive)
	$(Q)$(CC) -r -nostdlib $^ -o $(@D)/bandlimit.o
	$(Q)$(OBJCOPY) --wildcard --keep-global-symbol='bandlimit_*' --strip-unneeded $(@D)/bandlimit.o
	@rm -f $@
	$(Q)$(AR) rcs $@ $(@D)/bandlimit.o

$(BUILD)/libbandlimit.so.$(SOVERSION): $(LIBRARY_OBJECTS) api/exports.map
	$(call say,link)
	$(Q)$(CC) -shared -Wl,-soname,$(@F) -Wl,--version-script=api/exports.map -fopenmp $(SANITIZE) \
	    $(LIBRARY_OBJECTS) $(LDFLAGS) $(LIBS) -o $@

$(BUILD)/libbandlimit.so: $(BUILD)/libbandlimit.so.$(SOVERSION)
	@ln -sf $(<F) $@

$(BUILD)/bandlimit: $(PROGRAM_OBJECTS) $(BUILD)/libbandlimit.a
	$(call say,link)
	$(Q)$(CC) -fopenmp $(SANITIZE) $^ $(LDFLAGS) $(LIBS) -o $@

# The folders as pkg-config wants them: below the prefix, so that it can be set anew. What only
# --static asks for is written out: to compile against the library, or a plugin, needs nothing else.
PC = sed 's|@PREFIX@|$(PREFIX)|; s|@LIBDIR@|$(LIBDIR:$(PREFIX)/%=$${prefix}/%)|; \
    s|@VERSION@|$(VERSION)|; s|@LIBS@|$(PACKAGE_LIBS)|' bandlimit.pc.in
$(BUILD)/bandlimit.pc: bandlimit.pc.in core/version.h $(BUILD)/folders
	@mkdir -p $(@D)
	@$(PC) > $@

# --- tests --------------------------------------------------------------------------------------

# How often statistical tests repeat, and how much of a walk over all settings is walked. Each test
# computes its limits from its own count, so its stated error rate holds at every scale; a smaller
# one sees less. By hand a tenth; 1 is what CI runs, and what a test program run alone takes.
SCALE ?= 0.1

# Tests are not what is timed: less optimised, they compile in half the time.
$(BUILD)/tests/%.o: CFLAGS := $(TEST_CFLAGS)
$(BUILD)/tests/t-%: $(BUILD)/tests/t-%.o $(TEST_HELPERS) $(BUILD)/libbandlimit.a
	$(call say,link)
	$(Q)$(CC) -fopenmp $(SANITIZE) $^ $(LDFLAGS) $(LIBS) $(TEST_LIBS) -o $@

# With T=word, the programs that have it in their name or in that of a test: nothing else need be
# built or started.
NAMING = $(patsubst tests/%.c,%,$(shell grep -l '^static void .*$(T).*[*][*]' tests/t-*.c))
SELECTED := $(TESTS)
ifneq ($(T),)
SELECTED := $(sort $(foreach test,$(TESTS),$(if $(findstring $(T),$(test)),$(test))) $(NAMING))
endif

# Functions and a program of a user's, some of them bad, for the tests that open them.
USER_SOURCES := $(BUILD)/tests/plugins/functions.so $(BUILD)/tests/plugins/races.so $(BUILD)/tests/plugins/child
$(BUILD)/tests/plugins/%.so: tests/plugins/%.c include/bandlimit_plugin.h
	@mkdir -p $(@D)
	$(call say,link)
	$(Q)$(COMPILE_C) -MF $@.d -shared $< -o $@
$(BUILD)/tests/plugins/%: tests/plugins/%.c
	@mkdir -p $(@D)
	$(call say,link)
	$(Q)$(CC) -std=gnu17 -D_GNU_SOURCE $(C_WARNINGS) -O1 -g $< -o $@
$(addprefix $(BUILD)/tests/,t-plugin t-program t-compare t-cli-score t-race): | $(USER_SOURCES)

$(BUILD)/tests/t-install: | all $(BUILD)/installed/libbandlimit.a

# A log is always made anew; the last line counts what all of them say. REPEAT is the command that
# a failed test is repeated with, but for T.
LOGS := $(SELECTED:%=$(BUILD)/tests/%.log)
AT_SCALE := $(if $(filter-out file,$(origin SCALE)), SCALE=$(SCALE))
REPEAT = make check$(AT_SCALE)
.PHONY: $(LOGS)
$(LOGS): %.log: % $(BUILD)/bandlimit $(BUILD)/bandlimit-images.so
	@BL_PROGRAM=$(BUILD)/bandlimit BL_BUILD=$(BUILD) BL_SANITIZE='$(SANITIZE)' CC='$(CC)' CXX='$(CXX)' \
	    T='$(T)' SCALE='$(SCALE)' REPEAT='$(REPEAT)' \
	    sh tests/run.sh $< $@

tests: $(BUILD)/bandlimit $(BUILD)/bandlimit-images.so $(SELECTED:%=$(BUILD)/tests/%)
	@:

check: deps
	@$(MAKE) --no-print-directory -j$(JOBS) tests
	@$(MAKE) --no-print-directory -j$(JOBS) --output-sync=target $(LOGS)
	@T='$(T)' REPEAT='$(REPEAT)' sh tests/summary.sh $(LOGS)

# That adding a thing is one file and one line.
recipes: deps
	@$(MAKE) --no-print-directory -j$(JOBS) all
	@MAKE='$(MAKE) -j$(JOBS)' sh tests/recipes.sh $(BUILD)

# Sanitized builds stand apart. OpenImageIO 2.4 deletes its texture system by the type of the
# interface, which the address sanitizer takes for a fault.
SANITIZED = ASAN_OPTIONS=new_delete_type_mismatch=0 $(MAKE) --no-print-directory check \
    BUILD=build/$@ CFLAGS='-O1 -g' CXXFLAGS='-O1 -g' REPEAT='make $@$(AT_SCALE)'
ADDRESS := -fsanitize=address -fno-omit-frame-pointer
UNDEFINED := -fsanitize=undefined,float-cast-overflow -fno-sanitize-recover=all
# A noise is one source for all instruction sets. The checks of undefined behaviour take most of its
# compiling, so the set in the middle goes without them.
$(BUILD)/noises/%.v3.o: override SANITIZE := $(filter-out $(UNDEFINED),$(SANITIZE))
asan: deps
	@$(SANITIZED) SANITIZE='$(ADDRESS)'
ubsan: deps
	@$(SANITIZED) SANITIZE='$(UNDEFINED)'
sanitize: deps
	@$(SANITIZED) SANITIZE='$(ADDRESS) $(UNDEFINED)'
# The thread sanitizer understands OpenMP only through clang's runtime and its tool library; the
# libraries that are not instrumented are left out.
tsan:
	@sh deps.sh $(DEBIAN_PACKAGES) clang libomp-dev libclang-rt-14-dev
	@OMP_TOOL_LIBRARIES=$$(ls /usr/lib/llvm-*/lib/libarcher.so | tail -n 1) \
	    TSAN_OPTIONS=ignore_noninstrumented_modules=1 \
	    $(SANITIZED) CC=clang CXX=clang++ SANITIZE=-fsanitize=thread

# --- use ----------------------------------------------------------------------------------------

reproduce: deps
	@$(MAKE) --no-print-directory -j$(JOBS) all
	$(BUILD)/bandlimit reproduce -o out

bench: all
	$(BUILD)/bandlimit bench

# What the program writes of itself; tests hold noises.md and findings.md to it.
docs: all
	sh docs/tables.sh $(BUILD)/bandlimit noises > $(BUILD)/noises.md && mv $(BUILD)/noises.md docs/
	$(BUILD)/bandlimit reproduce --quick -o $(BUILD)/findings; test $$? -le 1
	sh docs/findings.sh $(BUILD)/findings > $(BUILD)/findings.md && mv $(BUILD)/findings.md docs/
	sh docs/tables.sh $(BUILD)/bandlimit speeds > $(BUILD)/speeds.md && mv $(BUILD)/speeds.md docs/

install: all $(BUILD)/installed/libbandlimit.a
	install -d $(DESTDIR)$(PREFIX)/bin $(DESTDIR)$(PREFIX)/include \
	    $(DESTDIR)$(LIBDIR)/bandlimit $(DESTDIR)$(LIBDIR)/pkgconfig \
	    $(DESTDIR)$(PREFIX)/share/man/man1 \
	    $(DESTDIR)$(PREFIX)/share/bash-completion/completions
	install -m 755 $(BUILD)/bandlimit $(DESTDIR)$(PREFIX)/bin/
	install -m 644 $(BUILD)/installed/libbandlimit.a $(DESTDIR)$(LIBDIR)/
	install -m 755 $(BUILD)/libbandlimit.so.$(SOVERSION) $(DESTDIR)$(LIBDIR)/
	install -m 755 $(BUILD)/bandlimit-images.so $(DESTDIR)$(LIBDIR)/bandlimit/
	ln -sf libbandlimit.so.$(SOVERSION) $(DESTDIR)$(LIBDIR)/libbandlimit.so
	$(STRIP) --strip-unneeded $(DESTDIR)$(PREFIX)/bin/bandlimit \
	    $(DESTDIR)$(LIBDIR)/libbandlimit.so.$(SOVERSION) \
	    $(DESTDIR)$(LIBDIR)/bandlimit/bandlimit-images.so
	$(PC) > $(DESTDIR)$(LIBDIR)/pkgconfig/bandlimit.pc
	install -m 644 include/bandlimit.h include/bandlimit_plugin.h $(DESTDIR)$(PREFIX)/include/
	install -m 644 man/bandlimit.1 $(DESTDIR)$(PREFIX)/share/man/man1/
	install -m 644 completion/bandlimit.bash \
	    $(DESTDIR)$(PREFIX)/share/bash-completion/completions/bandlimit

format:
	clang-format -i $$(git ls-files '*.c' '*.h' '*.cpp')

clean:
	rm -rf build

# --- dependencies -------------------------------------------------------------------------------

DEBIAN_PACKAGES := gcc g++ make pkg-config libc6-dev libgomp1 libfftw3-dev libopenimageio-dev \
    openimageio-tools gnuplot-nox libjansson-dev libcmocka-dev libgsl-dev libmpfr-dev
deps:
	@sh deps.sh $(DEBIAN_PACKAGES)

# What a pattern rule makes on the way is kept, or the next run would compile it again.
.SECONDARY: $(OBJECTS)

-include $(OBJECTS:.o=.d)
