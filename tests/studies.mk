# studies.mk - what Makefile includes: long checks, measurements, pictures.  `make help-all` lists them.

.PHONY: headers-quick headers symbols chapters docs-check reference bound float instructions prices usable languages boards sanitize sanitized any_processor \
        ensemble deps-ensemble embedded-page tolerances firmware deps-firmware fuzz fuzz-short fuzz-rolling fuzz-rolling-short fuzz-contact fuzz-contact-short size stats compare everywhere deps-everywhere \
        cost-dial cost-rebound cost-packages cost-horizon cost-constraints cost-rolling cost-contact kicks points from-l typed mycost cost-embedded hard theorems mutants ablate coverage covered

## header       build/gvi.h without chapters: make header WITHOUT="NEWTON DIAL"; CORE=1: none of them (unifdef)
.PHONY: header header-sizes deps-header
header: | $(filter deps-header,$(MAKECMDGOALS))
	@mkdir -p $(BUILD)
	$(Q)sh tests/tools/header.sh $(BUILD)/gvi.h $(if $(CORE),CORE,$(WITHOUT))

#: header-sizes lines and bytes of headers made to order: the table of docs/embedded.md
ROBOT = RULES LAGRANGIAN CLOCK KICKS NEWTON CONSTRAINTS DIAL EXPLAIN TEXTS
header-sizes: | $(filter deps-header,$(MAKECMDGOALS))
	@mkdir -p $(BUILD)/header
	$(Q)echo '| without | lines | kB |'; echo '|---|---:|---:|'; cp gvi.h $(BUILD)/header/gvi.h
	$(Q)for chapters in '' CONSTRAINTS NEWTON 'NEWTON CONSTRAINTS' '$(ROBOT)' CORE; do \
	    [ -z "$$chapters" ] || sh tests/tools/header.sh $(BUILD)/header/gvi.h $$chapters >/dev/null || exit 1; \
	    wc -lc <$(BUILD)/header/gvi.h | awk -v what="$${chapters:-nothing}" \
	        '{ printf "| %s | %.1f thousand | %.0f |\n", what, $$1/1000, $$2/1000 }'; done

#: misra        which rules of MISRA C:2012 cppcheck finds broken in the core in float, and how often (ten seconds)
.PHONY: misra
misra: | $(filter deps-header,$(MAKECMDGOALS))
	@mkdir -p $(BUILD)/misra
	$(Q)sh tests/tools/header.sh $(BUILD)/misra/gvi.h CORE >/dev/null
	$(Q)cppcheck --addon=misra --std=c99 -I$(BUILD)/misra -DGVI_REAL=float -DGVI_STATIC -DGVI_IMPLEMENTATION \
	    tests/compile/implementation.c 2>$(BUILD)/misra/found >/dev/null
	$(Q)grep -o 'misra-c2012-[0-9.]*' $(BUILD)/misra/found | sed 's/.*-//' | sort -V | uniq -c | awk '{ print $$2 ": " $$1 }'

#: deps-header  installs what header and misra need: unifdef, cppcheck
deps-header: | $(filter deps deps-check,$(MAKECMDGOALS))
	$(Q)sh tests/tools/deps.sh --header

# -- steps of `make test` and `make check`; each can be run alone

#: headers      gvi.h through every compiler, standard, type and linkage there is, no warning
headers-quick: $(FLOAT_LIBRARY) $(addprefix $(BUILD)/gvi-,double.o long.o)
headers headers-quick: | $(FIRST)
	$(STEP) $@ sh tests/tools/headers.sh $(BUILD) $(if $(findstring quick,$@),--quick) $^

#: symbols      exports only gvi_, imports only libm, no data, no recursion
symbols: $(FLOAT_LIBRARY) $(addprefix $(BUILD)/gvi-,double.o long.o)
	$(STEP) $@ sh tests/tools/symbols.sh $(BUILD) $^

#: docs-check   the code in README, guide and header is compiled and its output compared
docs-check: $(BUILD)/gvi-double.o
	$(STEP) $@ sh tests/tools/docs.sh $(BUILD) $<

#: reference    writes docs/reference.md from gvi.h
reference:
	$(Q)python3 tests/tools/reference.py >docs/reference.md

#: chapters     gvi.h without each chapter, each alone on the core, pairs: warnings, bits, programs, symbols, sizes (four minutes)
#: bound        operations of a step, counted one by one, against the bound that gvi.h states (C++)
#: float        the object code of a float build: nothing is computed in double
#: instructions points, iterations and instructions of fixed runs; RECORD=--record writes them anew
#: prices       what an unlisted effect costs in instructions (valgrind): nothing
#: ensemble     lesson 32 on one thread, two threads, one and three MPI processes: the same bits
#: usable       what make install puts where, the tools in C and C++, and the ways into a project: pkg-config, CMake, a C++ sketch
#: languages    docs/languages.md: Python, Rust, JavaScript, Octave, each where it is there
#: boards       Windows (mingw, clang as cl), flash and RAM of least programs on AVR and Cortex-M, AVR's bits in simavr
#: firmware     three programs without an operating system, run as Cortex-M3 and M4F by qemu, against this machine
prices: | $(FIRST)
	$(STEP) $@ sh tests/tools/instructions.sh $(BUILD) --prices
chapters bound float instructions ensemble usable languages boards firmware: | $(FIRST)
	$(STEP) $@ sh tests/tools/$@.sh $(BUILD) $(RECORD)

#: everyday     each scene of tests/everyday written in each way, in all types: the same motion, status and cost (two minutes of one core)
#: everyday-drawn scenes and ways drawn anew for three seconds; SEED=5: those again
EVERYDAY = $(addprefix $(BUILD)/everyday/,double float long)
everyday: $(EVERYDAY)
	$(STEP) $@ sh -c 'bad=0; for i; do "$$i" || bad=1; done; exit $$bad' - $^
everyday-drawn: $(BUILD)/everyday/double
	$(STEP) $@ $< draw 3 $(SEED)
$(EVERYDAY): private CFLAGS = -O1
REAL_OF = '-DGVI_REAL=$(if $(findstring long,$*),long double,$*)'
HAS_CXX = $(shell command -v $(CXX) 2>/dev/null)
$(EVERYDAY): $(BUILD)/everyday/%: tests/everyday/everyday.c $(BUILD)/everyday/typed-%.o $(BUILD)/gvi-%.o
	$(Q)$(COMPILE) $(REAL_OF) -DGVI_IMPLEMENTED $(if $(HAS_CXX),,-DWITHOUT_CXX) $(TESTFLAGS) $< $(filter %.o,$^) -o $@ $(LDLIBS)
# C and, where it is there, C++ in one object
$(BUILD)/everyday/typed-%.o: tests/everyday/typed.c tests/everyday/typed.cpp tests/everyday/typed.h examples/tools/lagrangian.h gvi.h
	@mkdir -p $(@D)
	$(Q)$(CC) -std=c99 $(FLAGS) $(TESTFLAGS) -O1 $(REAL_OF) -c $< -o $@.c.o
	$(Q)$(if $(HAS_CXX),$(CXX) -std=c++11 $(FLAGS) $(TESTFLAGS) -O1 $(REAL_OF) -c tests/everyday/typed.cpp -o $@.cpp.o)
	$(Q)$(LD) -r $@.c.o $(if $(HAS_CXX),$@.cpp.o) -o $@

#: textbook     Lagrangians as textbooks print them against equations of motion derived by hand (two seconds of one core)
#: textbook-all the same in C and C++, in all types (a minute of one core)
TEXTBOOK = $(foreach real,double float long,$(BUILD)/typed/c-$(real) $(if $(HAS_CXX),$(BUILD)/typed/cpp-$(real)))
.PHONY: textbook textbook-all
textbook: $(BUILD)/typed/c-double
	$(STEP) $@ $<
textbook-all: $(TEXTBOOK)
	$(STEP) $@ sh -c 'bad=0; for i; do "$$i" || bad=1; done; exit $$bad' - $^
$(BUILD)/typed/c-%: tests/typed/textbook.c tests/typed/systems.h examples/tools/lagrangian.h $(BUILD)/gvi-%.o
	@mkdir -p $(@D)
	$(Q)$(CC) -std=c99 $(FLAGS) $(TESTFLAGS) -O1 $(REAL_OF) -DGVI_IMPLEMENTED $< $(filter %.o,$^) -o $@ $(LDLIBS)
$(BUILD)/typed/cpp-%: tests/typed/textbook.c tests/typed/systems.h examples/tools/lagrangian.h $(BUILD)/gvi-%.o
	@mkdir -p $(@D)
	$(Q)$(CXX) -std=c++11 $(FLAGS) $(TESTFLAGS) -O1 $(REAL_OF) -DGVI_IMPLEMENTED -xc++ $< -xnone $(filter %.o,$^) -o $@ $(LDLIBS)

#: sanitize     tests and examples under the address and undefined behaviour sanitizers
# By clang where there is one: it alone sees arithmetic on NULL.
# Not test_advise: its sweeps are minutes of calls that the others make too.
SANITIZED = $(filter-out test_advise,$(TESTS)) $(TYPED:%=%-float) $(EXAMPLES)
sanitize: | $(FIRST)
	$(Q)mkdir -p $(BUILD)/result; echo 0 0 1 >$(BUILD)/result/$@
	$(Q)if [ '$(CC)' = cc ] && sh tests/tools/under.sh sanitizer clang -xc >/dev/null && command -v clang >/dev/null; \
	then cc=clang cxx=clang++; else cc='$(CC)' cxx='$(CXX)'; fi; \
	if sh tests/tools/under.sh sanitizer "$$cc" -xc && sh tests/tools/under.sh sanitizer "$$cxx" -xc++; then \
	    $(MAKE) --no-print-directory CC="$$cc" CXX="$$cxx" BUILD=$(BUILD)/sanitize sanitized CPPFLAGS=-DTHINNED=8 \
	    CFLAGS='-O1 -g -fno-omit-frame-pointer -fsanitize=address,undefined,float-cast-overflow -fno-sanitize-recover=all' && \
	    cp $(BUILD)/sanitize/result/sanitized $(BUILD)/result/$@; fi
sanitized: $(SANITIZED)
	$(SUM) sanitized $(SANITIZED)

#: valgrind     the smaller tests and examples under valgrind
valgrind: $(VALGRIND:%=valgrind-%)
	$(SUM) valgrind $(VALGRIND:%=valgrind-%)
$(filter valgrind-test_%,$(VALGRIND:%=valgrind-%)): valgrind-%: $(BUILD)/tests/%
	$(STEP) $@ sh tests/tools/under.sh valgrind $<
$(filter-out valgrind-test_%,$(VALGRIND:%=valgrind-%)): valgrind-%: $(BUILD)/examples/%
	$(STEP) $@ sh tests/tools/under.sh valgrind $<

# One file, a form of it for each width of registers; other processors have the plain one alone.
FORMS = plain $(if $(filter x86_64%,$(shell $(CC) -dumpmachine 2>/dev/null)),avx2 avx512)
FORM_avx2   = -mavx2 -mfma
FORM_avx512 = -mavx512f -mavx512dq -mavx512vl -mavx512bw -mfma
$(BUILD)/alone/motion-%.o: examples/any_processor/motion.c | $(FIRST)
	@mkdir -p $(@D)
	$(Q)$(COMPILE) $(FORM_$*) -DMOTION=motion_$* -c $< -o $@
$(BUILD)/alone/any_processor: examples/any_processor/main.c $(FORMS:%=$(BUILD)/alone/motion-%.o)
	$(Q)$(COMPILE) $< $(filter %.o,$^) -o $@ $(LDLIBS)
any_processor: $(BUILD)/alone/any_processor
	$(STEP) $@ sh tests/tools/examples.sh run $(BUILD) $@ $<

#: fuzz         a minute of libFuzzer on descriptions and calls (clang); FUZZ_SECONDS=600
FUZZ_SECONDS = $(if $(filter fuzz,$(MAKECMDGOALS)),60,12)
fuzz fuzz-short: | $(FIRST)
	$(STEP) $@ sh tests/tools/under.sh fuzz $(BUILD) $(FUZZ_SECONDS)

#: fuzz-rolling 200,000 random rolling scenes against an index-1 reference (twenty minutes); SEED=2: others
fuzz-rolling fuzz-rolling-short: $(BUILD)/hard/rolling_scenes
	$(STEP) $@ $< $(if $(findstring short,$@),2000,200000) $(SEED)

#: fuzz-contact 2,000,000 steps of random contact scenes, each judged from outside (five minutes); SEED=2: others
fuzz-contact fuzz-contact-short: $(BUILD)/hard/contact_scenes
	$(STEP) $@ $< $(if $(findstring short,$@),100000,2000000) $(SEED)

#: deps-firmware installs what firmware, size and boards need: compilers for Arm, RISC-V and AVR, qemu, simavr
deps-firmware: | $(filter deps deps-check,$(MAKECMDGOALS))
	$(Q)sh tests/tools/deps.sh --firmware

#: deps-ensemble installs what ensemble needs: Open MPI
deps-ensemble: | $(filter deps deps-check deps-firmware,$(MAKECMDGOALS))
	$(Q)sh tests/tools/deps.sh --ensemble

#: coverage     lines and branches of gvi.h that the tests take (gcc, three minutes); what they do not: build/coverage/missing
coverage:
	$(Q)mkdir -p $(BUILD)/coverage
	$(Q)$(MAKE) --no-print-directory BUILD=$(BUILD)/coverage CFLAGS='-O0 --coverage -Dalways_inline=noinline -w' covered
covered: $(TESTS:%=$(BUILD)/tests/%)
	$(Q)sh tests/tools/coverage.sh $(BUILD) $(TESTS)

# -- figures about gvi.h

#: stats        lines, functions, size of the object, time to compile
stats:
	$(Q)sh tests/tools/stats.sh $(BUILD)

#: compare      times of fixed runs against those of the gvi.h in OLD=folder; COMPARE_FLAGS="-O3 -march=native"
compare:
	$(Q)sh tests/tools/compare.sh $(OLD) . "$(COMPARE_FLAGS)"

#: size         code, stack and RAM on Cortex-M0, Cortex-M4F, RISC-V 32 and AVR; DETAIL=--detail: by function
size: | $(FIRST)
	$(Q)sh tests/tools/size.sh $(BUILD) $(DETAIL)

#: everywhere   every machine that can be compiled for and imitated here: warnings, tests, bits (half an hour)
#:              RECORD=--record puts its tables into tests/README.md; ONLY="armhf tcc": these alone
everywhere:
	$(Q)ONLY='$(ONLY)' sh tests/tools/everywhere.sh $(BUILD) $(RECORD)

#: deps-everywhere installs compilers, C libraries and emulators for everywhere (Debian 12)
deps-everywhere:
	$(Q)sh tests/tools/everywhere.sh --deps

# -- scenes and the advisor

SCENES = $(filter-out scene scenes price,$(basename $(notdir $(wildcard examples/scenes/*.c))))
.PHONY: $(SCENES:%=scene-%)
## scenes       runs every scene and draws it in build/pictures/; one: make scene-net
scenes: $(SCENES:%=scene-%)

$(BUILD)/studies/scene $(BUILD)/studies/price: $(BUILD)/studies/%: examples/scenes/%.c
	@mkdir -p $(@D)
	$(Q)$(COMPILE) -Iexamples $< -o $@ $(LDLIBS)

$(SCENES:%=scene-%): scene-%: $(BUILD)/studies/scene
	$(Q)mkdir -p $(PICTURES)/scenes
	$(Q)$< $* --svg $(PICTURES)/scenes/$*.svg

## advise       builds build/examples/advise: degree, step and tolerance for a wanted error
advise: $(BUILD)/examples/advise
ifdef FILE
	$(Q)$(COMPILE) -Iexamples -Wno-unused-function '-DADVISE_FILE="$(abspath $(FILE))"' examples/tools/advise.c \
	    $(BUILD)/cost/problems.o $(BUILD)/cost/baselines.o -o $(BUILD)/examples/advise-mine $(LDLIBS)
	$(Q)$(BUILD)/examples/advise-mine '$(abspath $(FILE))' --error $(or $(ERROR),1e-8)
endif
$(BUILD)/examples/advise: examples/tools/advise.c $(BUILD)/cost/problems.o $(BUILD)/cost/baselines.o
	@mkdir -p $(@D)
	$(Q)$(COMPILE) -Iexamples $< $(filter %.o,$^) -o $@ $(LDLIBS)

## mycost       what accuracy costs for a scene of your own, FILE=mine.c: a table and build/mycost.svg
mycost: | $(FIRST)
	$(Q)$(if $(FILE),,echo 'make mycost FILE=mine.c: what the file defines is said in examples/tools/mycost.c'; exit 1)
	$(Q)mkdir -p $(BUILD)
	$(Q)$(CC) -std=gnu11 -O2 -I. -Iexamples '-DMYCOST_FILE="$(abspath $(FILE))"' examples/tools/mycost.c -o $(BUILD)/mycost $(LDLIBS)
	$(Q)$(BUILD)/mycost $(BUILD)/mycost.svg

# -- what accuracy costs: optimised as a user in a hurry would; make cost RECORD=--record puts tables and
#    pictures into docs

COST_CFLAGS = -O3 -march=native -ffp-contract=fast -fno-math-errno -fno-trapping-math

## cost         CPU time for a given error: gvi.h and the usual alternatives; SCENE=net: what each effect of it costs
ifdef SCENE
cost: $(BUILD)/studies/price
	$(Q)$< $(SCENE)
else
cost: $(BUILD)/cost/cost
	$(Q)$< --out $(BUILD)/cost $(COST_ARGS) | tee $(BUILD)/cost/table.txt
	$(Q)sh tests/tools/cost_record.sh $(BUILD) $(RECORD)
endif

#: cost-dial    what you ask for, what you get, what it takes: gvi.h by its dial, fixed steps, rivals that choose their
#:              steps, at plain -O2 (a few minutes); RECORD=--record puts tables and pictures into docs/cost.md
cost-dial:
	$(Q)$(MAKE) --no-print-directory BUILD=$(BUILD)/dial COST_CFLAGS=-O2 $(BUILD)/dial/cost/cost
	$(Q)$(BUILD)/dial/cost/cost --dial --out $(BUILD)/dial/cost $(COST_ARGS) | tee $(BUILD)/dial/cost/table.txt
	$(Q)sh tests/tools/cost_record.sh $(BUILD)/dial '$(RECORD)' dial

#: cost-rebound REBOUND=folder: gvi.h by its dial against the IAS15 of the REBOUND that is there, compiled by its own Makefile in
#:              a copy (a minute); RECORD=--record puts the table into docs/cost.md
cost-rebound:
	$(Q)$(if $(REBOUND),,echo 'make cost-rebound REBOUND=folder: that of a clone of REBOUND'; exit 1)
	$(Q)$(MAKE) --no-print-directory BUILD=$(BUILD)/dial COST_CFLAGS=-O2 $(BUILD)/dial/cost/problems.o
	$(Q)sh tests/tools/cost_rebound.sh $(BUILD)/dial '$(REBOUND)'
	$(Q)sh tests/tools/cost_record.sh $(BUILD)/dial '$(RECORD)' rebound

#: cost-packages gvi.h by its dial against GSL's rk8pd and Boost's rkf78, where libgsl-dev and libboost-dev are (two minutes);
#:              RECORD=--record puts the table into docs/cost.md
cost-packages:
	$(Q)$(MAKE) --no-print-directory BUILD=$(BUILD)/dial COST_CFLAGS=-O2 $(BUILD)/dial/cost/problems.o
	$(Q)$(CXX) -std=c++20 -O2 -Wall -Wextra -Wno-missing-field-initializers -I. tests/cost/packages.cpp $(BUILD)/dial/cost/problems.o \
	    -o $(BUILD)/dial/cost/packages -lgsl -lgslcblas $(LDLIBS)
	$(Q)$(BUILD)/dial/cost/packages $(BUILD)/dial/cost/packages.md
	$(Q)cat $(BUILD)/dial/cost/packages.md
	$(Q)sh tests/tools/cost_record.sh $(BUILD)/dial '$(RECORD)' packages

#: cost-horizon the outer solar system at 1, 10 and 100 times its length
cost-horizon: $(BUILD)/cost/cost
	$(Q)$< --horizon --out $(BUILD)/cost

#: kicks        splittings as tables of kicks against the same written by hand (ten seconds)
#: points       callbacks by GVI_POINTS against loops by hand and .point (ten seconds); COST_CFLAGS="-O2 -fno-math-errno"
#: from-l       what it costs to give L alone, in C and in C++, against derivatives by hand, and what the watch takes of a step
#:              in instructions (valgrind; a minute)
from-l: tests/cost/from_l.c $(BUILD)/gvi-double.o
	@mkdir -p $(BUILD)/cost
	$(Q)$(CC) -std=c99 $(FLAGS) -O2 -Iexamples -DGVI_IMPLEMENTED $^ -o $(BUILD)/cost/from_l $(LDLIBS)
	$(Q)echo C && $(BUILD)/cost/from_l && sh tests/tools/watch.sh $(BUILD)/cost/from_l
	$(Q)$(CXX) -std=c++11 $(FLAGS) -O2 -Iexamples -DGVI_IMPLEMENTED -xc++ $< -xnone $(BUILD)/gvi-double.o -o $(BUILD)/cost/from_l $(LDLIBS)
	$(Q)echo C++ && $(BUILD)/cost/from_l && sh tests/tools/watch.sh $(BUILD)/cost/from_l

#: typed        10,000 random Lagrangians for lagrangian.h, 1,000 with the wrong kind, 1,000 with a derivative lost (a minute)
typed: tests/fuzz/typed.c $(BUILD)/gvi-double.o
	@mkdir -p $(BUILD)/fuzz
	$(Q)$(CC) -std=c99 $(FLAGS) $(TESTFLAGS) -O2 -DGVI_IMPLEMENTED $^ -o $(BUILD)/fuzz/typed $(LDLIBS)
	$(Q)$(BUILD)/fuzz/typed $(TYPED_FACTOR)

#: cost-constraints rods and a top with constraints, against RATTLE's compositions and DOP853; chains to 500 rods, 216 molecules (two minutes)
#: cost-rolling a rolling disc: gvi.h, DOP853 and the midpoint rule on reduced equations (half a minute)
#: cost-contact a step beside a contact that is open; a ball on a wavy table by contact.h, event.h and a stiff spring (ten seconds)
cost-contact: $(BUILD)/cost/contact
	$(Q)$<
kicks points: %: $(BUILD)/cost/%
	$(Q)$< $(COST_ARGS)
cost-rolling: $(BUILD)/cost/rolling
	$(Q)$<
cost-constraints: cost-%: $(BUILD)/cost/%
	$(Q)$< --out $(BUILD)/cost $(COST_ARGS)

#: cost-embedded instructions of a step on Cortex-M4F and Cortex-M3 and what they buy (qemu-system-arm; 4 minutes)
cost-embedded:
	$(Q)sh tests/tools/embedded_cost.sh $(BUILD)

#: embedded-page docs/embedded.md against what boards, firmware, size, chapters and cost-embedded print (ten minutes); RECORD=--record
#:              puts it there
embedded-page:
	@mkdir -p $(BUILD)/page
	$(Q)for i in boards firmware size chapters; do $(MAKE) --no-print-directory $$i >$(BUILD)/page/$$i.txt || exit 1; done
	$(Q)$(MAKE) --no-print-directory cost-embedded >$(BUILD)/page/cost.txt
	$(Q)python3 tests/tools/embedded_page.py $(BUILD)/page $(RECORD)

$(BUILD)/cost/%.o: tests/cost/%.c
	@mkdir -p $(@D)
	$(Q)$(CC) -std=c99 $(WARNINGS) -Wno-double-promotion -Wno-unused-parameter -I. -Iexamples -Itests $(CPPFLAGS) -MMD -MP -MF $@.d -MT $@ $(COST_CFLAGS) -c $< -o $@
$(BUILD)/cost/constraints $(BUILD)/cost/points $(BUILD)/cost/rolling $(BUILD)/cost/contact: %: %.o
	$(Q)$(CC) $< -o $@ $(LDLIBS)
$(BUILD)/cost/kicks $(BUILD)/cost/cost: %: %.o $(addprefix $(BUILD)/cost/,problems.o baselines.o gvi_run.o)
	$(Q)$(CC) $^ -o $@ $(LDLIBS)

#: tolerances   each constant of gvi.h's section TOLERANCES by half and by two: iterations, tests that fail (ten minutes); NAME=GVI__NOISE
tolerances: | $(FIRST)
	$(Q)sh tests/tools/tolerances.sh $(BUILD) $(NAME)

#: mutants      slips put into gvi.h one by one: which of them no test sees (Python; twenty minutes of one core); K="23 59": these alone
mutants: | $(FIRST)
	$(Q)mkdir -p $(BUILD) && python3 tests/tools/mutants.py $(BUILD) $(K)

#: ablate       each condition of judgement taken out alone, and which test misses it (Python; an hour of one core); K="3 7": these alone
ablate: | $(FIRST)
	$(Q)mkdir -p $(BUILD) && python3 tests/tools/ablate.py $(BUILD) $(K)

# -- hard cases and theorems, measured

HARD     = rope refused random dial measure rest lucky constraints constraints-float eccentric flyby roots eccentric-float pythagorean corners corners-float stiff long long-float brouwer brouwer-float walk drift rolling
ORDERS   = order rules constant counterexample lagrangian curve forced
THEOREMS = spectral inertia stability modified
# Orders need more digits than long double has on x86.
$(BUILD)/theorems/orders: TESTFLAGS += $(shell CC='$(CC)' sh tests/theorems/quad.sh)
SEED =
RANDOM_SECONDS = 60
.PHONY: hard-random-float $(HARD:%=hard-%) $(ORDERS:%=theorem-%) $(THEOREMS:%=theorem-%)

$(BUILD)/hard/%-float: tests/hard/%.c
	@mkdir -p $(@D)
	$(Q)$(COMPILE) -DGVI_REAL=float $(TESTFLAGS) $< -o $@ $(LDLIBS)
$(BUILD)/hard/% $(BUILD)/theorems/%: tests/$$(notdir $$(@D))/$$*.c | $(FIRST)
	@mkdir -p $(@D)
	$(Q)$(COMPILE) $(TESTFLAGS) $< -o $@ $(LDLIBS)

#: hard         hard cases at length, docs/hard-cases.md (fifteen minutes); one: make hard-drift; SEED=11: other random numbers;
#:              make hard-random RANDOM_SECONDS=3600: random scenes of all kinds for an hour; hard-random-float.  Not in long
#:              double: that is what the references compute in
hard: $(HARD:%=hard-%)
$(HARD:%=hard-%) hard-random-float: hard-%: $(BUILD)/hard/%
	$(Q)mkdir -p $(PICTURES)
	$(STEP) $@ $< $(if $(filter stiff,$*),$(PICTURES)) $(if $(filter brouwer% drift lucky,$*),$(SEED)) $(if $(filter random%,$*),$(RANDOM_SECONDS) $(SEED))

# Short forms of those above, in make check: what no check runs breaks
SHORT_random  = 5
SHORT_roots   = 6
SHORT_rest    = 60
SHORT_rolling = 16384
.PHONY: hard-random-short hard-roots-short hard-rest-short hard-rolling-short
hard-random-short hard-roots-short hard-rest-short hard-rolling-short: hard-%-short: $(BUILD)/hard/%
	$(STEP) $@ $< $(SHORT_$*)

#: theorems     docs/theory.md measured again, with its pictures (six minutes); one: make theorem-curve, ten seconds, in make check
theorems: $(ORDERS:%=theorem-%) $(THEOREMS:%=theorem-%)
$(ORDERS:%=theorem-%): theorem-%: $(BUILD)/theorems/orders
	$(Q)mkdir -p $(PICTURES)
	$(STEP) $@ $< $* $(PICTURES)
$(THEOREMS:%=theorem-%): theorem-%: $(BUILD)/theorems/%
	$(Q)mkdir -p $(PICTURES)
	$(Q)$< $(PICTURES)

-include $(wildcard $(BUILD)/hard/*.d $(BUILD)/theorems/*.d)
