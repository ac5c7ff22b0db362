# make demo    what symgen is for, from an empty checkout to a table and a plot under out/
# make test    the tests that take less than some 0.4 s each: about five minutes on two quiet cores
# make help    everything else
#
# The first target that needs it makes .venv with the newest Python that is there, 3.11 or newer, and installs symgen
# there, editable, with all extras; it is made again when pyproject.toml changes. Another interpreter:
# make test PYTHON=/path/to/python3.13

PYTHON ?= $(shell .ci/python 3.14 3.13 3.12 3.11 3)
WORKERS ?= 2
MINUTES ?= 45
DEMO_MODEL ?= four-bar
BENCH_VENV ?= .bench-venv

VENV := .venv
BIN := $(VENV)/bin
INSTALLED := $(VENV)/.installed
DOCS_INSTALLED := $(VENV)/.installed-docs
CODEMIRROR := symgen/cli/_editor/web/codemirror

.DEFAULT_GOAL := help
.PHONY: help demo test affected slow browser lint format generated codemirror docs gallery findings paper peers bench clean

help:  ## say what the targets do
	@sed -n 's/^\([a-z]*\):.*## \(.*\)/\1|\2/p' $(MAKEFILE_LIST) | awk -F'|' '{ printf "make %-10s %s\n", $$1, $$2 }'

$(INSTALLED): pyproject.toml
	@"$(BIN)/python" -m pip --version >/dev/null 2>&1 || { python="$(PYTHON)"; \
	  "$${python:-false}" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null || { \
	    echo "symgen needs Python 3.11 or newer with venv, got '$$python': make $(or $(MAKECMDGOALS),test)" \
	      "PYTHON=/path/to/python3.13" >&2; exit 1; }; \
	  echo "making $(VENV) with $$("$$python" --version)"; "$$python" -m venv --clear $(VENV); }
	@echo "installing symgen and what its tests need into $(VENV), once"
	@"$(BIN)/python" -m pip install -qq --disable-pip-version-check --editable '.[test]'
	@touch $@

$(DOCS_INSTALLED): $(INSTALLED)
	@echo "installing what the site needs into $(VENV), once"
	@"$(BIN)/python" -m pip install -qq --disable-pip-version-check --editable '.[docs]'
	@touch $@

demo: $(INSTALLED)  ## derive, generate, compile and run a mechanism with every method; table, result and picture in out/
	@mkdir -p out
	@"$(BIN)/symgen" check $(DEMO_MODEL)
	@echo; echo "the code of every method, and what each costs: half a minute"
	@"$(BIN)/symgen" generate $(DEMO_MODEL) --all --output out/$(DEMO_MODEL) > out/$(DEMO_MODEL).txt
	@"$(BIN)/symgen" compare $(DEMO_MODEL) --csv out/$(DEMO_MODEL).csv --output out/$(DEMO_MODEL).html \
	  >> out/$(DEMO_MODEL).txt 2>&1
	@echo; echo "one run, its largest loads, and its picture"
	@"$(BIN)/symgen" run $(DEMO_MODEL) --save out/$(DEMO_MODEL).nc --plot out/$(DEMO_MODEL).png > out/run.txt
	@sed -n '/^quantity/,$$p' out/run.txt
	@echo; echo "look at out/$(DEMO_MODEL).png, and at out/$(DEMO_MODEL).html: error against run time of every method"
	@echo "next:  $(BIN)/symgen new my-machine.toml    a file to begin with"
	@echo "       $(BIN)/symgen edit my-machine.toml   draw it and see it move"
	@echo "       $(BIN)/symgen --help                 all commands"

test: $(INSTALLED)  ## run the tests, except slow ones
	@"$(BIN)/python" -m pytest -n $(WORKERS) --dist worksteal

affected: $(INSTALLED)  ## run the tests of make test that enter what changed since the last time; the first time, all
	@"$(BIN)/python" -m pytest -n $(WORKERS) --dist worksteal -p tests.support.affected

slow: $(INSTALLED)  ## run the slow tests
	@"$(BIN)/python" -m pytest -n $(WORKERS) --dist worksteal -m "slow and not browser" --durations=100 --durations-min=4

browser: $(INSTALLED)  ## run the tests of pages in Chromium, which is installed where it is missing and apt-get can
	@command -v chromium chromium-browser google-chrome chrome >/dev/null || test -n "$$SYMGEN_BROWSER" \
	  || { echo "installing Chromium"; apt-get update -qq && apt-get install -qq --yes chromium >/dev/null; }
	@"$(BIN)/python" -m pytest -m browser tests/browser tests/processes

lint: $(INSTALLED)  ## check format, style, types and the direction of imports
	@"$(BIN)/ruff" format --check .
	@"$(BIN)/ruff" check .
	@"$(BIN)/mypy"
	@"$(BIN)/lint-imports"

format: $(INSTALLED)  ## put the sources into the project's format
	@"$(BIN)/ruff" format .
	@"$(BIN)/ruff" check --fix .

generated: $(INSTALLED)  ## write the checked-in modules under generated/ anew
	@SYMGEN_UPDATE_GENERATED=1 "$(BIN)/python" -m pytest tests/project/test_generated.py
	@git --no-pager diff --stat -- generated 2>/dev/null || true

codemirror:  ## bundle the text pane of the editor anew, by npm, which users do not need
	@mkdir -p out/codemirror && cp $(CODEMIRROR)/package.json $(CODEMIRROR)/parts.js out/codemirror
	@cd out/codemirror && npm install --silent && npx esbuild parts.js --bundle --minify --format=iife \
	  --global-name=CodeMirror --target=es2022 --legal-comments=none --outfile=codemirror.js
	@cp out/codemirror/codemirror.js $(CODEMIRROR)/codemirror.js

docs: $(DOCS_INSTALLED)  ## build the site into out/site; a warning is an error
	@"$(BIN)/python" -m sphinx -q -W --keep-going -c docs -d out/site-doctrees . out/site
	@echo "wrote out/site/index.html"

gallery: $(INSTALLED)  ## measure the catalogue anew: data, pictures and pages of docs/gallery and docs/pictures
	@"$(BIN)/python" -m benchmarks.gallery

findings: $(INSTALLED)  ## measure tables of pages and write them there: TABLES=names, TIMES=--times on a quiet machine
	@"$(BIN)/python" -m benchmarks.findings $(TABLES) $(TIMES)

paper: $(INSTALLED)  ## write the paper, tables of records, a lock file, and what MINUTES=45 of measuring anew find, into out/paper
	@"$(BIN)/python" -m benchmarks.paper out/paper --minutes $(MINUTES)

peers: $(INSTALLED)  ## measure other tools beside symgen into README, on a quiet machine; installs them into $(BENCH_VENV)
	@test -x "$(BENCH_VENV)/bin/python" || { echo "installing other tools into $(BENCH_VENV), once"; \
	  "$(BIN)/python" -m venv "$(BENCH_VENV)" && \
	  "$(BENCH_VENV)/bin/python" -m pip install -qq --disable-pip-version-check -r benchmarks/peers/requirements.txt; }
	@BENCH_PYTHON="$(abspath $(BENCH_VENV))/bin/python" "$(BIN)/python" -m benchmarks.records beside_tools --anew
	@"$(BIN)/python" -m benchmarks.findings beside_tools

bench: $(INSTALLED)  ## measure: right-hand side against gcc, time to first result, singular passages, space, peers if installed
	@"$(BIN)/python" -m benchmarks.against_gcc
	@"$(BIN)/python" -m benchmarks.first_result
	@"$(BIN)/python" -m benchmarks.singular
	@"$(BIN)/python" -m benchmarks.space --peers-python "$(BENCH_VENV)/bin/python"

clean:  ## remove .venv and everything that can be made again
	@rm -rf $(VENV) out build dist .mypy_cache .ruff_cache .pytest_cache .import_linter_cache .hypothesis
	@find . -name __pycache__ -type d -not -path './.git/*' -prune -exec rm -rf {} +
