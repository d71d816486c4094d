"""Confirmation of a decision: the same trials at a finer step, with more iterations, and in another engine."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.confirmation.confirmation import COMPARED_METRICS, Confirmation, ConfirmedTrial, SettingResult
    from rgss.confirmation.confirming import confirm
    from rgss.confirmation.kept_trials import confirmation_trials
    from rgss.confirmation.selection import MOST_RIVALS, Selection, select, selected_by_id
    from rgss.confirmation.settings import (
        Aspect,
        ConfirmationSetting,
        Engine,
        confirmation_settings,
    )
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
