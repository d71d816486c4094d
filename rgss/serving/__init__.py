"""Local web server that shows a study while its sweep runs; it only reads."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.serving.application import study_application
    from rgss.serving.observer import StudyObserver
    from rgss.serving.replays import TrialReplays
    from rgss.serving.server import listen, require_server, serve
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
