# gvi.h is a single header: nothing needs to be built to use it.  This file runs and
# tests it; everything goes to build/.  Start with `make help`.
#
# Flags can be given on the command line:  make test CC=clang CFLAGS=-O3

BUILD    = build
PREFIX   = /usr/local
CFLAGS   = -O2
CXXFLAGS = $(CFLAGS)
LDLIBS   = -lm
Q        = @
export CC CXX

WARNINGS = -Wall -Wextra -Wpedantic -Wconversion -Wdouble-promotion -Wshadow -Wundef -Wfloat-equal -Wvla
FLAGS    = -ffp-contract=off $(WARNINGS) -I. $(CPPFLAGS)
# Tests compare to the bit on purpose.
TESTFLAGS  = -Wno-float-equal -Wno-double-promotion -Wno-unused-parameter -Itests -Iexamples
COMPILE    = $(CC) -std=c99 $(FLAGS) -MMD -MP -MF $@.d -MT $@ $(CFLAGS)
CXXCOMPILE = $(CXX) -std=c++11 $(FLAGS) -MMD -MP -MF $@.d -MT $@ $(CXXFLAGS)
CMOCKA_CFLAGS = $$(pkg-config --cflags cmocka 2>/dev/null)
CMOCKA_LIBS   = $$(pkg-config --libs cmocka 2>/dev/null || echo -lcmocka)

# -- what is tested

TESTS = $(sort $(basename $(notdir $(wildcard tests/test_*.c))))
# These in float and in long double as well, and these compiled for size.
TYPED = $(filter $(addprefix test_,constraints constraints_newton rolling loops resolution regressions effects interpolation jumps lu uncoupled mass newton oracle points quadrature padding tangent adjoint event contact body damped lagrangian tolerance no_trace why),$(TESTS))
SMALL = $(filter $(addprefix test_,constraints loops regressions uncoupled mass newton points padding tolerance no_trace why),$(TESTS))
# Left out: test_constraints in long double, whose code test_constraints_newton and test_loops run in it too; for size in
# float, which changes no loop that size or float alone does not, all but rows and states that must not change.
VARIANTS = $(TYPED:%=%-float) $(filter-out test_constraints-long,$(TYPED:%=%-long)) $(SMALL:%=%-small) \
           $(patsubst %,%-small-float,$(filter test_padding test_no_trace,$(SMALL)))
PROGRAMS = $(TESTS) $(VARIANTS)
# Each links the library, compiled once for each type.
LONG    = $(basename $(notdir $(shell grep -l 'define GVI_REAL long double' tests/test_*.c)))
LIBRARY = $(BUILD)/gvi-$(if $(findstring -float,$*),float,$(if $(findstring -long,$*)$(filter $(LONG),$(*:-small=)),long,double))$(if $(findstring -small,$*),-small).o

C_EXAMPLES   = $(sort $(basename $(notdir $(wildcard examples/*.c))))
CXX_EXAMPLES = $(sort $(basename $(notdir $(wildcard examples/*.cpp))))
EXAMPLES     = $(C_EXAMPLES) $(CXX_EXAMPLES)
VALGRIND     = test_api test_lu test_interpolation 07_driven_damped 36_building_blocks 03_failing_step 11_robot_joint 17_checkpoint

# `make test` is for a person, two minutes; `make check` is the rest, twenty.
TEST_STEPS  = $(TESTS) everyday-drawn textbook $(EXAMPLES) docs-check symbols headers-quick
HARD_SHORT  = hard-eccentric hard-flyby hard-corners hard-pythagorean hard-measure hard-random-short hard-roots-short hard-rest-short hard-rolling-short
CHECK_STEPS = headers everyday textbook-all $(VARIANTS) $(EXAMPLES:%=alone-%) any_processor chapters bound float instructions prices ensemble usable languages boards \
              $(VALGRIND:%=valgrind-%) sanitize hard-long-float hard-corners-float $(HARD_SHORT) theorem-curve firmware fuzz-short fuzz-rolling-short fuzz-contact-short

STEP = $(Q)sh tests/tools/step.sh $(BUILD)
SUM  = $(STEP) --sum

.DEFAULT_GOAL = help
.DELETE_ON_ERROR:
.SECONDARY:
.SUFFIXES:
%: %.o
%: %.c
%: %.sh
%.d: ;
.PHONY: always run deps deps-check test check unit examples scenes advise cost figures synopsis install uninstall \
        clean help help-all cmocka valgrind $(CHECK_STEPS) $(TEST_STEPS) $(PROGRAMS:%=run-%) $(EXAMPLES:%=example-%)

## run          the main job: integrates the outer solar system, draws two pictures
run: $(BUILD)/examples/05_outer_solar_system
	$(Q)$(BUILD)/examples/05_outer_solar_system 200000 200 8 $(BUILD)

## deps         installs what the tests need: cmocka
deps:
	$(Q)sh tests/tools/deps.sh

## test         all tests and examples, two minutes; one of them: make run-test_lu, make example-01_kepler
test: $(TEST_STEPS)
	$(SUM) test $(TEST_STEPS)

## check        what takes longer: all types, compilers, sanitizers, small machines (make deps-check before it)
check: $(CHECK_STEPS)
	$(SUM) check $(CHECK_STEPS)

## examples     every example, its output compared with its opening comment
examples: $(EXAMPLES)
	$(SUM) examples $(EXAMPLES)

## install      copies gvi.h, the whole library, to $(DESTDIR)$(PREFIX)/include, its tools to include/gvi; gvi.pc, CMake's gvi-config, the licence
TOOLS     = $(notdir $(wildcard examples/tools/*.h))
VERSION   = $(shell sed -n 's/^.define GVI_VERSION "\(.*\)"/\1/p' gvi.h)
CMAKE_DIR = $(DESTDIR)$(PREFIX)/lib/cmake/gvi
INSTALLED = '$(DESTDIR)$(PREFIX)/include/gvi.h' '$(DESTDIR)$(PREFIX)/share/pkgconfig/gvi.pc' \
            '$(CMAKE_DIR)/gvi-config.cmake' '$(CMAKE_DIR)/gvi-config-version.cmake' '$(DESTDIR)$(PREFIX)/share/doc/gvi/LICENSE' \
            $(TOOLS:%='$(DESTDIR)$(PREFIX)/include/gvi/%')
install:
	mkdir -p '$(DESTDIR)$(PREFIX)/include/gvi' '$(DESTDIR)$(PREFIX)/share/pkgconfig' '$(CMAKE_DIR)' \
	    '$(DESTDIR)$(PREFIX)/share/doc/gvi'
	cp gvi.h '$(DESTDIR)$(PREFIX)/include/gvi.h'
	cp $(TOOLS:%=examples/tools/%) '$(DESTDIR)$(PREFIX)/include/gvi'
	printf '%s\n' 'prefix=$(PREFIX)' '' 'Name: gvi' 'Version: $(VERSION)' \
	    'Description: Galerkin variational integrators for mechanical systems' 'Cflags: -I$${prefix}/include' 'Libs: -lm' \
	    >'$(DESTDIR)$(PREFIX)/share/pkgconfig/gvi.pc'
	printf '%s\n' 'get_filename_component(gvi_prefix "$${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)' 'if(NOT TARGET gvi::gvi)' \
	    '  add_library(gvi::gvi INTERFACE IMPORTED)' '  set_target_properties(gvi::gvi PROPERTIES' \
	    '    INTERFACE_INCLUDE_DIRECTORIES "$${gvi_prefix}/include"' \
	    '    INTERFACE_LINK_LIBRARIES "$$<$$<NOT:$$<BOOL:$${MSVC}>>:m>")' 'endif()' >'$(CMAKE_DIR)/gvi-config.cmake'
	printf '%s\n' 'set(PACKAGE_VERSION $(VERSION))' \
	    '# before 1.0 a new minor version may break what the last one had' \
	    'if(PACKAGE_FIND_VERSION STREQUAL PACKAGE_VERSION)' '  set(PACKAGE_VERSION_EXACT TRUE)' 'endif()' \
	    'if(NOT PACKAGE_FIND_VERSION VERSION_GREATER PACKAGE_VERSION AND NOT PACKAGE_FIND_VERSION VERSION_LESS $(basename $(VERSION)))' \
	    '  set(PACKAGE_VERSION_COMPATIBLE TRUE)' 'endif()' >'$(CMAKE_DIR)/gvi-config-version.cmake'
	sed '1,/^\/\*.* LICENCE$$/d' gvi.h | sed '1d; s/^   //; s/ *\*\/$$//' >'$(DESTDIR)$(PREFIX)/share/doc/gvi/LICENSE'
	chmod 644 $(INSTALLED)

## clean        removes build/
clean:
	rm -rf $(BUILD)

## help         this list, by the files in which the targets are; make help-all: everything there is
MAKE_PARTS = Makefile tests/studies.mk tests/playground.mk
help:
	$(Q)awk 'sub(/^## /, "  make ") { if (FILENAME != file) print FILENAME; file = FILENAME; print }' $(MAKE_PARTS)

help-all:
	$(Q)awk 'sub(/^#:  +/, "                    ") || sub(/^#[#:] /, "  make ") { \
	    if (FILENAME != file) print FILENAME; file = FILENAME; print }' $(MAKE_PARTS)

#: uninstall    removes what install put there
uninstall:
	rm -f $(INSTALLED)
#: deps-check   installs what check uses if it can be had: clang, g++, valgrind, cmake, pkg-config, mingw, numpy
deps-check: deps
	$(Q)sh tests/tools/deps.sh --check

#: unit         the test programs alone, in all types
unit: $(PROGRAMS)
	$(SUM) unit $(PROGRAMS)

# where pictures are drawn; those of the documents only if asked
PICTURES = $(if $(filter figures,$(MAKECMDGOALS)),docs/img,$(BUILD)/pictures)

#: figures      makes the pictures in docs/img/ again, scenes included; theorems: make theorems PICTURES=docs/img
figures: scenes $(addprefix $(BUILD)/examples/,05_outer_solar_system 18_close_encounters 34_low_thrust 35_swing_up 19_section 28_racket 32_ensemble 21_rods 23_engine 49_lift_off 51_rocking_block)
	$(Q)mkdir -p docs/img
	$(Q)$(BUILD)/examples/05_outer_solar_system 200000 200 8 docs/img
	$(Q)set -e; for e in 34_low_thrust 35_swing_up 19_section 28_racket 21_rods 23_engine 49_lift_off 51_rocking_block; do \
	    $(BUILD)/examples/$$e --svg docs/img/$${e#*_}.svg; done
	$(Q)$(BUILD)/examples/18_close_encounters --svg docs/img/three_ways.svg
	$(Q)$(BUILD)/examples/32_ensemble 120 $(BUILD)/ensemble.csv docs/img/ensemble.svg

#: synopsis     copies the program at the top of gvi.h to examples/01_kepler.c and README.md
synopsis:
	$(Q)sh tests/tools/examples.sh synopsis

# -- programs: what is compiled in "make deps test" waits for deps

FIRST = $(filter deps deps-check deps-firmware deps-ensemble,$(MAKECMDGOALS))

cmocka: | $(FIRST)
	$(Q)sh tests/tools/deps.sh --cmocka

# Nothing is linked with an object that other flags have made.
$(BUILD)/flags: always
	@mkdir -p $(@D)
	@echo '$(subst ','"'"',$(CC) $(FLAGS) $(CFLAGS))' | cmp -s - $@ || echo '$(subst ','"'"',$(CC) $(FLAGS) $(CFLAGS))' >$@

$(BUILD)/gvi-%.o: tests/compile/implementation.c $(BUILD)/flags | $(FIRST)
	@echo '  cc $@'
	$(Q)$(COMPILE) $(if $(findstring small,$*),-Os) $(if $(findstring plain,$*),-O0) \
	    '-DGVI_REAL=$(if $(findstring long,$*),long double,$(firstword $(subst -, ,$*)))' -c $< -o $@

# What calls the library costs more to compile than to run: not optimised as the library is.
$(PROGRAMS:%=$(BUILD)/tests/%) $(EXAMPLES:%=$(BUILD)/examples/%): private CFLAGS = -O1
$(patsubst %,$(BUILD)/tests/test_%,api baselines control effects prices tangent) \
$(patsubst %,$(BUILD)/examples/%,14_check_derivatives 15_own_scene 25_bricard): private CFLAGS = -O0

.SECONDEXPANSION:
$(PROGRAMS:%=$(BUILD)/tests/%): $(BUILD)/tests/%: $$(firstword $$(subst -, ,tests/$$*)).c $$(LIBRARY) | cmocka
	@mkdir -p $(@D)
	$(Q)$(COMPILE) $(if $(findstring -small,$*),-Os) \
	    $(if $(findstring -float,$*),-DGVI_REAL=float) $(if $(findstring -long,$*),'-DGVI_REAL=long double') \
	    -DGVI_IMPLEMENTED $(TESTFLAGS) $(CMOCKA_CFLAGS) $< $(LIBRARY) -o $@ $(CMOCKA_LIBS) $(LDLIBS)

# Examples link the library too; alone, as a user compiles them, in alone-*.  `make test` runs little in float: for that
# a library by -O0, which compiles in a third of the time.
FLOAT_LIBRARY  = $(BUILD)/gvi-float-plain.o
FLOAT_EXAMPLES = $(basename $(notdir $(shell grep -l 'define GVI_REAL float' examples/*.c)))
$(BUILD)/examples/%: examples/%.c $$(if $$(filter $$(FLOAT_EXAMPLES),$$*),$(FLOAT_LIBRARY),$(BUILD)/gvi-double.o)
	@mkdir -p $(@D)
	$(Q)$(COMPILE) -Iexamples -DGVI_IMPLEMENTED $< $(filter %.o,$^) -o $@ $(LDLIBS)

# Not optimised: the library is, elsewhere, and the numbers must be the same.
$(C_EXAMPLES:%=$(BUILD)/alone/%): CFLAGS = -O0
$(BUILD)/alone/%: examples/%.c | $(FIRST)
	@mkdir -p $(@D)
	$(Q)$(COMPILE) -Iexamples $< -o $@ $(LDLIBS)
# Without a C++ compiler the example is left out, visibly, when it is to run.
$(BUILD)/examples/%: examples/%.cpp $(BUILD)/gvi-double.o
	@mkdir -p $(@D)
	$(Q)if command -v $(CXX) >/dev/null 2>&1; then $(CXXCOMPILE) -DGVI_IMPLEMENTED $< $(filter %.o,$^) -o $@ $(LDLIBS); fi
$(BUILD)/alone/%: examples/%.cpp | $(FIRST)
	@mkdir -p $(@D)
	$(Q)if command -v $(CXX) >/dev/null 2>&1; then $(CXXCOMPILE) $< -o $@ $(LDLIBS); fi

$(PROGRAMS): %: $(BUILD)/tests/%
	$(STEP) $* $<

$(PROGRAMS:%=run-%): run-%: $(BUILD)/tests/%
	$(Q)$<

$(EXAMPLES): %: $(BUILD)/examples/%
	$(STEP) $* sh tests/tools/examples.sh run $(BUILD) $* $<

$(EXAMPLES:%=alone-%): alone-%: $(BUILD)/alone/%
	$(STEP) alone-$* sh tests/tools/examples.sh run $(BUILD) $* $<

$(EXAMPLES:%=example-%): example-%: $(BUILD)/examples/%
	$(Q)$<

include tests/studies.mk

# These use all processors by themselves, and say how far they are.
RUN := $(or $(filter test check unit examples valgrind sanitize,$(MAKECMDGOALS)),none)
ifeq ($(MAKELEVEL)$(RUN),0$(filter-out none,$(RUN)))
JOBS := $(shell getconf _NPROCESSORS_ONLN 2>/dev/null || echo 2)
MAKEFLAGS := $(MAKEFLAGS) -k $(if $(findstring -j,$(MAKEFLAGS)),,-j$(JOBS))
export STEPS := $(words $(if $(filter test,$(RUN)),$(TEST_STEPS)) $(if $(filter check,$(RUN)),$(filter-out sanitize,$(CHECK_STEPS)) $(SANITIZED)) \
    $(if $(filter unit,$(RUN)),$(PROGRAMS)) $(if $(filter examples,$(RUN)),$(EXAMPLES)) \
    $(if $(filter valgrind,$(RUN)),$(VALGRIND)) $(if $(filter sanitize,$(RUN)),$(SANITIZED)))
export PROGRESS := $(shell mkdir -p $(BUILD) && : >$(BUILD)/progress && echo $(BUILD)/progress)
endif

-include $(wildcard $(BUILD)/*.d $(BUILD)/tests/*.d $(BUILD)/examples/*.d $(BUILD)/alone/*.d $(BUILD)/studies/*.d $(BUILD)/cost/*.d $(BUILD)/everyday/*.d)

-include tests/playground.mk
