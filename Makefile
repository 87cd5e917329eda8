# `make demo` and `make test` include all set-up; `make help` lists all targets.

PYTHON ?= # interpreter for .venv; found automatically if empty
CARGO ?= cargo

VENV := .venv
LIBRARIES := .venv-libraries
RECIPES := .venv-recipes
BIN := $(VENV)/bin
# --no-compile: modules are compiled when imported; most of torch and sympy never is.
PIP := $(BIN)/python -m pip install --disable-pip-version-check --no-compile --constraint constraints.txt
RUST := Cargo.toml Cargo.lock $(shell find crates -name '*.rs' -o -name Cargo.toml)

export PYTHON CARGO
export PYO3_PYTHON := $(CURDIR)/$(BIN)/python# one interpreter for every build, so that nothing compiles twice

# Keeps the output of parallel targets apart, with make 4.0 or newer.
WHOLE := $(if $(filter output-sync,$(.FEATURES)),--output-sync=target)

# Make's flags are hidden from cargo, which would take them for a jobserver of its own.
ifneq ($(MAKELEVEL),0)
unexport MAKEFLAGS MFLAGS
endif

.PHONY: help venv demo test check-format check-lint lint-rust lint-python check-rust check-python check-site check-libraries check-recipes format docs site physics golden soak agreement coverage bench clean
.DEFAULT_GOAL := help

help: ## list all targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "make %-14s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

venv: $(VENV)/made ## create the empty virtual environment, to install a PyTorch of your choice first

demo: $(VENV)/built ## train robots by self-play for a few minutes, evaluate them, record a match
	$(BIN)/python -m rsoccer.demo

test: ## run every check: formatting, lints, types, all tests, the documentation site
	@echo "running two checks at a time; each prints its output when it has finished"
	@$(MAKE) --no-print-directory --jobs 2 $(WHOLE) check-python check-rust check-lint check-site check-format

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

check-python: $(VENV)/built ## run the tests of the package, the README and the examples
	$(BIN)/python -m pytest --numprocesses auto

check-site: $(VENV)/site ## build the documentation site without the crates; warnings are errors
	$(BIN)/python -m tools.site --without-rust

check-libraries: $(LIBRARIES)/made ## run the tests with other trainer libraries, in an environment of their own
	$(LIBRARIES)/bin/python -m pytest tests/wrappers tests/test_page_code.py tests/test_docstrings.py \
		tests/benches/learning/test_sb3.py tests/benches/learning/test_pace.py

check-recipes: $(RECIPES)/benchmarl/made $(RECIPES)/pufferlib/made $(RECIPES)/tianshou/made ## run the recipes for libraries that need other versions, each in an environment of its own
	$(RECIPES)/benchmarl/bin/python -m pytest tests/wrappers/test_recipes.py -k benchmarl
	$(RECIPES)/pufferlib/bin/python -m pytest tests/wrappers/test_recipes.py -k pufferlib
	$(RECIPES)/tianshou/bin/python -m pytest tests/wrappers/test_recipes.py -k tianshou

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

soak: $(VENV)/built ## run ten million ticks of random play under each engine and a million steps of crowds per task (many minutes)
	RSIM_TEST_ENGINE=rapier RSIM_SOAK_TICKS=10000000 $(CARGO) test --locked --release --test all soak:: -- --nocapture
	RSIM_TEST_ENGINE=compact RSIM_SOAK_TICKS=10000000 $(CARGO) test --locked --release --test all soak:: -- --nocapture
	RSOCCER_SOAK_STEPS=1000000 $(BIN)/python -m pytest tests/testing/test_pressure.py --numprocesses auto

agreement: $(VENV)/built ## compare the contact engines over whole matches and a short training (half an hour)
	$(BIN)/python -m benches.engine_agreement
	$(BIN)/python -m tools.physics

coverage: $(VENV)/built ## measure the line coverage of Python and Rust (some minutes)
	$(BIN)/python -m tools.measure_coverage

bench: $(VENV)/built ## measure the speed of this machine (some minutes; no other load)
	$(CARGO) bench --locked --package rsim-bench --bench step
	$(BIN)/python -m benches.throughput

clean: ## remove all outputs of make, installed Python packages included
	rm -rf $(VENV) $(LIBRARIES) $(RECIPES) target out .mypy_cache .pytest_cache .ruff_cache .hypothesis
	rm -f python/rsoccer/_core*.so

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
# The build starts in parallel to the downloads. When pip calls the compiler, the build is complete
# or pip waits for it, and the compiler repeats its messages.
	@PATH="$(CURDIR)/$(BIN):$$PATH"; export PATH; \
	maturin develop --release --skip-install >/dev/null 2>&1 & \
	$(PIP) --no-build-isolation --editable '.[all]'; status=$$?; wait; exit $$status
	@touch $@

# It sees the packages of .venv, and has the group's own ones beside them.
$(LIBRARIES)/made: pyproject.toml constraints.txt $(VENV)/built
	@echo "downloading the trainer libraries (0.3 GB)"
	$(BIN)/python -m venv --clear --without-pip $(LIBRARIES)
	@$(LIBRARIES)/bin/python tools/see_packages.py $(VENV)
	$(BIN)/python -m pip --python $(LIBRARIES)/bin/python install --disable-pip-version-check --no-compile \
		--quiet --constraint constraints.txt --group wrappers
	@touch $@

# Without constraints.txt: they replace some of its versions. PufferLib asks for older ones than this package.
RECIPE_benchmarl := benchmarl==1.5.2
RECIPE_pufferlib := --no-deps pufferlib==2.0.2 gym==0.23.0
RECIPE_tianshou := tianshou==2.0.1

$(RECIPES)/%/made: $(VENV)/built
	$(BIN)/python -m venv --clear --without-pip $(@D)
	@$(@D)/bin/python tools/see_packages.py $(VENV)
	$(BIN)/python -m pip --python $(@D)/bin/python install --disable-pip-version-check --no-compile --quiet $(RECIPE_$*)
	@touch $@

$(VENV)/site: $(VENV)/built
	$(PIP) --quiet --group docs
	@touch $@
