# The playground, docs/playground/index.html: gvi.h in a browser.  For inclusion in the Makefile.
#
#   make deps-playground     clang, lld, wasm libc and Chromium from Debian, playwright-core from npm
#   make playground          builds the page
#   make playground-test     its numbers to the bit, Lagrangians typed, then the page in a headless Chromium

PLAYGROUND        = $(BUILD)/playground
PLAYGROUND_SOURCE = $(wildcard docs/playground/*.[ch]) gvi.h examples/tools/effects.h examples/tools/lagrangian.h \
                    tests/cost/coefficients.h
WASM_CC    = clang
# The page has to stay under 200 KB; it says so when it does not.  By -Oz the program is 4 % smaller than by -Os, and its
# steps 8 % slower.
WASM_FLAGS = --target=wasm32-wasi -mexec-model=reactor -Oz -mbulk-memory -mnontrapping-fptoint -msign-ext \
             -fno-math-errno -mllvm -inline-threshold=0 -Wl,--gc-sections,--strip-all,-z,stack-size=65536
# The same text natively, for the test
PLAYGROUND_FLAGS = -std=c99 -ffp-contract=off -I. -Iexamples -Wall -Wextra -Wno-unused-const-variable

.PHONY: playground playground-test playground-bits playground-typed playground-page deps-playground

#: playground   builds docs/playground/index.html, gvi.h in a browser (make deps-playground)
playground: docs/playground/index.html

$(PLAYGROUND)/gvi.wasm: $(PLAYGROUND_SOURCE) tests/playground.mk
	@mkdir -p $(@D)
	@echo '  wasm $@'
	$(Q)$(WASM_CC) $(WASM_FLAGS) $(PLAYGROUND_FLAGS) docs/playground/wasm.c -o $@

docs/playground/index.html: $(PLAYGROUND)/gvi.wasm docs/playground/page.html docs/playground/page.js docs/playground/lagrangian.js \
                            docs/playground/style.css docs/playground/build.mjs
	$(Q)node docs/playground/build.mjs $< $@

$(PLAYGROUND)/native: tests/playground/native.c $(PLAYGROUND_SOURCE)
	@mkdir -p $(@D)
	@echo '  cc $@'
	$(Q)$(CC) -O2 $(PLAYGROUND_FLAGS) $< -o $@ -lm

#: deps-playground  installs what the playground is built and tested with
deps-playground:
	$(Q)sh tests/playground/deps.sh $(PLAYGROUND)

#: playground-test  the playground's numbers to the bit, what is typed, and the page in a headless Chromium
playground-test: playground-bits playground-typed playground-page

playground-bits: $(PLAYGROUND)/native $(PLAYGROUND)/gvi.wasm
	$(Q)node tests/playground/bits.mjs $^

playground-typed: $(PLAYGROUND)/gvi.wasm
	$(Q)node tests/playground/typed.mjs $< $(PLAYGROUND)

playground-page: docs/playground/index.html
	$(Q)node tests/playground/page.mjs $< $(PLAYGROUND)

ifneq ($(filter deps-playground,$(MAKECMDGOALS)),)
$(PLAYGROUND)/gvi.wasm playground-page: | deps-playground
endif
