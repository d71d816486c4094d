# Everything runs in the environment in .venv, which `setup` makes from requirements.lock.
#
#   make PYTHON=/path/to/python3.11 setup     chooses the Python; otherwise the first suitable one is taken

.DEFAULT_GOAL := help
.PHONY: help setup study check docs format fast test regress notebooks bench lock clean rebuild types rules site style

# Where Python is not to keep what it has compiled, each of the many processes of a test run compiles anew,
# which takes half of its time.
unexport PYTHONDONTWRITEBYTECODE

help: ## list these targets
	@awk -F ':.*## ' '/^[a-z]+:.*## / { printf "make %-8s %s\n", $$1, $$2 }' Makefile

setup: .venv/ready ## make the environment in .venv and the command .venv/bin/rgss (does nothing when it is up to date)

study: setup ## check the project, run the whole study of designs/, and print the decision
	@.venv/bin/rgss check
	@.venv/bin/rgss sweep
	@.venv/bin/rgss trade

# One process each, the longest first, on every core; what each of them says stays together.
check: setup ## format, lint, types, layers, rules of the repository, documentation
	@$(MAKE) --no-print-directory --output-sync --keep-going --jobs=$$(nproc) types rules site style

types rules site style: setup

types:
	@.venv/bin/mypy

rules:
	@.venv/bin/pytest --quiet tests/repository

site:
	@$(build_docs)

style:
	@.venv/bin/ruff format --check --quiet .
	@.venv/bin/ruff check --quiet .
	@.venv/bin/lint-imports --no-logo --no-cache

docs: site ## build the documentation site in build/site; warnings are errors
	@echo "Open build/site/index.html."

format: setup ## format the code and apply the linter's fixes
	@.venv/bin/ruff format --quiet .
	@.venv/bin/ruff check --quiet --fix .

fast: setup ## run the tests that need no engine and take no time, in half a minute
	@.venv/bin/python -m tests.in_shares --quiet --durations=10 --durations-min=0.3 -m "not engine and not browser and not slow"

# EXCEPT=tests/repository leaves out what `make check` has run.
test: setup ## run the whole test suite, on every core
	@.venv/bin/pytest --quiet --numprocesses=auto --dist=loadfile --no-loadscope-reorder $(EXCEPT:%=--ignore=%) \
		--junitxml=.rgss/junit.xml

regress: setup ## compare metrics and the decision of a small part of the study with the baseline
	@.venv/bin/rgss regress --junit .rgss/regress.xml

notebooks: setup ## run the notebooks in studies/ and keep their outputs in them
	@for each in studies/*.ipynb; do sockets=$$(mktemp -d) && .venv/bin/python tests/api/execution.py $$each $$sockets \
		&& rm -r $$sockets || exit 1; done

bench: setup ## measure the sweep engine on an idle machine (well over an hour); tables, and bench*.json
	@.venv/bin/python benchmarks/sweep.py --replicates 10 --json bench.json
	@.venv/bin/python benchmarks/dask_cluster.py --replicates 4 --json bench-dask.json
	@.venv/bin/python benchmarks/until_decided_sweeps.py --first 286 --json bench-until.json

lock: ## resolve requirements.lock anew from pyproject.toml (needs uv)
	@UV_CUSTOM_COMPILE_COMMAND="make lock" uv pip compile --quiet --universal --python-version 3.10 \
		--generate-hashes --no-emit-index-url --no-strip-extras --extra sim --extra docs --extra dev \
		--output-file requirements.lock pyproject.toml

clean: ## remove the environment and all caches; evidence in .rgss stays
	@rm -rf .venv .mypy_cache .ruff_cache .pytest_cache .hypothesis .import_linter_cache .grimp_cache build dist
	@find . -name __pycache__ -type d -prune -exec rm -rf {} +

# Not with --quiet, which drops warnings before --strict counts them: the log is shown if there are any.
# The variable silences the notice of the theme's authors about their next project.
build_docs = mkdir -p build && { NO_MKDOCS_2_WARNING=1 .venv/bin/mkdocs build --strict >build/docs.log 2>&1 \
	|| { grep -v '^INFO' build/docs.log >&2; false; }; }

# The first suitable Python, or "none of" and the versions that were found. Each candidate is run: a name on
# PATH may be a shim that stands for nothing.
find_python = $(shell \
	if [ -n "$(PYTHON)" ]; then set -- "$(PYTHON)"; else set -- python3.11 python3.10 python3.12 python3 python; fi; \
	found=; \
	for candidate; do \
		version=$$("$$candidate" -c 'import sys; print("%d.%d.%d" % sys.version_info[:3])' 2>/dev/null) || continue; \
		case $$version in \
			(3.10.*|3.11.*|3.12.*) printf '%s\n' "$$candidate"; exit;; \
			(*) case ", $$found," in (*", $$version,"*) ;; (*) found="$${found:+$$found, }$$version";; esac;; \
		esac; \
	done; \
	printf 'none of %s\n' "$$found")

# An environment knows its own place: one that was moved or copied is made again.
ifneq ($(shell cat .venv/place 2>/dev/null),$(CURDIR))
.venv/locked: rebuild
endif

# Made from nothing, so that it holds exactly what the lock names.
.venv/locked: requirements.lock
	$(eval python := $(find_python))
	$(if $(filter none,$(firstword $(python))),$(error rgss needs Python 3.10, 3.11 or 3.12; found \
		$(or $(wordlist 3,9,$(python)),none); set PYTHON=/path/to/python3.11))
	@rm -rf .venv
	@if command -v uv >/dev/null; then \
		echo "Installing requirements.lock into .venv with uv and $(python) ..."; \
		uv venv --quiet --python "$(python)" .venv && \
		uv pip sync --quiet --require-hashes --compile-bytecode --python .venv/bin/python requirements.lock; \
	else \
		echo "Installing requirements.lock into .venv with pip and $(python) (a minute or two) ..."; \
		"$(python)" -m venv .venv && \
		.venv/bin/python -m pip install -qq --no-input --disable-pip-version-check --require-hashes -r requirements.lock; \
	fi
	@printf '%s\n' "$(CURDIR)" > .venv/place
	@touch $@

# The tools that build the project are in the lock, so nothing is fetched here.
.venv/ready: .venv/locked pyproject.toml
	@if command -v uv >/dev/null; then \
		uv pip install --quiet --no-deps --no-build-isolation --python .venv/bin/python --editable .; \
	else \
		[ -x .venv/bin/pip ] || .venv/bin/python -m ensurepip >/dev/null; \
		.venv/bin/python -m pip install -qq --no-input --disable-pip-version-check \
			--no-deps --no-build-isolation --editable .; \
	fi
	@touch $@
