"""What is written of the package: examples that run, types, the cost of an import."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

import gambol

FOLDER = Path(__file__).parent.parent
PAGE = FOLDER.parent / "docs" / "python.md"
EXAMPLES = re.findall(r"```python\n(.*?)```", PAGE.read_text("utf-8"), flags=re.S) if PAGE.is_file() else []


@pytest.mark.parametrize("example", EXAMPLES)
def test_the_examples_of_the_page_run(example, tmp_path):
    subprocess.run([sys.executable, "-W", "error", "-c", example], check=True, cwd=tmp_path, timeout=120)


def test_there_are_examples():
    assert len(EXAMPLES) == 6


def test_types_are_complete(tmp_path):
    api = pytest.importorskip("mypy.api")
    files = []
    for number, example in enumerate(EXAMPLES):
        files.append(tmp_path / f"example_{number}.py")
        files[-1].write_text(example, "utf-8")
    # The sources, since what is installed beside them is not ours.
    package = FOLDER / "python" / "gambol"
    options = ["--strict", "--cache-dir", str(tmp_path / "cache"), str(package)]
    for arguments in (options, [*options[:-1], *map(str, files)]):
        text, errors, code = api.run(arguments)
        assert code == 0, text + errors


def test_types_of_the_native_part_are_those_of_its_source():
    """Names, parameters and their kinds, in both directions, as the installed module has them."""
    pytest.importorskip("mypy")
    command = [sys.executable, "-m", "mypy.stubtest", "--ignore-disjoint-bases", "--concise", "gambol._gambol"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr


def test_everything_public_is_documented():
    for name in gambol.__all__:
        assert getattr(gambol, name).__doc__, name
        for attribute, value in vars(getattr(gambol, name)).items() if isinstance(getattr(gambol, name), type) else ():
            if not attribute.startswith("_") and callable(value):
                assert value.__doc__, f"{name}.{attribute}"


def test_an_import_builds_nothing():
    """Beside Gymnasium and NumPy, which everybody who imports it has, an import takes no time."""
    code = (
        "import gymnasium.vector, gymnasium.spaces, time; start = time.perf_counter(); import gambol;"
        "print(time.perf_counter() - start)"
    )
    seconds = min(
        float(subprocess.run([sys.executable, "-c", code], check=True, capture_output=True).stdout) for _ in range(5)
    )
    assert seconds < 0.1
