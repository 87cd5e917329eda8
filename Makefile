# `make demo` and `make test` include all set-up; `make help` lists all targets.

PYTHON ?= # interpreter for .venv; found automatically if empty
CARGO ?= cargo

VENV := .venv
LIBRARIES := .venv-libraries
RLLIB := .venv-rllib
LOWEST := .venv-lowest$(if $(TORCH),-torch)
RECIPES := .venv-recipes
WHEELS := .venv-wheels
BIN := $(VENV)/bin
# --no-compile: modules are compiled when imported; most of torch and sympy never is.
PIP_OPTIONS := --disable-pip-version-check --no-compile
PIP := $(BIN)/python -m pip install $(PIP_OPTIONS) --constraint constraints.txt
RUST := Cargo.toml Cargo.lock $(shell find crates -name '*.rs' -o -name Cargo.toml)

export PYTHON CARGO
export PYO3_PYTHON := $(CURDIR)/$(BIN)/python# one interpreter for every build, so that nothing compiles twice

# Tests start hundreds of processes; without its bytecode each of them would compile torch again.
unexport PYTHONDONTWRITEBYTECODE

# Keeps the output of parallel targets apart, with make 4.0 or newer.
WHOLE := $(if $(filter output-sync,$(.FEATURES)),--output-sync=target)

# Make's flags are hidden from cargo, which would take them for a jobserver of its own.
ifneq ($(MAKELEVEL),0)
unexport MAKEFLAGS MFLAGS
endif

.PHONY: help venv demo test check-format check-lint lint-rust lint-python check-rust check-python check-site check-libraries check-rllib check-lowest check-recipes check-installs profiled wheels check-aarch64 wasm playground check-wasm format docs site physics golden soak agreement coverage bench compare clean
.DEFAULT_GOAL := help

help: ## list all targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "make %-14s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

venv: $(VENV)/made ## create the empty virtual environment, to install a PyTorch of your choice first

demo: $(VENV)/built ## train robots by self-play for half a minute, evaluate them, record a match
	$(BIN)/python -m rsoccer.demo

test: ## run every check: formatting, lints, types, all tests, trainer libraries, the documentation site
	@echo "running two checks at a time; each prints its output when it has finished"
	@$(MAKE) --no-print-directory --jobs 2 $(WHOLE) \
		check-python check-rust check-libraries check-rllib check-lowest check-lint check-site check-format

check-format: $(VENV)/tools ## check the formatting
	$(CARGO) fmt --all --check
	$(BIN)/ruff format --check

check-lint: lint-rust lint-python ## check lints, types and the stub of the compiled module

lint-rust: $(VENV)/tools
	$(CARGO) clippy --locked --workspace --all-targets -- -D warnings
	RUSTDOCFLAGS="-D warnings" $(CARGO) doc --locked --workspace --no-deps

lint-python: $(VENV)/built
	$(BIN)/ruff check
	$(BIN)/mypy
	$(BIN)/python -m mypy.stubtest rsoccer._core --mypy-config-file tools/stubtest.ini

check-rust: $(VENV)/tools ## run the tests of the physics under both engines
	RSIM_TEST_ENGINE=rapier $(CARGO) test --locked
	RSIM_TEST_ENGINE=compact $(CARGO) test --locked

# By file, as many files have fixtures that are made once for each process: 20 minutes instead of 33.
check-python: $(VENV)/built ## run the tests of the package, the README and the examples
	$(BIN)/python -m pytest --numprocesses auto --dist loadfile

check-site: $(VENV)/site ## build the documentation site without the crates; warnings are errors
	$(BIN)/python -m tools.site --without-rust

# The tests in which versions of dependencies can matter: interfaces, files, pictures, commands.
BY_VERSION := tests/envs tests/matches tests/render tests/commands tests/compat tests/test_core.py \
	tests/test_registry.py tests/test_rng.py tests/test_cli.py tests/test_files.py tests/test_tournament.py \
	tests/policies/test_policy_file.py tests/protocols

# Each of these environments is made for its tests: under tests.no_skips a missing library fails.
STRICT := -m pytest -p tests.no_skips
OF_LIBRARY := tests/test_page_code.py::test_blocks_run_with_their_library

check-libraries: $(LIBRARIES)/made ## run the tests with Stable-Baselines3, SuperSuit and TorchRL, in an environment of their own
	$(LIBRARIES)/bin/python $(STRICT) tests/wrappers --ignore-glob='*rllib*' --ignore-glob='*recipes*' \
		tests/test_docstrings.py tests/benches/learning/running/test_sb3.py \
		tests/benches/learning/running/test_pace.py \
		$(foreach library,minari stable_baselines3 supersuit torchrl,'$(OF_LIBRARY)[$(library)]')

check-rllib: $(RLLIB)/made ## run the tests with RLlib and the Gymnasium that Ray pins, in an environment of their own
	$(RLLIB)/bin/python $(STRICT) tests/wrappers/test_rllib*.py tests/test_docstrings.py '$(OF_LIBRARY)[ray]'

# Old versions warn of newer ones of what they import. The README's tables come from benches, which need more libraries.
check-lowest: $(LOWEST)/made ## run tests with the lowest versions of all dependencies but torch (TORCH=1: of torch too)
	$(LOWEST)/bin/python -m pytest -W ignore::DeprecationWarning --numprocesses auto \
		$(if $(TORCH),tests --ignore=tests/benches --ignore=tests/tools --ignore=tests/wrappers --ignore=tests/test_readme.py,$(BY_VERSION))

check-recipes: $(RECIPES)/benchmarl/made $(RECIPES)/pufferlib/made $(RECIPES)/tianshou/made ## run the recipes for libraries that need other versions, each in an environment of its own
	$(RECIPES)/benchmarl/bin/python -m pytest tests/wrappers/test_recipes.py -k benchmarl
	$(RECIPES)/pufferlib/bin/python -m pytest tests/wrappers/test_recipes.py -k pufferlib
	$(RECIPES)/tianshou/bin/python -m pytest tests/wrappers/test_recipes.py -k tianshou

check-installs: $(VENV)/built ## run every documented install line and its program, each in an empty environment (many minutes)
	$(BIN)/python -m tools.check_installs

# In a folder of its own: other flags of the compiler would compile everything in the usual one again, too.
profiled: $(VENV)/built ## build the compiled module again by a profile of typical play, as in wheels (5 minutes)
	env -u CONDA_PREFIX VIRTUAL_ENV="$(CURDIR)/$(VENV)" PATH="$(CURDIR)/$(BIN):$$PATH" CARGO_TARGET_DIR=target/profiled \
		PIP_CONSTRAINT="$(CURDIR)/constraints.txt" UV_CONSTRAINT="$(CURDIR)/constraints.txt" \
		maturin develop --pgo --locked --skip-install

ARCHITECTURES ?= x86_64
wheels: $(WHEELS)/made ## build the source distribution and wheels (ARCHITECTURES="x86_64 aarch64"), and try them without a compiler
	@rm -rf out/wheels
	$(WHEELS)/bin/python -m tools.wheels.build --architectures $(ARCHITECTURES)
	$(WHEELS)/bin/python -m tools.wheels.tryout out/wheels/*_$(shell uname -m).whl

# The same bits on another architecture, emulated. CONTRIBUTING.md lists the packages that it needs.
check-aarch64: export CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER := aarch64-linux-gnu-gcc
# With libc6:arm64 installed, too, its libc would meet the loader of the cross compiler, another version.
check-aarch64: export CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_RUNNER := qemu-aarch64 -L /usr/aarch64-linux-gnu \
	-E LD_LIBRARY_PATH=/usr/aarch64-linux-gnu/lib
check-aarch64: ## run the golden hashes and the determinism tests of the physics on an emulated ARM processor (some minutes)
	for engine in compact rapier; do \
		RSIM_TEST_ENGINE=$$engine $(CARGO) test --locked --target aarch64-unknown-linux-gnu --target-dir target/aarch64 \
			--package rsim-core --test all -- golden:: determinism:: || exit 1; \
	done

# WebAssembly: CONTRIBUTING.md lists the packages that it needs. The standard library is built, too, with a flag that
# stable compilers have only under the variable RUSTC_BOOTSTRAP. LTO, which takes minutes, is left out.
WASM := target/wasm/wasm32-unknown-unknown/release/rsim_wasm.wasm
wasm: export CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER ?= wasm-ld-19
wasm: export CARGO_PROFILE_RELEASE_LTO := off
wasm: export CARGO_PROFILE_RELEASE_CODEGEN_UNITS := 16
wasm: export RUSTC_BOOTSTRAP := 1
wasm:
	$(CARGO) build --locked --release --package rsim-wasm --target wasm32-unknown-unknown --target-dir target/wasm \
		-Zbuild-std=std,panic_abort

playground: wasm $(VENV)/built ## write a page that plays matches in a browser: out/playground/index.html (some minutes)
	$(BIN)/python -m tools.playground --module $(WASM)

check-wasm: playground ## compare matches in Node and Chromium with native ones bit by bit, and play the playground
	RSOCCER_WASM=$(WASM) $(BIN)/python $(STRICT) tests/wasm

format: $(VENV)/tools ## format all code
	$(CARGO) fmt --all
	$(BIN)/ruff check --fix
	$(BIN)/ruff format

docs: $(VENV)/built ## regenerate tables and pictures of README.md and docs/ from code and results
	$(BIN)/python -m tools.task_pictures
	$(BIN)/python -m tools.site.solved
	$(BIN)/python -m tools.write_readme

site: $(VENV)/site ## build the documentation site: out/site/index.html
	RUSTDOCFLAGS="-D warnings" $(CARGO) doc --locked --workspace --no-deps
	$(BIN)/python -m tools.site

physics: $(VENV)/built ## measure the physics and regenerate docs/physics.md with its pictures
	$(BIN)/python -m tools.physics

golden: $(VENV)/tools ## renew the golden hashes of the physics after a raise of PHYSICS_VERSION
	RSIM_RENEW_GOLDEN=1 $(CARGO) test --locked --test all golden::

soak: $(VENV)/built ## run ten million ticks of random play under each engine, a million steps of crowds per task, a million packets per port, and whole matches (many minutes)
	RSIM_TEST_ENGINE=rapier RSIM_SOAK_TICKS=10000000 $(CARGO) test --locked --release --test all soak:: -- --nocapture
	RSIM_TEST_ENGINE=compact RSIM_SOAK_TICKS=10000000 $(CARGO) test --locked --release --test all soak:: -- --nocapture
	RSOCCER_SOAK_STEPS=1000000 $(BIN)/python -m pytest tests/testing/test_pressure.py --numprocesses auto
	RSOCCER_FLOOD_PACKETS=1000000 $(BIN)/python -m pytest tests/bridge/test_floods.py -k nothing_breaks
	$(BIN)/python -m tools.soak_matches --store

agreement: $(VENV)/built ## compare the contact engines over whole matches and a short training (half an hour)
	$(BIN)/python -m benches.engine_agreement
	$(BIN)/python -m tools.physics

coverage: $(VENV)/built ## measure the line coverage of Python and Rust (some minutes)
	$(BIN)/python -m tools.measure_coverage

bench: $(VENV)/built ## measure the speed of this machine (some minutes; no other load)
	$(CARGO) bench --locked --package rsim-bench --bench step
	$(BIN)/python -m benches.throughput
	$(BIN)/python -m benches.whole_matches --store
	$(BIN)/python -m benches.training_speed --store

BEFORE ?= main
compare: $(VENV)/built ## compare the speed of a step with that of an earlier commit, BEFORE=main
	$(BIN)/python -m benches.comparison $(BEFORE)

clean: ## remove all outputs of make, installed Python packages included
	rm -rf $(VENV) $(VENV)-* target out .mypy_cache .pytest_cache .ruff_cache .hypothesis
	rm -f python/rsoccer/_core*.so

# An environment beside .venv whose stamp file is the target, and installing into it.
BESIDE = $(BIN)/python -m venv --clear --without-pip $(@D) && $(@D)/bin/python tools/see_packages.py $(VENV)
INTO = $(BIN)/python -m pip --python $(@D)/bin/python install $(PIP_OPTIONS) --quiet

# Stamp files mark completed steps, so that a second `make` skips them.

$(VENV)/made: tools/make_venv.sh
	@sh tools/make_venv.sh $(VENV)
	$(PIP) --quiet --upgrade pip
	@touch $@

$(VENV)/tools: pyproject.toml constraints.txt $(VENV)/made
	$(PIP) --quiet --group dev
	@touch $@

$(VENV)/built: $(VENV)/tools $(RUST)
	@echo "building rSoccer and downloading its dependencies (torch alone may be 3 GB)"
	@if [ -f $(VENV)/torch.pth ]; then cp $(VENV)/torch.pth $(VENV)/lib/python3*/site-packages/; fi
# The package is built while its dependencies are downloaded. pip then builds it again, which is done at once,
# and shows the messages of a build that failed.
	@PATH="$(CURDIR)/$(BIN):$$PATH"; export PATH; \
	maturin develop --release --skip-install >/dev/null 2>&1 & \
	$(PIP) --no-build-isolation --only-deps '.[all]'; status=$$?; wait; \
	[ $$status = 0 ] && $(PIP) --no-build-isolation --no-deps --editable .
	@touch $@

# These see the packages of .venv, and have own ones beside them.
$(LIBRARIES)/made: pyproject.toml constraints.txt $(VENV)/built
	@echo "downloading Stable-Baselines3, SuperSuit and TorchRL"
	$(BESIDE)
	$(INTO) --constraint constraints.txt --group wrappers
	@touch $@

$(RLLIB)/made: pyproject.toml constraints.txt $(VENV)/built
	@echo "downloading RLlib (0.2 GB)"
	$(BESIDE)
	@grep -v '^gymnasium==' constraints.txt >$(@D)/constraints.txt # Ray pins an older one
	$(INTO) --constraint $(@D)/constraints.txt --group rllib
	@touch $@

# It sees no other packages but this one.
$(LOWEST)/made: pyproject.toml constraints.txt tools/lowest_versions.py $(VENV)/built
	@echo "downloading the lowest versions of all dependencies"
	$(BIN)/python -m venv --clear --without-pip $(@D)
	$(BIN)/python -m tools.lowest_versions $(@D) $(if $(TORCH),--torch)
	$(INTO) --only-binary :all: --constraint $(@D)/others.txt --requirement $(@D)/lowest.txt
	@cp -r $(VENV)/lib/python3*/site-packages/rsoccer* $(@D)/lib/python3*/site-packages/
	@touch $@

# Without constraints.txt: they replace some of its versions. PufferLib asks for older ones than this package.
RECIPE_benchmarl := benchmarl==1.5.2
RECIPE_pufferlib := --no-deps pufferlib==2.0.2 gym==0.23.0
RECIPE_tianshou := tianshou==2.0.1

$(RECIPES)/%/made: $(VENV)/built
	$(BESIDE)
	$(INTO) $(RECIPE_$*)
	@touch $@

$(WHEELS)/made: pyproject.toml constraints.txt $(VENV)/tools
	$(BESIDE)
	$(INTO) --constraint constraints.txt --group wheels
	@touch $@

$(VENV)/site: $(VENV)/built
	$(PIP) --quiet --group docs
	@touch $@
