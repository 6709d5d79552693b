# Two commands: `make demo` draws the stability map of a Series 60 ship, `make test` checks everything.
# Both set themselves up in .venv; a machine needs python3 (3.11 or newer), make and a C compiler's libraries only.
# The checks have three tiers: `make quick` while writing, `make test` before a merge, `make soak` by hand before a release.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
CONSTRAINTS := constraints.txt
PIP := $(BIN)/python -m pip install --quiet --no-compile --disable-pip-version-check $(CONSTRAINTS:%=--constraint %)
# pip would compile what it brings to bytecode on one core, half a minute; some templates among it are no Python of today.
BYTECODE := $(BIN)/python -m compileall -q -j 0 $(VENV)/lib >/dev/null 2>&1 || true
# Where it is set every process would compile all of the library again: a quarter of a minute of each test worker alone.
unexport PYTHONDONTWRITEBYTECODE
PYTEST := $(BIN)/python -m pytest -n auto --maxprocesses 4 --dist loadfile

.PHONY: demo quick test soak test-latest docs browser bench bench-check constraints clean lint types tests-quick tests-all

demo: $(VENV)/.demo
	mkdir -p demo
	$(BIN)/quartering polar series60-cb60 -o demo/series60-cb60-polar.nc

# The type checker uses one core: the tests run beside it.
quick: $(VENV)/.dev
	@$(MAKE) --no-print-directory --jobs 2 lint types tests-quick

test: $(VENV)/.dev
	@$(MAKE) --no-print-directory --jobs 2 lint types tests-all

# Kills and interrupts at any moment, a full disk, peak memory, a loaded server: long, and in part by chance. As root nothing is
# left out that root alone can do; what this machine cannot is skipped with its reason.
soak: $(VENV)/.soak
	$(BIN)/python -m pytest -m soak

# The newest releases of everything, in place of the versions of constraints.txt: red here is news, not a fault.
test-latest:
	@$(MAKE) --no-print-directory test VENV=.venv-latest CONSTRAINTS=

lint:
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/lint-imports

types:
	$(BIN)/mypy

tests-quick:
	$(PYTEST) -m quick tests

tests-all:
	$(PYTEST)

# The Python of the pages and of the gallery is run; GALLERY=False builds every page and runs none, which takes minutes.
GALLERY ?= True

docs: $(VENV)/.docs
	$(BIN)/sphinx-build -D plot_gallery=$(GALLERY) --fail-on-warning --keep-going --quiet docs build/docs
	@echo "build/docs/index.html"

# The explorer is tested in Chromium; where it is missing and apt-get can bring it, it is brought.
browser:
	@command -v chromium || command -v chromium-browser || command -v google-chrome || { \
	  command -v apt-get >/dev/null || { echo "no chromium here, and no apt-get to bring it: install it yourself"; exit 2; }; \
	  as_root=; [ "$$(id -u)" = 0 ] || as_root="sudo -n"; \
	  $$as_root apt-get update -qq && $$as_root apt-get install -qq -y --no-install-recommends chromium fonts-dejavu-core; }

bench: $(VENV)/.bench
	$(BIN)/python benchmarks/polar.py
	$(BIN)/python benchmarks/start_up.py
	$(BIN)/python benchmarks/verdict_agreement.py
	$(BIN)/python benchmarks/hull_database.py
	$(BIN)/python benchmarks/conditions.py
	$(BIN)/python benchmarks/irregular.py
	$(BIN)/python benchmarks/beside_rivals.py
	$(BIN)/python benchmarks/growth.py
	$(BIN)/python -m pytest -q -s -p tests.view.conftest benchmarks/explorer.py

# Ratios to rivals that run beside, against those recorded for this kind of processor: below 80 % of one fails.
bench-check: $(VENV)/.dev
	$(BIN)/python benchmarks/check.py

$(VENV)/pyvenv.cfg:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { \
	  echo "python3 is $$($(PYTHON) -V 2>&1); quartering needs 3.11 or newer: make PYTHON=python3.12 demo"; exit 2; }
	$(PYTHON) -m venv $(VENV) || { rm -rf $(VENV); \
	  echo "python3 cannot make a virtual environment; install its venv module (Debian: python3-venv)"; exit 2; }

$(VENV)/.demo: $(VENV)/pyvenv.cfg pyproject.toml $(CONSTRAINTS)
	$(PIP) --editable .
	$(BYTECODE)
	touch $@

$(VENV)/.dev: $(VENV)/pyvenv.cfg pyproject.toml $(CONSTRAINTS)
	$(PIP) --editable '.[dev]'
	$(BYTECODE)
	touch $@ $(VENV)/.demo

$(VENV)/.soak: $(VENV)/.dev
	$(PIP) --editable '.[dev,soak]'
	$(BYTECODE)
	touch $@

$(VENV)/.bench: $(VENV)/.dev
	$(PIP) --editable '.[dev,bench]'
	$(BYTECODE)
	touch $@

$(VENV)/.docs: $(VENV)/.dev
	$(PIP) --editable '.[docs]'
	$(BYTECODE)
	touch $@

# At each release, after `make test-latest`: the head of the file stays, the names and versions are written anew.
constraints:
	rm -rf build/constraints
	$(PYTHON) -m venv build/constraints
	build/constraints/bin/python -m pip install --quiet --disable-pip-version-check '.[dev,docs,bench]'
	grep '^#' constraints.txt > build/constraints/head
	build/constraints/bin/python -m pip freeze --quiet --exclude quartering 2>/dev/null \
	  | grep -E '^[A-Za-z0-9._-]+==[^ ]+$$' > build/constraints/versions
	cat build/constraints/head build/constraints/versions > constraints.txt

clean:
	rm -rf $(VENV) .venv-latest demo build docs/gallery docs/reference .pytest_cache .mypy_cache .ruff_cache .import_linter_cache .hypothesis
	find src tests -name __pycache__ -type d -prune -exec rm -rf {} +
