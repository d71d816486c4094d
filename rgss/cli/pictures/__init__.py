"""Options and files of the pictures that ``rgss run`` and ``rgss report`` make."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.cli.pictures.options import add_pictures, made_pictures, ordered_pictures, seen_trial
    from rgss.cli.pictures.replays import other_trial
    from rgss.cli.pictures.report import ordered_look, trial_pictures
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
