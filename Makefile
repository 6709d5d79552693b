# Two commands: `make demo` draws the stability map of a Series 60 ship, `make test` checks everything.
# Both set themselves up in .venv; a machine needs python3 (3.11 or newer), make and a C compiler's libraries only.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin

.PHONY: demo test docs browser bench clean

demo: $(VENV)/.demo
	mkdir -p demo
	$(BIN)/quartering polar series60-cb60 -o demo/series60-cb60-polar.nc

test: $(VENV)/.dev
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/python -m pytest -n auto --maxprocesses 4 --dist loadfile

docs: $(VENV)/.docs
	$(BIN)/sphinx-build --fail-on-warning --keep-going --quiet docs build/docs
	@echo "build/docs/index.html"

# The explorer is tested in Chromium; where it is missing and apt-get can bring it, it is brought.
browser:
	@command -v chromium || command -v chromium-browser || command -v google-chrome || { \
	  command -v apt-get >/dev/null || { echo "no chromium here, and no apt-get to bring it: install it yourself"; exit 2; }; \
	  as_root=; [ "$$(id -u)" = 0 ] || as_root="sudo -n"; \
	  $$as_root apt-get update -qq && $$as_root apt-get install -qq -y --no-install-recommends chromium fonts-dejavu-core; }

bench: $(VENV)/.dev
	$(BIN)/python benchmarks/polar.py
	$(BIN)/python benchmarks/start_up.py
	$(BIN)/python benchmarks/verdict_agreement.py
	$(BIN)/python benchmarks/hull_database.py
	$(BIN)/python benchmarks/conditions.py
	$(BIN)/python benchmarks/irregular.py

$(VENV)/pyvenv.cfg:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { \
	  echo "python3 is $$($(PYTHON) -V 2>&1); quartering needs 3.11 or newer: make PYTHON=python3.12 demo"; exit 2; }
	$(PYTHON) -m venv $(VENV) || { rm -rf $(VENV); \
	  echo "python3 cannot make a virtual environment; install its venv module (Debian: python3-venv)"; exit 2; }

$(VENV)/.demo: $(VENV)/pyvenv.cfg pyproject.toml
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable .
	touch $@

$(VENV)/.dev: $(VENV)/pyvenv.cfg pyproject.toml
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[dev]'
	touch $@ $(VENV)/.demo

$(VENV)/.docs: $(VENV)/.dev
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[docs]'
	touch $@

clean:
	rm -rf $(VENV) demo build docs/gallery docs/reference .pytest_cache .mypy_cache .ruff_cache .import_linter_cache .hypothesis
	find src tests -name __pycache__ -type d -prune -exec rm -rf {} +
