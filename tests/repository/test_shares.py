"""Shares of the test files: each file in one of them, and the exit status of the processes that run them."""

from __future__ import annotations

import pytest

from tests.in_shares import files_of_share, main

_TESTS = {"passes": "assert True", "fails": "assert False", "interrupts": "raise KeyboardInterrupt"}


@pytest.mark.parametrize("count", [1, 2, 3, 7, 40])
def test_each_file_is_in_one_share_and_shares_are_alike(tmp_path, count):
    files = [tmp_path / f"test_{number}.py" for number in range(37)]
    for number, file in enumerate(files):
        file.write_bytes(b"#" * (100 + number**2))
    shares = [files_of_share(files, share, count) for share in range(count)]
    assert sorted(file for share in shares for file in share) == sorted(files)
    numbers = [len(share) for share in shares]
    assert max(numbers) - min(numbers) <= 1
    sizes = [sum(file.stat().st_size for file in share) for share in shares]
    largest = max(file.stat().st_size for file in files)
    assert max(sizes) - min(sizes) <= largest


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kinds", "status"),
    [
        (("passes", "passes"), pytest.ExitCode.OK),
        (("passes", "fails"), pytest.ExitCode.TESTS_FAILED),
        (("fails", "passes"), pytest.ExitCode.TESTS_FAILED),
        (("passes", "interrupts"), pytest.ExitCode.INTERRUPTED),
        (("passes", "nothing"), pytest.ExitCode.OK),
        (("nothing", "nothing"), pytest.ExitCode.NO_TESTS_COLLECTED),
    ],
)
def test_the_status_is_that_of_a_process_that_has_something_to_say(tmp_path, capfd, monkeypatch, kinds, status):
    (tmp_path / "conftest.py").write_text(
        "from pathlib import Path\n"
        "def pytest_addoption(parser):\n"
        "    parser.addoption('--share')\n"
        "def pytest_ignore_collect(collection_path, config):\n"
        "    share = config.getoption('--share').partition('/')[0]\n"
        "    return True if collection_path.name.startswith('test_') and share not in collection_path.name else None\n",
        encoding="utf-8",
    )
    for number, kind in enumerate(kinds):
        body = f"def test_{kind}():\n    {_TESTS[kind]}\n" if kind in _TESTS else ""
        (tmp_path / f"test_{number}.py").write_text(body, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    assert main(["--quiet", f"--rootdir={tmp_path}", str(tmp_path)], count=len(kinds)) == status
    said = capfd.readouterr().out
    for kind in kinds:
        assert {"passes": "1 passed", "fails": "1 failed", "interrupts": "KeyboardInterrupt", "nothing": "no tests"}[
            kind
        ] in said
