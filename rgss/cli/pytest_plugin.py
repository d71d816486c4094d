"""Plugin of pytest: what a run of a project's tests verifies, and what it tested, in its JUnit file.

pytest finds it wherever rgss is installed, and it does nothing outside of a project. A test that is marked
``@pytest.mark.verifies("SYS-1")`` carries its requirements into the file of ``--junitxml=FILE``, and the run the
digests of the tested code and of each requirement, by which `rgss trace` and `rgss check --evidence` know whether the
result still holds.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest

# The fixture `record_testsuite_property` reaches no file where tests run in several processes.
from _pytest.junitxml import xml_key


def pytest_configure(config: pytest.Config) -> None:
    """Declare the mark."""
    config.addinivalue_line("markers", "verifies(*ids): the requirements that the test verifies")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Note on each marked test which requirements it verifies."""
    marked = {item: names for item in items if (names := _requirements_of(item))}
    project = _project(config) if marked else None
    if project is None:
        return
    # Here, so that a run of unmarked tests does not wait for the import.
    from rgss.trace.evidence import TEST_ID, VERIFIES

    for item, names in marked.items():
        item.user_properties += [(TEST_ID, _id_in(project, item)), *((VERIFIES, name) for name in names)]


@pytest.hookimpl(trylast=True)
def pytest_sessionstart(session: pytest.Session) -> None:
    """Note what is tested, where the result is written to a file: by the process that writes it."""
    report = session.config.stash.get(xml_key, None)
    project = None if report is None else _project(session.config)
    if report is None or project is None:
        return
    for name, value in _digests(project).items():
        report.add_global_property(name, value)


def _requirements_of(item: pytest.Item) -> tuple[str, ...]:
    return tuple(dict.fromkeys(str(name) for mark in item.iter_markers("verifies") for name in mark.args))


def _project(config: pytest.Config) -> Path | None:
    """The project of the run: the nearest above the folder in which pytest was started; None outside of one."""
    from rgss.studies import FOLDERS

    start = config.invocation_params.dir
    found = (folder for folder in (start, *start.parents) if all((folder / name).is_dir() for name in FOLDERS))
    return next(found, None)


def _id_in(project: Path, item: pytest.Item) -> str:
    """The id of a test with its file relative to the project, where pytest may have another root."""
    _, separator, name = item.nodeid.partition("::")
    if not item.path.is_relative_to(project):
        return item.nodeid
    return f"{item.path.relative_to(project).as_posix()}{separator}{name}"


def _digests(project: Path) -> Mapping[str, str]:
    from rgss.errors import RgssError
    from rgss.requirements import load_requirements
    from rgss.studies import named_sets, qualifier_of
    from rgss.trace.evidence import run_properties

    try:
        noted = dict(run_properties(project, load_requirements(project / "requirements").system))
        for folder in named_sets(project):
            requirements = load_requirements(project / folder, label_root=folder).system
            noted |= run_properties(project, requirements, qualifier=qualifier_of(folder))
    except RgssError:
        # A broken project has findings of its own; the run does not say what it tested.
        return {}
    return noted
