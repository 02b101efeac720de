# gvi.h is a single header: nothing needs to be built to use it.  This file
# runs, tests and checks it.  Everything goes to build/.
#
#   make run             the outer solar system, with pictures
#   make deps test       what a fresh machine needs, then all tests
#   make help            the other targets
#
# Flags can be given on the command line:  make test CC=clang CFLAGS=-O3

BUILD   = build
PREFIX  = /usr/local
CFLAGS  = -O2
CXXFLAGS = $(CFLAGS)
LDLIBS  = -lm
Q       = @

WARNINGS = -Wall -Wextra -Wpedantic -Wconversion -Wdouble-promotion -Wshadow \
           -Wundef -Wfloat-equal -Wvla
FLAGS    = -ffp-contract=off $(WARNINGS) -I. $(CPPFLAGS)
# Tests compare to the bit on purpose.
TESTFLAGS = -Wno-float-equal -Wno-double-promotion -Itests -Iexamples
COMPILE  = $(CC) -std=c99 $(FLAGS) -MMD -MP -MF $@.d -MT $@ $(CFLAGS)
CXXCOMPILE = $(CXX) -std=c++11 $(FLAGS) -MMD -MP -MF $@.d -MT $@ $(CXXFLAGS)
CMOCKA_CFLAGS = $$(pkg-config --cflags cmocka 2>/dev/null)
CMOCKA_LIBS   = $$(pkg-config --libs cmocka 2>/dev/null || echo -lcmocka)

# The tests; these run in float and long double as well.
TESTS    = $(sort $(basename $(notdir $(wildcard tests/test_*.c))))
TYPED    = $(filter test_many test_oracle test_quadrature test_interpolation test_lu test_corners test_effects test_newton test_weak test_stiffness test_guess test_mass test_rows test_tolerance test_kinks test_usual,$(TESTS))
# These as small code, too: -Os takes other loops and leaves parts out.
SMALL    = $(filter test_many test_mass test_rows test_tolerance,$(TESTS))
# Tests that look inside hold the library themselves; the others share one object for each type.
INSIDE   = $(basename $(notdir $(shell grep -l 'gvi__\|\.x\.' tests/test_*.c)))
SHARING  = $(filter-out $(INSIDE),$(TESTS))
LONG     = $(basename $(notdir $(shell grep -l 'define GVI_REAL long double' tests/test_*.c)))
PROGRAMS = $(TESTS) $(TYPED:%=%-float) $(TYPED:%=%-long) $(SMALL:%=%-small)
# Small enough to be repeated under valgrind.
VALGRIND_TESTS = $(filter test_api test_lu test_interpolation,$(TESTS))
VALGRIND_EXAMPLES = 04_driven_damped 06_building_blocks 07_failing_step 08_robot_joint 10_checkpoint

C_EXAMPLES   = $(sort $(filter-out advise,$(basename $(notdir $(wildcard examples/*.c)))))
CXX_EXAMPLES = $(sort $(basename $(notdir $(wildcard examples/*.cpp))))
EXAMPLES     = $(C_EXAMPLES) $(CXX_EXAMPLES) $(if $(LINK_EXAMPLES),,any_processor)
SCENES       = $(filter-out scene scenes price,$(basename $(notdir $(wildcard examples/scenes/*.c))))

# The theorems of docs/theorems.md; QUADRUPLE needs more digits than long double has on x86.
THEOREMS  = order lagrangian curve forced doubled spectral identities inertia stability
QUADRUPLE = order lagrangian forced

# The long studies of docs/hard-cases.md.
HARD         = eccentric eccentric-float pythagorean corners stiff long brouwer brouwer-float drift single
FUZZ_SECONDS = 60
SEED         =

# What accuracy costs: optimised as a user in a hurry would.
COST_CFLAGS  = -O3 -march=native -ffp-contract=fast -fno-math-errno -fno-trapping-math
COST_ARGS    =
COST_OBJECTS = $(patsubst %,$(BUILD)/cost/%.o,problems baselines gvi_run cost)
PEER_LIBS    = -lgsl -lgslcblas -lsundials_cvode -lsundials_arkode -lsundials_nvecserial \
               -lsundials_sunnonlinsolfixedpoint
RECORD       =
DETAIL       =

.DEFAULT_GOAL = help
.DELETE_ON_ERROR:
.PHONY: always run deps test unit examples headers symbols parts docs-check sanitize valgrind \
        figures synopsis install uninstall help clean cmocka \
        firmware size deps-firmware cost-embedded bound everywhere deps-everywhere own-quadrature float \
        cost cost-horizon ncdp scaling newton kicks cost-peers deps-compare instructions prices advise hard fuzz $(HARD:%=hard-%) scenes $(SCENES:%=scene-%) theorems $(THEOREMS:%=theorem-%) \
        $(PROGRAMS:%=run-%) $(EXAMPLES:%=example-%) $(VALGRIND_TESTS:%=valgrind-%) \
        $(VALGRIND_EXAMPLES:%=valgrind-%)

## run          the main job: integrates the outer solar system, draws two pictures
run: $(BUILD)/examples/02_outer_solar_system
	$(Q)$(BUILD)/examples/02_outer_solar_system 200000 200 8 $(BUILD)

## deps         installs what the tests need: cmocka; valgrind, clang, g++ where they can be had
deps:
	$(Q)CC='$(CC)' sh tests/tools/deps.sh

## test         all tests, then examples, docs-check, headers, symbols, parts, bound, float, instructions and prices
test: unit examples docs-check headers symbols parts bound float instructions prices
	$(Q)sh tests/tools/summary.sh $(BUILD) test unit examples docs-check headers symbols parts bound float instructions prices

## unit         the test programs alone; one of them: make run-test_lu
unit: $(PROGRAMS:%=run-%)
	$(Q)sh tests/tools/summary.sh $(BUILD) unit $(PROGRAMS)

## examples     every example, its output compared with its opening comment
examples: $(EXAMPLES:%=example-%)
	$(Q)sh tests/tools/summary.sh $(BUILD) examples $(EXAMPLES)

## headers      gvi.h through every compiler, standard, type and linkage there is, no warning
headers:
	$(Q)sh tests/tools/headers.sh $(BUILD)

## symbols      exports only gvi_, imports only libm, no data, no recursion
symbols:
	$(Q)CC='$(CC)' sh tests/tools/symbols.sh $(BUILD)

## parts        every macro that leaves code out: refusals, the same bits, less code
parts:
	$(Q)CC='$(CC)' sh tests/tools/parts.sh $(BUILD)

## docs-check   the code in README, guide and header is compiled and its output compared
docs-check:
	$(Q)CC='$(CC)' sh tests/tools/docs.sh $(BUILD)

## sanitize     tests (not those in long double) and examples under the address and undefined behaviour sanitizers, then valgrind
sanitize:
	$(Q)if sh tests/tools/sanitizer.sh '$(CC)' && sh tests/tools/sanitizer.sh '$(CXX)' -xc++; then \
	    $(MAKE) BUILD=$(BUILD)/sanitize LINK_EXAMPLES=1 PROGRAMS='$(TESTS) $(TYPED:%=%-float)' unit examples \
	    CFLAGS='-O1 -g -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=all'; fi
	$(Q)$(MAKE) valgrind

## valgrind     the smaller tests and examples under valgrind, where it is installed
valgrind: $(VALGRIND_TESTS:%=valgrind-%) $(VALGRIND_EXAMPLES:%=valgrind-%)
	$(Q)sh tests/tools/summary.sh $(BUILD) valgrind $(VALGRIND_TESTS:%=valgrind-%) $(VALGRIND_EXAMPLES:%=valgrind-%)

## synopsis     copies the program at the top of gvi.h to examples/01_kepler.c and README.md
synopsis:
	$(Q)sh tests/tools/synopsis.sh

## figures      makes the pictures in docs/img/ again
figures: $(BUILD)/examples/02_outer_solar_system
	$(Q)mkdir -p docs/img
	$(Q)$(BUILD)/examples/02_outer_solar_system 200000 200 8 docs/img

## scenes       runs every scene and draws it in docs/img/scenes/; one: make scene-net
scenes: $(SCENES:%=scene-%)

## cost         gvi.h and its rivals: time to an error on eight problems; tables, CSV and pictures in build/cost
##              SCENE=net: what each effect of a scene costs
ifdef SCENE
cost: $(BUILD)/examples/price
	$(Q)$< $(SCENE)
else
cost: $(BUILD)/cost/cost
	$(Q)$< --out $(BUILD)/cost $(COST_ARGS) | tee $(BUILD)/cost/table.txt
endif

## advise       builds build/examples/advise: degree, step and tolerance for a wanted error
advise: $(BUILD)/examples/advise

## cost-horizon the outer solar system at 1, 10 and 100 times its length
cost-horizon: $(BUILD)/cost/cost
	$(Q)$< --horizon --out $(BUILD)/cost

## ncdp         rounding over half a million steps, and its price, against the published standard
ncdp: $(BUILD)/cost/ncdp
	$(Q)$< $(COST_ARGS)

## newton       a step by Newton's method: one matrix against blocks, docs/design.md
newton: $(BUILD)/cost/newton
	$(Q)$<

## kicks        splittings as tables of kicks against the same written by hand, docs/cost.md (ten seconds)
kicks: $(BUILD)/cost/kicks
	$(Q)$<

## scaling      time and memory against degree, coordinates and points; CSV and pictures in build/cost
scaling: $(BUILD)/cost/scaling
	$(Q)$< --out $(BUILD)/cost $(COST_ARGS)

## deps-compare installs what cost-peers needs: GSL, SUNDIALS, Boost
deps-compare:
	$(Q)sh tests/tools/deps.sh --compare

## cost-peers   GSL, SUNDIALS and Boost.odeint on the problems of make cost
cost-peers: $(BUILD)/cost/peers
	$(Q)$< --out $(BUILD)/cost $(COST_ARGS)

## deps-firmware installs what firmware and size need: compilers for Arm, RISC-V and AVR, qemu
deps-firmware:
	$(Q)sh tests/tools/deps.sh --firmware

## firmware     two programs without an operating system, run as Cortex-M3 and M4F by qemu, against this machine
firmware:
	$(Q)CC='$(CC)' sh tests/tools/firmware.sh $(BUILD)

## size         code, stack and RAM on Cortex-M0, Cortex-M4F, RISC-V 32 and AVR; DETAIL=--detail: by function
size:
	$(Q)CC='$(CC)' sh tests/tools/size.sh $(BUILD) $(DETAIL)

## cost-embedded instructions of a step on Cortex-M4F and Cortex-M3 and what they buy (qemu-system-arm; 4 minutes)
cost-embedded:
	$(Q)mkdir -p $(BUILD)/embedded
	$(Q)CC='$(CC)' CXX='$(CXX)' sh tests/tools/embedded_cost.sh $(BUILD)

## bound        operations of a step, counted one by one, against the bound that gvi.h states (C++)
bound:
	$(Q)CXX='$(CXX)' sh tests/tools/bound.sh $(BUILD)

## everywhere   every machine that can be compiled for and imitated here: warnings, tests, bits (half an hour)
##              RECORD=--record puts its tables into docs/embedded.md; ONLY="armhf tcc": these alone
everywhere:
	$(Q)CC='$(CC)' ONLY='$(ONLY)' sh tests/tools/everywhere.sh $(BUILD) $(RECORD)

## deps-everywhere installs compilers, C libraries and emulators for everywhere (Debian 12)
deps-everywhere:
	$(Q)sh tests/tools/everywhere.sh --deps

## own-quadrature weak effects with fewer points, or marked as weak: the study behind docs/design.md (a minute)
own-quadrature: $(BUILD)/cost/own_quadrature
	$(Q)$<

## float        the object code of a float build: nothing is computed in double
float:
	$(Q)CC='$(CC)' sh tests/tools/float.sh $(BUILD)

## instructions points, iterations and instructions of seven fixed runs; RECORD=--record writes them anew
instructions:
	$(Q)CC='$(CC)' sh tests/tools/instructions.sh $(BUILD) $(RECORD)

## prices       what an unlisted effect costs in instructions (valgrind): nothing
prices:
	$(Q)CC='$(CC)' sh tests/tools/prices.sh $(BUILD)

## hard         hard cases at length, docs/hard-cases.md (seven minutes); one: make hard-drift; brouwer and drift with other random numbers: SEED=11
hard: $(HARD:%=hard-%)

## fuzz         a minute of libFuzzer on descriptions and calls (clang)
fuzz: $(BUILD)/fuzz/fuzz_scene
	$(Q)mkdir -p $(BUILD)/fuzz/corpus
	$(Q)$< -max_total_time=$(FUZZ_SECONDS) -max_len=800 -timeout=10 -artifact_prefix=$(BUILD)/fuzz/ $(BUILD)/fuzz/corpus

## theorems     docs/theorems.md measured again, with its pictures (a few minutes); one: make theorem-curve
theorems: $(THEOREMS:%=theorem-%)

## install      copies gvi.h, the whole library, to $(DESTDIR)$(PREFIX)/include
install:
	mkdir -p '$(DESTDIR)$(PREFIX)/include'
	cp gvi.h '$(DESTDIR)$(PREFIX)/include/gvi.h'
	chmod 644 '$(DESTDIR)$(PREFIX)/include/gvi.h'

## uninstall    removes it from there
uninstall:
	rm -f '$(DESTDIR)$(PREFIX)/include/gvi.h'

## clean        removes build/
clean:
	rm -rf $(BUILD)

## help         this list
help:
	$(Q)sed -n 's/^##   */                    /p; t; s/^## /  make /p' Makefile

# -- programs

cmocka:
	$(Q)CC='$(CC)' sh tests/tools/deps.sh --check

# A test is never linked with an object that other flags have made.
$(BUILD)/tests/flags: always
	@mkdir -p $(@D)
	@echo '$(subst ','"'"',$(CC) $(FLAGS) $(CFLAGS))' | cmp -s - $@ || \
	    echo '$(subst ','"'"',$(CC) $(FLAGS) $(CFLAGS))' >$@

$(BUILD)/tests/gvi-%.o: tests/compile/implementation.c $(BUILD)/tests/flags
	@mkdir -p $(@D)
	@echo '  cc $@'
	$(Q)$(COMPILE) '-DGVI_REAL=$(if $(filter long,$*),long double,$*)' -c $< -o $@

$(addprefix $(BUILD)/tests/,$(filter-out $(LONG),$(SHARING))): $(BUILD)/tests/gvi-double.o
$(addprefix $(BUILD)/tests/,$(filter $(LONG),$(SHARING))): $(BUILD)/tests/gvi-long.o
$(patsubst %,$(BUILD)/tests/%-float,$(filter $(TYPED),$(SHARING))): $(BUILD)/tests/gvi-float.o
$(patsubst %,$(BUILD)/tests/%-long,$(filter $(TYPED),$(SHARING))): $(BUILD)/tests/gvi-long.o
LINKED = $(if $(filter %.o,$^),-DGVI_IMPLEMENTED) $< $(filter %.o,$^)

$(BUILD)/tests/%: tests/%.c $(BUILD)/tests/flags | cmocka
	@mkdir -p $(@D)
	@echo '  cc $@'
	$(Q)$(COMPILE) $(TESTFLAGS) $(CMOCKA_CFLAGS) $(LINKED) -o $@ $(CMOCKA_LIBS) $(LDLIBS)

$(BUILD)/tests/%-float: tests/%.c $(BUILD)/tests/flags | cmocka
	@mkdir -p $(@D)
	@echo '  cc $@'
	$(Q)$(COMPILE) -DGVI_REAL=float $(TESTFLAGS) $(CMOCKA_CFLAGS) $(LINKED) -o $@ $(CMOCKA_LIBS) $(LDLIBS)

$(BUILD)/tests/%-long: tests/%.c $(BUILD)/tests/flags | cmocka
	@mkdir -p $(@D)
	@echo '  cc $@'
	$(Q)$(COMPILE) '-DGVI_REAL=long double' $(TESTFLAGS) $(CMOCKA_CFLAGS) $(LINKED) -o $@ $(CMOCKA_LIBS) $(LDLIBS)

$(BUILD)/tests/%-small: tests/%.c $(BUILD)/tests/flags | cmocka
	@mkdir -p $(@D)
	@echo '  cc $@'
	$(Q)$(COMPILE) -Os $(TESTFLAGS) $(CMOCKA_CFLAGS) $< -o $@ $(CMOCKA_LIBS) $(LDLIBS)

# Under sanitizers gvi.h takes half a minute: compiled once, too.
ifdef LINK_EXAMPLES
FLOAT_EXAMPLES = $(basename $(notdir $(shell grep -l 'define GVI_REAL float' examples/*.c)))
$(addprefix $(BUILD)/examples/,$(filter-out $(FLOAT_EXAMPLES),$(EXAMPLES))): $(BUILD)/tests/gvi-double.o
$(addprefix $(BUILD)/examples/,$(FLOAT_EXAMPLES)): $(BUILD)/tests/gvi-float.o
endif

$(BUILD)/examples/%: examples/%.c
	@mkdir -p $(@D)
	@echo '  cc $@'
	$(Q)$(COMPILE) -Iexamples $(LINKED) -o $@ $(LDLIBS)

# Without a C++ compiler the example is left out, visibly, when it is to run.
$(BUILD)/examples/%: examples/%.cpp
	@mkdir -p $(@D)
	$(Q)if command -v $(CXX) >/dev/null 2>&1; then \
	    echo '  c++ $@'; $(CXXCOMPILE) $(LINKED) -o $@ $(LDLIBS); fi

# One file, a form of it for each width of registers; other processors have the plain one alone.
FORMS = plain $(if $(filter x86_64%,$(shell $(CC) -dumpmachine 2>/dev/null)),avx2 avx512)
FORM_avx2   = -mavx2 -mfma
FORM_avx512 = -mavx512f -mavx512dq -mavx512vl -mavx512bw -mfma

$(BUILD)/examples/motion-%.o: examples/any_processor/motion.c
	@mkdir -p $(@D)
	@echo '  cc $@'
	$(Q)$(COMPILE) $(FORM_$*) -DMOTION=motion_$* -c $< -o $@

$(BUILD)/examples/any_processor: examples/any_processor/main.c $(FORMS:%=$(BUILD)/examples/motion-%.o)
	@echo '  cc $@'
	$(Q)$(COMPILE) $< $(filter %.o,$^) -o $@ $(LDLIBS)

$(BUILD)/examples/price: examples/scenes/price.c
	@mkdir -p $(@D)
	@echo '  cc $@'
	$(Q)$(COMPILE) -Iexamples $< -o $@ $(LDLIBS)

$(BUILD)/examples/advise: examples/advise.c $(BUILD)/cost/problems.o $(BUILD)/cost/baselines.o
	@mkdir -p $(@D)
	@echo '  cc $@'
	$(Q)$(COMPILE) -Iexamples $^ -o $@ $(LDLIBS)

$(BUILD)/examples/scene: examples/scenes/scene.c
	@mkdir -p $(@D)
	@echo '  cc $@'
	$(Q)$(COMPILE) -Iexamples $< -o $@ $(LDLIBS)

$(SCENES:%=scene-%): scene-%: $(BUILD)/examples/scene
	$(Q)mkdir -p docs/img/scenes
	$(Q)$< $* --svg docs/img/scenes/$*.svg

$(BUILD)/hard/%: tests/hard/%.c
	@mkdir -p $(@D)
	@echo '  cc $@'
	$(Q)$(COMPILE) $(TESTFLAGS) $< -o $@ $(LDLIBS)

$(BUILD)/hard/%-float: tests/hard/%.c
	@mkdir -p $(@D)
	@echo '  cc $@'
	$(Q)$(COMPILE) -DGVI_REAL=float $(TESTFLAGS) $< -o $@ $(LDLIBS)

$(HARD:%=hard-%): hard-%: $(BUILD)/hard/%
	$(Q)$< $(if $(filter stiff,$*),docs/img) $(if $(filter brouwer% drift,$*),$(SEED))

$(BUILD)/fuzz/fuzz_scene: tests/fuzz/fuzz_scene.c gvi.h
	@mkdir -p $(@D)
	@echo '  clang $@'
	$(Q)clang -std=c99 -g -O1 -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all $(WARNINGS) \
	    -Wno-float-equal -Wno-double-promotion -I. $< -o $@ $(LDLIBS)

$(BUILD)/theorems/%: tests/theorems/%.c
	@mkdir -p $(@D)
	@echo '  cc $@'
	$(Q)$(COMPILE) $(TESTFLAGS) $< -o $@ $(LDLIBS)

$(QUADRUPLE:%=$(BUILD)/theorems/%): TESTFLAGS += $(shell CC='$(CC)' sh tests/theorems/quad.sh)

$(THEOREMS:%=theorem-%): theorem-%: $(BUILD)/theorems/%
	$(Q)mkdir -p docs/img
	$(Q)$< docs/img

$(BUILD)/cost/%.o: tests/cost/%.c
	@mkdir -p $(@D)
	@echo '  cc $@'
	$(Q)$(CC) -std=c99 $(WARNINGS) -Wno-double-promotion -I. $(CPPFLAGS) -MMD -MP -MF $@.d -MT $@ $(COST_CFLAGS) -c $< -o $@

$(BUILD)/cost/ncdp $(BUILD)/cost/scaling $(BUILD)/cost/own_quadrature $(BUILD)/cost/newton: %: %.o
	@echo '  ld $@'
	$(Q)$(CC) $< -o $@ $(LDLIBS)

$(BUILD)/cost/peers_odeint.o: tests/cost/peers_odeint.cpp
	@mkdir -p $(@D)
	@echo '  c++ $@'
	$(Q)$(CXX) -std=c++14 $(COST_CFLAGS) -I. -c $< -o $@

$(BUILD)/cost/peers: $(BUILD)/cost/peers.o $(BUILD)/cost/problems.o $(BUILD)/cost/peers_odeint.o
	@echo '  ld $@'
	$(Q)$(CXX) $^ -o $@ $(PEER_LIBS) $(LDLIBS)

$(BUILD)/cost/kicks: $(patsubst %,$(BUILD)/cost/%.o,problems baselines gvi_run kicks)
	@echo '  ld $@'
	$(Q)$(CC) $^ -o $@ $(LDLIBS)

$(BUILD)/cost/cost: $(COST_OBJECTS)
	@echo '  ld $@'
	$(Q)$(CC) $(COST_OBJECTS) -o $@ $(LDLIBS)

$(PROGRAMS:%=run-%): run-%: $(BUILD)/tests/%
	$(Q)sh tests/tools/run_test.sh $(BUILD) $* $<

$(EXAMPLES:%=example-%): example-%: $(BUILD)/examples/%
	$(Q)sh tests/tools/run_example.sh $(BUILD) $* $<

$(VALGRIND_TESTS:%=valgrind-%): valgrind-%: $(BUILD)/tests/%
	$(Q)sh tests/tools/run_valgrind.sh $(BUILD) $* $<

$(VALGRIND_EXAMPLES:%=valgrind-%): valgrind-%: $(BUILD)/examples/%
	$(Q)sh tests/tools/run_valgrind.sh $(BUILD) $* $<

ifneq ($(filter deps-firmware,$(MAKECMDGOALS)),)
firmware size: | deps-firmware
endif

# "make -j deps test": what is compiled against cmocka waits for its installation.
ifneq ($(filter deps,$(MAKECMDGOALS)),)
cmocka headers symbols parts bound float docs-check instructions prices $(EXAMPLES:%=$(BUILD)/examples/%): | deps
endif

-include $(wildcard $(BUILD)/tests/*.d $(BUILD)/examples/*.d $(BUILD)/cost/*.d $(BUILD)/theorems/*.d $(BUILD)/hard/*.d)

-include tests/playground.mk
