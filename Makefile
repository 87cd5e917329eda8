# `make demo` and `make test` do all set-up themselves; `make help` lists the rest.

PYTHON ?= # the interpreter to build .venv from; chosen when empty
CARGO ?= cargo

VENV := .venv
BIN := $(VENV)/bin
# Without bytecode: what is imported is compiled then, the rest of torch and sympy never.
PIP := $(BIN)/python -m pip install --disable-pip-version-check --no-compile --constraint constraints.txt
RUST := Cargo.toml Cargo.lock $(shell find crates -name '*.rs' -o -name Cargo.toml)

export PYTHON CARGO
export PYO3_PYTHON := $(CURDIR)/$(BIN)/python# one interpreter for every build: nothing compiles twice

# Lines of targets that run at the same time are not mixed, where make is new enough (4.0).
WHOLE := $(if $(filter output-sync,$(.FEATURES)),--output-sync=target)

# Make's own flags are for make: cargo takes what it finds there for a jobserver that it may use.
ifneq ($(MAKELEVEL),0)
unexport MAKEFLAGS MFLAGS
endif

.PHONY: help venv demo test check-format check-lint lint-rust lint-python check-rust check-python format docs physics golden soak coverage bench clean
.DEFAULT_GOAL := help

help: ## list these targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "make %-14s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

venv: $(VENV)/made ## make the empty environment, for putting a PyTorch of your choice into it

demo: $(VENV)/built ## train robots by self-play for a few minutes, evaluate them, film a match
	$(BIN)/python -m rsoccer.demo

test: ## every check: formatting, lints, types, all tests
	@echo "two things are done at a time; each shows what it says when it is done"
	@$(MAKE) --no-print-directory --jobs 2 $(WHOLE) check-python check-rust check-lint check-format

check-format: $(VENV)/tools ## is everything formatted?
	$(CARGO) fmt --all --check
	$(BIN)/ruff format --check

check-lint: lint-rust lint-python ## lints, types and the stub of the compiled module

lint-rust: $(VENV)/tools
	$(CARGO) clippy --locked --workspace --all-targets -- -D warnings
	RUSTDOCFLAGS="-D warnings" $(CARGO) doc --locked --workspace --no-deps

lint-python: $(VENV)/built
	$(BIN)/ruff check
	$(BIN)/mypy
	$(BIN)/python -m mypy.stubtest rsoccer._core --mypy-config-file tools/stubtest.ini

check-rust: $(VENV)/tools ## tests of the physics
	$(CARGO) test --locked

check-python: $(VENV)/built ## tests of the package, the README and the examples
	$(BIN)/python -m pytest --numprocesses auto

format: $(VENV)/tools ## format everything
	$(CARGO) fmt --all
	$(BIN)/ruff check --fix
	$(BIN)/ruff format

docs: $(VENV)/built ## write the README's tables and pictures again from code and results
	$(BIN)/python -m tools.task_pictures
	$(BIN)/python -m tools.write_readme

physics: $(VENV)/built ## measure the physics again; write its page and draw its pictures
	$(BIN)/python -m tools.physics

golden: $(VENV)/tools ## renew the hashes that guard the physics, once PHYSICS_VERSION is raised
	RSIM_RENEW_GOLDEN=1 $(CARGO) test --locked --test all golden::

soak: $(VENV)/built ## ten million ticks of random play, a million steps of crowds in each task (many minutes)
	RSIM_SOAK_TICKS=10000000 $(CARGO) test --locked --release --test all soak:: -- --nocapture
	RSOCCER_SOAK_STEPS=1000000 $(BIN)/python -m pytest tests/testing/test_pressure.py --numprocesses auto

coverage: $(VENV)/built ## which lines the tests run, of Python and Rust (some minutes)
	$(BIN)/python -m tools.measure_coverage

bench: $(VENV)/built ## measure speed on this machine (some minutes; needs it quiet)
	$(CARGO) bench --locked --package rsim-bench --bench step
	$(BIN)/python -m benches.throughput

clean: ## remove everything that make made, downloads of Python packages included
	rm -rf $(VENV) target out .mypy_cache .pytest_cache .ruff_cache .hypothesis
	rm -f python/rsoccer/_core*.so

# Stamps: each says that a step is done, so that a second `make` starts at once.

$(VENV)/made: tools/make_venv.sh
	@sh tools/make_venv.sh $(VENV)
	$(PIP) --quiet --upgrade pip
	@touch $@

$(VENV)/tools: pyproject.toml constraints.txt $(VENV)/made
	$(PIP) --quiet --group dev
	@touch $@

$(VENV)/built: $(VENV)/tools $(RUST)
	@echo "building rSoccer and fetching what it needs (torch alone may be a 3 GB download)"
	@if [ -f $(VENV)/torch.pth ]; then cp $(VENV)/torch.pth $(VENV)/lib/python3*/site-packages/; fi
# The compiler does not wait for the downloads; when pip calls it, it has done its work or is
# waited for, and repeats what it had to say.
	@PATH="$(CURDIR)/$(BIN):$$PATH"; export PATH; \
	maturin develop --release --skip-install >/dev/null 2>&1 & \
	$(PIP) --no-build-isolation --editable '.[all]'; status=$$?; wait; exit $$status
	@touch $@
