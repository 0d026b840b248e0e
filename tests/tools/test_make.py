"""The Makefile: when it starts a Python, when it must not, and what it says if there is none that will do.

`.venv/bin/python` is a stand-in that notes its calls and writes what a build would.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import time
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parents[2]
PYTHON = """#!/bin/sh
PATH={path}
echo "$*" >> calls.log
[ "$4" = build ] || exit 0
[ -z "$FAILING" ] || exit 1
mkdir -p build/$5
echo x > build/$5/block.pdf
echo "engine=$DERIVE_ENGINE/detail=" > build/$5/.outputs
echo "build/$5/block.pdf" >> build/$5/.outputs
[ ! -e problems/hw2/block.py ] || [ "$5" != hw1 ] || echo "problems/hw2/block.py" >> build/$5/.outputs
touch build/$5/.built
"""


class Tree:
    def __init__(self, root: Path):
        self.root = root
        shutil.copy(HERE / "Makefile", root)
        for name in (
            "pyproject.toml",
            "locks/runtime.txt",
            "locks/tests.txt",
            "tools/bootstrap.py",
            "derive/steps/step.py",
        ):
            self.write(name)
        for name in ("problems/hw1/set.yaml", "problems/hw1/block.yaml", "problems/hw2/set.yaml"):
            self.write(name)
        self.write("templates/phrases/en/page.yaml")
        self.write("build/.gitkeep")
        self.write(".venv/bin/python", PYTHON.format(path=os.defpath)).chmod(0o755)
        self.age()
        self.write(".venv/.runtime")

    def write(self, name: str, text: str = "x\n") -> Path:
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def age(self) -> None:
        for path in [*self.root.rglob("*"), self.root]:
            os.utime(path, (time.time() - 60, path.stat().st_mtime - 60), follow_symlinks=False)

    def make(self, *arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
        environment = {"PATH": os.defpath, **environment}
        return subprocess.run(["make", *arguments], cwd=self.root, env=environment, capture_output=True, text=True)

    def calls(self) -> list[str]:
        """How Python was started since the last call."""
        log = self.root / "calls.log"
        lines = log.read_text().splitlines() if log.is_file() else []
        log.unlink(missing_ok=True)
        return sorted(lines)


@pytest.fixture
def tree(tmp_path: Path) -> Tree:
    return Tree(tmp_path)


@pytest.fixture
def built(tree: Tree) -> Tree:
    assert tree.make().returncode == 0
    assert tree.calls() == ["-P -m derive build hw1", "-P -m derive build hw2"]
    tree.age()
    return tree


def test_with_nothing_changed_no_python_is_started(built: Tree) -> None:
    assert built.make().returncode == 0
    assert built.calls() == []


@pytest.mark.parametrize("name", ["problems/hw1/block.yaml", "problems/hw1/new.yaml", "problems/hw1/figures/a.txt"])
def test_an_edit_or_a_new_file_builds_its_set_only(built: Tree, name: str) -> None:
    built.write(name)
    built.make()
    assert built.calls() == ["-P -m derive build hw1"]
    built.age()
    built.make()
    assert built.calls() == []


def test_a_file_that_is_gone_builds_its_set(built: Tree) -> None:
    (built.root / "problems/hw1/block.yaml").unlink()
    built.make()
    assert built.calls() == ["-P -m derive build hw1"]


@pytest.mark.parametrize("name", ["derive/steps/step.py", "templates/phrases/en/page.yaml", "templates/latex/new.tex"])
def test_an_edit_of_the_engine_or_a_template_builds_every_set(built: Tree, name: str) -> None:
    built.write(name)
    built.make()
    assert built.calls() == ["-P -m derive build hw1", "-P -m derive build hw2"]


def test_a_deleted_output_is_built_again(built: Tree) -> None:
    (built.root / "build/hw2/block.pdf").unlink()
    built.make()
    assert built.calls() == ["-P -m derive build hw2"]


def test_another_engine_builds_again_and_the_first_one_too(built: Tree) -> None:
    built.make("hw1", DERIVE_ENGINE="lualatex")
    assert built.calls() == ["-P -m derive build hw1"]
    built.make("hw1", DERIVE_ENGINE="lualatex")
    assert built.calls() == []
    built.make("hw1")
    assert built.calls() == ["-P -m derive build hw1"]


def test_what_the_environment_says_of_the_engine_is_text(built: Tree) -> None:
    built.make("hw1", DERIVE_ENGINE="$(shell touch taken)")
    built.make("hw1", DERIVE_ENGINE="x),always) $(shell touch taken")
    assert not [*built.root.rglob("taken")]
    assert built.calls() == ["-P -m derive build hw1"] * 2


def test_an_edit_of_a_script_of_another_set_builds_each_set_that_was_made_from_it(built: Tree) -> None:
    built.write("problems/hw2/block.py")
    built.write("problems/hw1/block.yaml", "solve: ../hw2/block.py\n")
    built.make()
    built.calls()
    built.age()
    built.make()
    assert built.calls() == []
    built.write("problems/hw2/block.py")
    built.make()
    assert built.calls() == ["-P -m derive build hw1", "-P -m derive build hw2"]
    (built.root / "problems/hw2/block.py").unlink()
    built.make("hw1")
    assert built.calls() == ["-P -m derive build hw1"]


def test_a_set_is_built_once_by_parallel_makes_of_its_targets(tree: Tree) -> None:
    assert tree.make("-j4", "all", "hw1", "build/hw1/block.pdf", "build/hw1/solutions.pdf").returncode == 0
    assert tree.calls() == ["-P -m derive build hw1", "-P -m derive build hw2"]


def test_a_failed_build_fails_make_and_is_tried_again(tree: Tree) -> None:
    assert tree.make("hw1", FAILING="yes").returncode != 0
    tree.calls()
    assert tree.make("hw1").returncode == 0
    assert tree.calls() == ["-P -m derive build hw1"]


def test_help_names_every_set_and_starts_nothing(tree: Tree) -> None:
    out = tree.make("help").stdout
    for target in ("make hw1", "make hw2", "make check", "make test", "make bench", "make clean"):
        assert target in out
    assert tree.calls() == []
    assert not (tree.root / "build/hw1").exists()


def test_clean_empties_build_and_keeps_the_folder(built: Tree) -> None:
    assert built.make("clean").returncode == 0
    assert [path.name for path in (built.root / "build").iterdir()] == [".gitkeep"]
    assert built.calls() == []


def test_check_and_bench_run_in_the_environment(tree: Tree) -> None:
    tree.make("check")
    tree.make("bench")
    names = ("documents", "equality", "pages", "problems", "ratios", "scale", "systems")
    benches = [f"-P -m bench.{name}" for name in names]
    assert tree.calls() == [*benches, "-P -m derive check"]


def test_the_tests_and_the_types_come_after_the_linter(tree: Tree) -> None:
    tree.write(".venv/.tests")
    tree.make("test")
    log = (tree.root / "calls.log").read_text().splitlines()
    assert [line.split()[2] for line in log[:3]] == ["ruff", "ruff", "compileall"]
    assert sorted(line.split()[2] for line in log[3:]) == ["mypy", "pytest"]  # at the same time


@pytest.mark.parametrize("failing", ["mypy", "pytest"])
def test_wrong_types_and_failed_tests_both_fail(tree: Tree, failing: str) -> None:
    tree.write(".venv/.tests")
    tree.write(".venv/bin/python", f'#!/bin/sh\n[ "$3" != {failing} ]\n')
    run = tree.make("test")
    assert run.returncode != 0
    assert ("mypy has found errors" in run.stderr) == (failing == "mypy")


HOSTILE = [
    "`touch taken`",
    "$(touch taken)",
    "$(shell touch taken)",
    "a;touch taken",
    "my set",
    "a:b",
    "a%b",
    "-n",
    "é",
]


def test_no_name_of_a_set_or_a_file_and_nothing_under_build_is_a_command(tree: Tree) -> None:
    for name in HOSTILE:
        tree.write(f"problems/{name}/set.yaml")
        tree.write(f"problems/hw1/{name}")
        tree.write(f"templates/latex/{name}")
    tree.write("build/hw1/.outputs", "$(shell touch taken)\n`touch taken`\nengine=/detail=\nx:;touch taken\n")
    tree.write("build/hw1/.outputs.mk", "$(shell touch taken)\n")
    made = tree.make()
    assert made.returncode == 0
    assert tree.calls() == ["-P -m derive build hw1", "-P -m derive build hw2"]
    assert not list(tree.root.rglob("taken"))
    assert made.stderr.count("warning[set-name]: the set ") == len(HOSTILE)


@pytest.mark.parametrize("name", ["clean", "test", "all", "check", "bench", "help"])
def test_a_set_with_the_name_of_a_target_is_left_out_with_a_warning(tree: Tree, name: str) -> None:
    tree.write(f"problems/{name}/set.yaml")
    made = tree.make()
    assert tree.calls() == ["-P -m derive build hw1", "-P -m derive build hw2"]
    assert made.stderr == f'warning[set-name]: the set "{name}" is left out: make has a target of that name\n'


def python_that_is(tree: Tree, name: str, version: str, new_enough: bool) -> None:
    cases = f'--version*) echo {version} ;; "-I -c"*) exit {int(not new_enough)} ;; *) echo "{name} $*" ;;'
    tree.write(f"bin/{name}", f'#!/bin/sh\ncase "$*" in {cases} esac\n').chmod(0o755)


def make_without_environment(tree: Tree, *arguments: str) -> subprocess.CompletedProcess[str]:
    (tree.root / ".venv/bin/python").unlink()
    make = shutil.which("make")
    assert make
    command = [make, "SHELL=/bin/sh", *(arguments or (".venv/.runtime",))]
    environment = {"PATH": str(tree.root / "bin")}
    return subprocess.run(command, cwd=tree.root, env=environment, capture_output=True, text=True)


def test_no_python_is_one_line_with_the_mend(tree: Tree) -> None:
    run = make_without_environment(tree)
    assert run.returncode != 0
    assert run.stderr.splitlines()[0] == (
        "error[python]: derive needs Python 3.11 or later, and found no python3: "
        "install one (apt install python3), or install uv"
    )


def test_an_old_python_is_named_with_the_mend(tree: Tree) -> None:
    python_that_is(tree, "python3", "Python 3.8.10", new_enough=False)
    run = make_without_environment(tree)
    assert run.stderr.startswith("error[python]: derive needs Python 3.11 or later, and found Python 3.8.10: ")


def test_a_newer_python_under_its_full_name_is_found(tree: Tree) -> None:
    python_that_is(tree, "python3", "Python 3.8.10", new_enough=False)
    python_that_is(tree, "python3.12", "Python 3.12.1", new_enough=True)
    assert make_without_environment(tree).stdout == "python3.12 -I tools/bootstrap.py .runtime\n"


def test_uv_finds_a_python_where_there_is_none(tree: Tree) -> None:
    python_that_is(tree, "uv", "", new_enough=True)
    run = make_without_environment(tree, ".venv/.tests")
    assert run.stdout == "uv run --no-project --python >=3.11 python -I tools/bootstrap.py .tests\n"


def test_an_environment_whose_python_is_gone_is_set_up_again(tree: Tree) -> None:
    python_that_is(tree, "python3", "Python 3.12.1", new_enough=True)
    (tree.root / ".venv/bin/python").unlink()
    (tree.root / ".venv/bin/python").symlink_to("/no/such/python")
    assert make_without_environment(tree).stdout == "python3 -I tools/bootstrap.py .runtime\n"
