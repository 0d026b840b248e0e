# `make` builds every set of problems except the library; `make help` lists the other targets. GNU make 3.81 suffices.
# After a build the stamp `.built` of a set is newer than all inputs of the set. If nothing has changed since then,
# `make` starts no Python.

.DEFAULT_GOAL := all
.SUFFIXES:
MAKEFLAGS += --no-builtin-rules
PYTHON := .venv/bin/python
# Python keeps compiled modules next to the sources, even if the environment says that it should not. Otherwise each start
# would compile them for about a second, and the tests start Python very often.
export PYTHONDONTWRITEBYTECODE :=

# The names of sets and files become words of rules and commands. A set whose name has other characters than letters,
# digits, `-` and `_`, or is the name of another target, is left out with a warning. Files whose names have characters
# other than letters, digits, `.`, `_` and `-` are not prerequisites. The record `.outputs` in build/ is read as a list
# of words and is never included as rules.
RESERVED := all always bench build check clean derive help mutants problems schemas templates test tests tools
SETS := $(shell cd problems 2>/dev/null && LC_ALL=C && for name in *; do \
    test -e "$$name/set.yaml" || continue; \
    case "$$name" in ([!A-Za-z0-9]*|*[!A-Za-z0-9_-]*) why='a name has letters, digits, - and _ only' ;; \
      (*) case " $(RESERVED) " in (*" $$name "*) why='make has a target of that name' ;; (*) why= ;; esac ;; esac; \
    case "$$name" in (*[!\ -~]*) shown='?' ;; (*) shown="$$name" ;; esac; \
    if test -z "$$why"; then echo "$$name"; \
    else printf 'warning[set-name]: the set "%s" is left out: %s\n' "$$shown" "$$why" >&2; fi; done)
files_in = $(shell LC_ALL=C find -H $(1) '(' -name '*[!A-Za-z0-9._-]*' -o -name __pycache__ ')' -prune -o -print 2>/dev/null)
ENGINE := $(filter %.py,$(call files_in,derive))
TEMPLATES := $(call files_in,templates)
ENVIRONMENT := pyproject.toml locks/runtime.txt locks/tests.txt tools/bootstrap.py

.PHONY: all help check bench test schemas mutants clean always $(SETS)

# The library is built only on request (`make library`).
all: .venv/.runtime $(filter-out library,$(SETS))

help:
	@echo 'make          builds every set except the library, in build/; the first run installs the packages into .venv'
	@$(foreach set,$(SETS),echo 'make $(set)      builds the set $(set)';)
	@echo 'make check    derives every problem, verifies each line, compares with the references'
	@echo 'make test     runs lint, types and the test suite; with DERIVE_ALL_TESTS=1 all cases of each test'
	@echo 'make schemas  writes the JSON schemas with which text editors check problems, sets and references'
	@echo 'make mutants  alters code and results one at a time, and lists the changes that no check refuses (two hours)'
	@echo 'make bench    measures times of builds, derivations and comparisons, most of them as ratios'
	@echo 'make clean    removes the folders in build/; .venv stays'
	@echo 'DERIVE_ENGINE=latexmk (or pdflatex, lualatex, tectonic) chooses another TeX; .venv/bin/derive doctor lists those found'

# The record `.outputs` of a set lists its engine, its outputs, and scripts of other sets that it uses. If an output was
# deleted, or was made with another engine or another level of detail, the set is built again although its stamp is new.
# `$(value DERIVE_ENGINE)` is used because make would expand a `$` in the setting.
define RULES_OF_A_SET
record_of_$(1) := $$(shell test -f build/$(1)/.outputs && while read -r word; do \
    case "$$$$word" in (*[!A-Za-z0-9._/=-]*) ;; (*) echo "$$$$word" ;; esac; done < build/$(1)/.outputs)
$(1): build/$(1)/.built
build/$(1)/%: build/$(1)/.built ;
build/$(1)/.built: .venv/.runtime $$(ENGINE) $$(TEMPLATES) $$(call files_in,problems/$(1)) \
    $$(wildcard $$(filter problems/%,$$(record_of_$(1)))) \
    $$(if $$(filter-out $$(wildcard $$(record_of_$(1))),$$(wordlist 2,9999,$$(record_of_$(1)))),always) \
    $$(if $$(filter-out $$(firstword $$(record_of_$(1))),engine=$$(value DERIVE_ENGINE)/detail=),always)
	@$$(PYTHON) -P -m derive build $(1)
endef
$(foreach set,$(SETS),$(eval $(call RULES_OF_A_SET,$(set))))

check: .venv/.runtime
	@$(PYTHON) -P -m derive check

bench: .venv/.runtime
	@$(PYTHON) -P -m bench.ratios
	@$(PYTHON) -P -m bench.pages
	@$(PYTHON) -P -m bench.systems
	@$(PYTHON) -P -m bench.equality
	@$(PYTHON) -P -m bench.documents
	@$(PYTHON) -P -m bench.scale
	@$(PYTHON) -P -m bench.problems

test: .venv/.tests
	@$(PYTHON) -P -m ruff check --quiet .
	@$(PYTHON) -P -m ruff format --quiet --check .
	@$(PYTHON) -P -m compileall -q -j 2 derive  # once, and not by each worker
	@$(PYTHON) -P -m mypy --no-error-summary & types=$$!; \
	  $(PYTHON) -P -m pytest -n 2 --dist worksteal; tests=$$?; \
	  wait $$types || { echo 'mypy has found errors: see above' >&2; exit 1; }; exit $$tests

schemas: .venv/.runtime
	@$(PYTHON) -P -m tools.schemas

mutants: .venv/.tests
	@$(PYTHON) -P -m tests.differential
	@$(PYTHON) -P -m tests.perturbation
	@$(PYTHON) -P -m tests.mutation --share 1/2 & $(PYTHON) -P -m tests.mutation --share 2/2; wait

clean:
	@rm -rf build/*/

# If `.venv/bin/python` is missing, or is a link to a Python that no longer exists, the environment is made again.
.venv/.runtime .venv/.tests: $(ENVIRONMENT) $(if $(wildcard $(PYTHON)),,always)
	@for python in python3 python3.14 python3.13 python3.12 python3.11; do \
	  if $$python -I -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then \
	    exec $$python -I tools/bootstrap.py $(@F); \
	  fi; \
	done; \
	if command -v uv >/dev/null 2>&1; then \
	  exec uv run --no-project --python '>=3.11' python -I tools/bootstrap.py $(@F); \
	fi; \
	found=$$(python3 --version 2>&1) || found='no python3'; \
	echo "error[python]: derive needs Python 3.11 or later, and found $$found: install one (apt install python3), or install uv" >&2; \
	exit 1

always: ;
