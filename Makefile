# `make` builds every set of problems; `make help` lists the rest. Works with GNU make 3.81 and later.
# A stamp is newer than all that it was made from, so with nothing changed no Python is started.

.DEFAULT_GOAL := all
.SUFFIXES:
MAKEFLAGS += --no-builtin-rules
PYTHON := .venv/bin/python
# What Python compiles is kept beside the sources, also where the environment says not to: it would compile a second long
# at every start, and the tests start it a hundred times.
export PYTHONDONTWRITEBYTECODE :=

# Names are words of rules and of commands: of sets and files, those with other characters are not named here, and no
# set may have the name of another target. What lies in build/ is read as words, never as rules.
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

# The library is for looking things up: it is built when it is asked for.
all: .venv/.runtime $(filter-out library,$(SETS))

help:
	@echo 'make          the PDFs of every set but the library, in build/; installs what it needs into .venv first'
	@$(foreach set,$(SETS),echo 'make $(set)      the PDFs of $(set)';)
	@echo 'make check    derive every problem, verify each line, compare with the reference'
	@echo 'make test     lint, types and the whole test suite'
	@echo 'make schemas  the JSON schemas of problem and reference files, for editors'
	@echo 'make mutants  change the code and the results in every place that can be changed: what is not refused (two hours)'
	@echo 'make bench    how long a build takes, as ratios to the least it could take'
	@echo 'make clean    empty build/; .venv stays'
	@echo 'DERIVE_ENGINE=latexmk (or pdflatex, lualatex, tectonic) chooses another TeX; .venv/bin/derive doctor shows them'

# An output that was deleted, or made with other options, is made again although its stamp is new. A set may use a script
# of another set. What the environment says of the engine is text.
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
	@$(PYTHON) -P -m bench.scale
	@$(PYTHON) -P -m bench.problems

test: .venv/.tests
	@$(PYTHON) -P -m ruff check --quiet .
	@$(PYTHON) -P -m ruff format --quiet --check .
	@$(PYTHON) -P -m mypy --no-error-summary
	@$(PYTHON) -P -m pytest -n 2 --dist worksteal

schemas: .venv/.runtime
	@$(PYTHON) -P -m tools.schemas

mutants: .venv/.tests
	@$(PYTHON) -P -m tests.differential
	@$(PYTHON) -P -m tests.perturbation
	@$(PYTHON) -P -m tests.mutation --share 1/2 & $(PYTHON) -P -m tests.mutation --share 2/2; wait

clean:
	@rm -rf build/*/

# A link to a Python that is gone does not count as one.
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
