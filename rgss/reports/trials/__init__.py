"""Pictures of a trial: film, strip of frames and plots."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.reports.trials.film import HIGHEST_RATE_HZ, CaptionedPicture, write_film
    from rgss.reports.trials.filmstrip import still_png, write_filmstrip
    from rgss.reports.trials.lettering import words
    from rgss.reports.trials.trial_plots import write_trial_plots
    from rgss.reports.trials.video import write_video
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
