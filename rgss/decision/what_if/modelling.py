"""Modelling assumptions of a study that can be supposed otherwise, and the project with another value."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.decision.what_if.planning_settings import settings_of_designs, settings_of_planning
from rgss.decision.what_if.setting import ModelSetting, SettingChange
from rgss.decision.what_if.trial_settings import settings_of_trials
from rgss.studies import Project


def model_settings(project: Project) -> dict[str, ModelSetting]:
    """The modelling assumptions that trials are made with, by name."""
    return {setting.id: setting for setting in _settings(project)}


def with_setting(project: Project, name: str, text: str) -> tuple[SettingChange, Project]:
    """A changed modelling assumption, and the project with it.

    Args:
        project: The project.
        name: Its name, one of `model_settings`.
        text: The supposed value, as it was written.

    Raises:
        DefinitionError: The value is invalid.
    """
    setting = model_settings(project)[name]
    return SettingChange(id=name, before=setting.value, after=text), setting.changed(text)


def _settings(project: Project) -> Iterator[ModelSetting]:
    yield from settings_of_planning(project)
    yield from settings_of_designs(project)
    yield from settings_of_trials(project)
